// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "base/bytes.hpp"

namespace hallway {

// A format that is written and read by one walk through its values: pass(archive, value) names the parts of a value in their order; with a
// ByteSaver they are put, with a ByteLoader they are read over what is there. A source derives both under names of its own, beside its pass()
// functions: so pass_all() finds these.

/// A value as a walk gets it: changed where it is read.
template <typename Archive, typename T>
using Passed = std::conditional_t<Archive::kReads, T, const T>;

/// Puts the values that a walk names.
/// @tparam Writer  a BasicByteWriter
template <typename Writer>
class ByteSaver {
 public:
  static constexpr bool kReads = false;
  explicit ByteSaver(Writer& out) : out_(out) {}

  template <typename... T>
  void values(const T&... values) {
    (out_.put(values), ...);
  }
  /// A value that stands there as a T.
  template <typename T, typename Value>
  void value_as(const Value& value) {
    out_.put(static_cast<T>(value));
  }
  /// Texts, and lists of plain values.
  template <typename... Lists>
  void lists(const Lists&... lists) {
    (out_.put_list(lists), ...);
  }
  /// The length of a list whose items are walked through after it.
  template <typename Items>
  void length(const Items& items, std::size_t) {
    out_.put(std::uint64_t{items.size()});
  }

 private:
  Writer& out_;
};

/// Reads the values that a walk names. Throws BadBytes.
/// @tparam Reader  a BasicByteReader
template <typename Reader>
class ByteLoader {
 public:
  static constexpr bool kReads = true;
  explicit ByteLoader(Reader& in) : in_(in) {}

  template <typename... T>
  void values(T&... values) {
    ((values = in_.template get<T>()), ...);
  }
  template <typename T, typename Value>
  void value_as(Value& value) {
    value = static_cast<Value>(in_.template get<T>());
  }
  template <typename... Lists>
  void lists(Lists&... lists) {
    ((lists = in_.template copy_list<typename Lists::value_type, Lists>()), ...);
  }
  /// @param least_bytes_each  what every item takes at least
  template <typename Items>
  void length(Items& items, std::size_t least_bytes_each) {
    items.resize(in_.get_count(least_bytes_each));
  }

 private:
  Reader& in_;
};

/// Walks through the items of a list, each of which takes `least_bytes_each` at least.
template <typename Archive, typename Items>
void pass_all(Archive& archive, Items& items, std::size_t least_bytes_each = sizeof(std::uint64_t)) {
  archive.length(items, least_bytes_each);
  for (auto& item : items) pass(archive, item);
}

}  // namespace hallway
