// SPDX-License-Identifier: MIT
#include "host/samples/sample_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <span>
#include <string_view>

#include "base/bytes.hpp"
#include "base/text.hpp"
#include "host/samples/payload.hpp"
#include "host/samples/sample_kind.hpp"

namespace hallway::host {
namespace {

constexpr std::size_t member_bytes(const PayloadMember& member) {
  return number_bytes(member.type) * member.n * std::max<std::size_t>(member.lists, 1);
}

template <typename Whole>
void append_whole(std::string& out, Whole value) {
  fmt::format_to(std::back_inserter(out), "{}", value);
}

void append_shortest(std::string& out, double value) {
  append_double(out, value);
}

/// The shortest decimal that reads back as the same float.
void append_shortest(std::string& out, float value) {
  std::array<char, 32> buffer;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  out.append(buffer.data(), result.ptr);
}

/// What JSON has no number for has a text: "inf", "-inf"; or is null: NaN.
template <typename Real>
void append_real(std::string& out, Real value) {
  if (std::isfinite(value)) return append_shortest(out, value);
  out += std::isnan(value) ? "null" : value > 0 ? R"("inf")" : R"("-inf")";
}

template <typename Whole>
void append_whole_or_none(std::string& out, Whole value, bool may_be_none) {
  if (may_be_none && value == static_cast<Whole>(-1)) {
    out += "null";
  } else {
    append_whole(out, value);
  }
}

void append_number(std::string& out, const std::byte* at, const PayloadMember& member) {
  switch (member.type) {
    case NumberType::kU32:
      return append_whole_or_none(out, load<std::uint32_t>(at), member.may_be_none);
    case NumberType::kU64:
      return append_whole_or_none(out, load<std::uint64_t>(at), member.may_be_none);
    case NumberType::kI64:
      return append_whole_or_none(out, load<std::int64_t>(at), member.may_be_none);
    case NumberType::kF32:
      return append_real(out, load<float>(at));
    case NumberType::kF64:
      return append_real(out, load<double>(at));
  }
}

/// @param append  appends the item of a number
template <typename Append>
void append_list(std::string& out, std::uint64_t n, Append append) {
  out += '[';
  for (std::uint64_t i = 0; i < n; ++i) {
    if (i > 0) out += ',';
    append(i);
  }
  out += ']';
}

/// @param base  what the member's offset counts from
void append_value(std::string& out, const std::byte* base, const PayloadMember& member) {
  const std::size_t bytes = number_bytes(member.type);
  const auto append_one_list = [&](const std::byte* first) {
    if (member.n == 1) return append_number(out, first, member);
    append_list(out, member.n, [&](std::uint64_t i) { append_number(out, first + i * bytes, member); });
  };
  if (member.lists == 0) return append_one_list(base + member.offset);
  append_list(out, member.lists,
              [&](std::uint64_t i) { append_one_list(base + member.offset + i * member.n * bytes); });
}

/// The names and values of an object, between its braces.
class ObjectText {
 public:
  explicit ObjectText(std::string& out) : out_(out) { out_ += '{'; }
  ~ObjectText() { out_ += '}'; }
  ObjectText(const ObjectText&) = delete;
  ObjectText& operator=(const ObjectText&) = delete;

  /// Begins a member; its value is to follow. @param name  has blanks where JSON has underscores: "hull points"
  std::string& member(std::string_view name) {
    out_ += begun_ ? ",\"" : "\"";
    begun_ = true;
    std::ranges::replace_copy(name, std::back_inserter(out_), ' ', '_');
    out_ += "\":";
    return out_;
  }

 private:
  std::string& out_;
  bool begun_ = false;
};

void append_element(std::string& out, const std::byte* element, std::span<const PayloadMember> members) {
  if (members.size() == 1 && *members.front().name == '\0')
    return append_value(out, element, members.front());
  ObjectText object(out);
  for (const PayloadMember& member : members) append_value(object.member(member.name), element, member);
}

void append_payload(std::string& out, const SampleKind& kind, const void* given) {
  Payload payload;
  payload.assign(kind, given);
  const std::byte* base = payload.get();
  const std::size_t size = payload.used_size();
  ObjectText object(out);
  for (const PayloadMember& member : kind.members) {
    if (member.name == std::string_view(kReserved)) continue;
    if (member.offset + member_bytes(member) <= size) append_value(object.member(member.name), base, member);
  }
  for (const PayloadArray& array : kind.arrays) {
    if (!has_array(base, array)) continue;
    const auto* first = load<const std::byte*>(base + array.data);
    const std::uint64_t stride = stride_of(base, array);
    append_list(object.member(array.name), load<std::uint64_t>(base + array.count),
                [&](std::uint64_t i) { append_element(out, first + i * stride, array.members); });
  }
}

/// The names of the flags that are set, by bit.
void append_flags(std::string& out, std::uint32_t flags) {
  static_assert(HW_SAMPLE_TRACKED == 1u);
  const char* separator = "";
  out += '[';
  for (int bit = 0; bit < 32; ++bit) {
    if (((flags >> bit) & 1u) == 0) continue;
    out += separator;
    out += bit == 0 ? R"("tracked")" : fmt::format(R"("bit {}")", bit);
    separator = ",";
  }
  out += ']';
}

}  // namespace

void append_sample_json(std::string& out, const hw_sample_t& sample) {
  ObjectText object(out);
  append_whole(object.member("sensor"), sample.sensor_id);
  object.member("kind") += '"' + sample_kind_name(sample.kind) + '"';
  append_whole(object.member("sequence"), sample.sequence);
  append_whole(object.member("t_begin_ns"), sample.t_begin_ns);
  append_whole(object.member("t_end_ns"), sample.t_end_ns);
  append_flags(object.member("flags"), sample.flags);
  const SampleKind* kind = find_sample_kind(sample.kind);
  if (kind != nullptr) append_payload(object.member("payload"), *kind, sample.payload);
}

std::string frame_json(const hw_frame_t& frame) {
  std::string out;
  {
    ObjectText object(out);
    append_whole(object.member("sequence"), frame.sequence);
    append_whole(object.member("t_ns"), frame.t_ns);
    append_list(object.member("samples"), frame.n_samples,
                [&](std::uint64_t i) { append_sample_json(out, *frame.samples[i]); });
  }
  return out;
}

}  // namespace hallway::host
