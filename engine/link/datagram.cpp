// SPDX-License-Identifier: MIT
#include "link/datagram.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>

#include "base/bytes.hpp"
#include "base/error.hpp"

namespace hallway::link {
namespace {

constexpr std::array<char, 4> kMagic{'H', 'W', 'U', 'D'};

/// The head as it stands in a datagram.
struct Head {
  std::array<char, 4> magic = kMagic;
  std::uint8_t version = kFirstVersion;
  std::uint8_t type = 0;
  std::uint16_t flags = 0;
  std::uint32_t session = 0;
  std::uint32_t checksum = 0;
  std::uint64_t sequence = 0;
  std::uint16_t fragment = 0;
  std::uint16_t fragments = 0;
  std::uint16_t payload = 0;
  std::uint16_t reserved = 0;
};
static_assert(sizeof(Head) == kHeaderBytes);

std::uint32_t checksum_of(Head head, std::span<const std::byte> payload) {
  head.checksum = 0;
  const uLong begin = ::crc32(0, reinterpret_cast<const Bytef*>(&head), sizeof head);
  if (payload.empty()) return static_cast<std::uint32_t>(begin);
  const auto* rest = reinterpret_cast<const Bytef*>(payload.data());
  return static_cast<std::uint32_t>(::crc32(begin, rest, static_cast<uInt>(payload.size())));
}

std::uint16_t max_fragments(std::uint8_t type) {
  switch (Type{type}) {
    case Type::kFrame:
      return kMaxFrameFragments;
    case Type::kDescription:
      return kMaxDescriptionFragments;
    case Type::kHello:
    case Type::kMissing:
    case Type::kAnswer:
    case Type::kBye:
      return 1;
  }
  return 0;
}

bool makes_sense(const Head& head) {
  if (head.fragment >= head.fragments || head.fragments > max_fragments(head.type) || head.reserved != 0) {
    return false;
  }
  if (head.fragment + 1 < head.fragments) return head.payload == kFragmentBytes;
  return head.payload > 0 || head.fragments == 1;
}

}  // namespace

void write_datagram(const Header& header, std::span<const std::byte> payload, Bytes& out) {
  if (payload.size() > kFragmentBytes) {
    throw Error(ErrorCode::kInternal, "a payload that is too long for a datagram");
  }
  Head head;
  head.version = header.version;
  head.type = static_cast<std::uint8_t>(header.type);
  head.flags = header.flags;
  head.session = header.session;
  head.sequence = header.sequence;
  head.fragment = header.fragment;
  head.fragments = header.fragments;
  head.payload = static_cast<std::uint16_t>(payload.size());
  head.checksum = checksum_of(head, payload);
  out.clear();
  BasicByteWriter<Bytes&> writer(out);
  writer.put(head);
  writer.put_bytes(payload.data(), payload.size());
}

std::variant<Datagram, Refusal> read_datagram(std::span<const std::byte> bytes) {
  if (bytes.size() < sizeof(Head) || bytes.size() > kMaxDatagramBytes) return Refusal::kSize;
  const auto head = load<Head>(bytes.data());
  if (head.magic != kMagic) return Refusal::kMagic;
  if (head.version < kFirstVersion || head.version > kNewestVersion) return Refusal::kVersion;
  const auto payload = bytes.subspan(sizeof head);
  if (head.payload != payload.size()) return Refusal::kSize;
  if (head.checksum != checksum_of(head, payload)) return Refusal::kChecksum;
  if (!makes_sense(head)) return Refusal::kContent;
  return Datagram{{.type = Type{head.type},
                   .flags = head.flags,
                   .session = head.session,
                   .sequence = head.sequence,
                   .fragment = head.fragment,
                   .fragments = head.fragments,
                   .version = head.version},
                  payload};
}

std::size_t fragments_of(std::size_t bytes) {
  return std::max<std::size_t>(1, (bytes + kFragmentBytes - 1) / kFragmentBytes);
}

std::span<const std::byte> fragment_of(std::span<const std::byte> message, std::size_t fragment) {
  const std::size_t begin = fragment * kFragmentBytes;
  return message.subspan(begin, std::min(kFragmentBytes, message.size() - begin));
}

}  // namespace hallway::link
