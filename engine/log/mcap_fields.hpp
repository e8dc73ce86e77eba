// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/bytes.hpp"

namespace hallway::log {

// How the fields of MCAP's records look. A record has a list of its members, kFields, in the order of the format. By its type a member is
//
//     a number or kind   as it stands
//     std::string        its length (u32), then its bytes
//     std::string_view   its length (u64), then its bytes; as McapRest all bytes that are left
//     list of pairs      the bytes that they take (u32), then each pair as two fields

/// A member that takes what is left of a record.
template <typename Record>
struct McapRest {
  std::string_view Record::*member;
};
template <typename Record>
McapRest(std::string_view Record::*) -> McapRest<Record>;

template <typename T>
concept McapNumber = std::is_integral_v<T> || std::is_enum_v<T>;

/// Appends the fields of a record.
class McapFieldWriter {
 public:
  explicit McapFieldWriter(std::string& out) : bytes_(out) {}

  template <typename Record>
  void put_fields(const Record& record) {
    std::apply([&](auto... fields) { (put_field(record, fields), ...); }, Record::kFields);
  }
  template <McapNumber T>
  void put(T value) {
    bytes_.put(value);
  }
  /// The number of bytes that `content` puts, then those.
  template <typename Length, typename Content>
  void put_sized(Content content) {
    const std::size_t at = bytes_.size();
    put(Length{0});
    content();
    bytes_.put_at(at, length<Length>(bytes_.size() - at - sizeof(Length)));
  }

  void put(const std::string& text) {
    put(length<std::uint32_t>(text.size()));
    bytes_.put_raw(text);
  }
  void put(std::string_view data) { bytes_.put_text(data); }
  template <typename First, typename Second>
  void put(const std::vector<std::pair<First, Second>>& pairs) {
    put_sized<std::uint32_t>([&] {
      for (const auto& [first, second] : pairs) {
        put(first);
        put(second);
      }
    });
  }

 private:
  template <typename Record, typename Owner, typename Field>
  void put_field(const Record& record, Field Owner::*field) {
    put(record.*field);
  }
  template <typename Record>
  void put_field(const Record& record, McapRest<Record> rest) {
    bytes_.put_raw(record.*rest.member);
  }
  template <typename Length>
  static Length length(std::size_t size) {
    if (!std::in_range<Length>(size)) fail_length();
    return static_cast<Length>(size);
  }
  [[noreturn]] static void fail_length();

  ByteAppender bytes_;
};

/// Takes the fields of a record from bytes that nobody vouches for. Throws BadBytes.
class McapFieldReader {
 public:
  explicit McapFieldReader(std::string_view content) : bytes_(content) {}

  template <typename Record>
  void get_fields(Record& record) {
    std::apply([&](auto... fields) { (get_field(record, fields), ...); }, Record::kFields);
  }

 private:
  template <McapNumber T>
  void get(T& value) {
    value = bytes_.get<T>();
  }
  void get(std::string& text) { text = bytes_.take_raw(bytes_.get<std::uint32_t>()); }
  void get(std::string_view& data) { data = bytes_.take_raw(bytes_.get<std::uint64_t>()); }
  template <typename First, typename Second>
  void get(std::vector<std::pair<First, Second>>& pairs) {
    McapFieldReader list(bytes_.take_raw(bytes_.get<std::uint32_t>()));
    while (!list.bytes_.at_end()) {
      auto& [first, second] = pairs.emplace_back();
      list.get(first);
      list.get(second);
    }
  }
  template <typename Record, typename Owner, typename Field>
  void get_field(Record& record, Field Owner::*field) {
    get(record.*field);
  }
  template <typename Record>
  void get_field(Record& record, McapRest<Record> rest) {
    record.*rest.member = bytes_.take_rest();
  }

  ByteReader bytes_;
};

}  // namespace hallway::log
