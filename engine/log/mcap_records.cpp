// SPDX-License-Identifier: MIT
#include "log/mcap_records.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "log/compression.hpp"

namespace hallway::log {
namespace {

/// An attachment with the check sum of what stands before that.
struct CheckedAttachment : McapAttachment {
  std::uint32_t crc = 0;
  static constexpr auto kFields =
      std::tuple_cat(McapAttachment::kFields, std::tuple(&CheckedAttachment::crc));
};

}  // namespace

void McapFieldWriter::fail_length() {
  throw Error(ErrorCode::kInternal, "a text or list is too long for a log");
}

void append_record(std::string& out, const McapAttachment& attachment) {
  const std::size_t begin = out.size() + kMcapRecordHead;
  append_record(out, CheckedAttachment{attachment});
  const std::size_t end = out.size() - sizeof(std::uint32_t);
  store(out.data() + end, crc32(std::string_view(out).substr(begin, end - begin)));
}

void refuse_record(const BadBytes& bad) {
  throw Error(ErrorCode::kBadInput,
              fmt::format("{} bytes at byte {} of a record of {}", bad.wanted, bad.at, bad.total));
}

template <>
McapFooter parse_record(std::string_view content) {
  if (content.size() != kMcapFooterBytes) throw Error(ErrorCode::kBadInput, "a footer of a wrong length");
  McapFooter footer;
  McapFieldReader(content).get_fields(footer);
  return footer;
}

template <>
McapAttachment parse_record(std::string_view content) {
  const auto attachment = parse_record<CheckedAttachment>(content);
  const auto covered = static_cast<std::size_t>(attachment.data.end() - content.begin());
  if (attachment.crc != 0 && attachment.crc != crc32(content.substr(0, covered)))
    throw Error(ErrorCode::kBadInput, "an attachment whose check sum is wrong");
  return attachment;
}

}  // namespace hallway::log
