// SPDX-License-Identifier: MIT
#pragma once

#include "base/table_reader.hpp"
#include "geometry/se3.hpp"

namespace hallway::sim {

using hallway::Range;

/// Reads the keys of one table of a scenario.
class TableReader : public hallway::TableReader {
 public:
  using hallway::TableReader::TableReader;

  /// A list of three numbers.
  Vec3 vector(std::string_view key, const Range& range) { return vector_of(numbers(key, range)); }
  Vec3 vector(std::string_view key, const Range& range, const Vec3& fallback) {
    return vector_of(numbers(key, range, numbers_of(fallback)));
  }
  /// A list of three numbers, or one number for all three.
  Vec3 vector_or_one(std::string_view key, const Range& range, const Vec3& fallback) {
    return vector_of(numbers_or_one(key, range, numbers_of(fallback)));
  }

 private:
  static Vec3 vector_of(const Numbers3& numbers) { return {numbers[0], numbers[1], numbers[2]}; }
  static Numbers3 numbers_of(const Vec3& vector) { return {vector.x(), vector.y(), vector.z()}; }
};

}  // namespace hallway::sim
