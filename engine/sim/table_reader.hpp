// SPDX-License-Identifier: MIT
#pragma once

#include "base/table_reader.hpp"
#include "geom/arrays.hpp"

namespace hallway::sim {

using hallway::Range;

/// Reads the keys of one table of a scenario.
class TableReader : public hallway::TableReader {
 public:
  using hallway::TableReader::TableReader;

  /// A list of three numbers.
  Vec3 vector(std::string_view key, const Range& range) { return to_vec3(numbers(key, range)); }
  Vec3 vector(std::string_view key, const Range& range, const Vec3& fallback) {
    return to_vec3(numbers(key, range, to_array(fallback)));
  }
  /// A list of three numbers, or one number for all three.
  Vec3 vector_or_one(std::string_view key, const Range& range, const Vec3& fallback) {
    return to_vec3(numbers_or_one(key, range, to_array(fallback)));
  }
};

}  // namespace hallway::sim
