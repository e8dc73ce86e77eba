// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace hallway::import {

/// The part of YAML that the files of sensors in the ASL layout (EuRoC) use, read strictly: lines `key: value`, of which one level may be indented below a
/// `key:` without a value; values are plain or quoted texts, numbers, and lists `[a, b]` that may go on over lines; comments from `#`. A line `%YAML` or
/// `---` at the beginning and the tag `!!opencv-matrix` are passed over. Indented keys are called KEY.INDENTED here.
///
/// All functions throw Error{kBadInput} with file and line. The constructor does so at the first line that is anything else.
class FlatYaml {
 public:
  FlatYaml(std::string_view text, const std::string& file);

  bool has(std::string_view key) const { return entry(key) != nullptr; }
  /// A text, without its quotes.
  const std::string& text(std::string_view key) const;
  /// A number from `low` to `high`.
  double number(std::string_view key, double low, double high) const;
  /// A list of `count` finite numbers.
  std::vector<double> numbers(std::string_view key, std::size_t count) const;
  /// An error at the line of a key.
  Error error(std::string_view key, const std::string& message) const;

 private:
  struct Entry {
    std::string key;
    std::string value;  ///< of a list: what is between the brackets
    bool list = false;
    int line = 0;
  };
  class Parser;

  const Entry* entry(std::string_view key) const;
  const Entry& require(std::string_view key, bool list) const;

  std::string file_;
  std::vector<Entry> entries_;
};

}  // namespace hallway::import
