// SPDX-License-Identifier: MIT
#include "import/point_records.hpp"

#include <fmt/format.h>

#include "base/text.hpp"
#include "import/words.hpp"

namespace hallway::import {

Coordinate* coordinate_named(Coordinates& coordinates, std::string_view name) {
  constexpr std::string_view kNames = "xyz";
  if (name.size() != 1) return nullptr;
  const std::size_t axis = kNames.find(name.front());
  return axis < coordinates.size() ? &coordinates[axis] : nullptr;
}

void read_binary_points(std::string_view bytes, std::uint64_t count, const Coordinates& coordinates,
                        ByteOrder order, PointCollector& out) {
  const auto value = [&](const Coordinate& coordinate, std::uint64_t point) {
    return read_scalar(bytes.data() + coordinate.begin + point * coordinate.step, coordinate.type, order);
  };
  for (std::uint64_t i = 0; i < count; ++i) {
    out.add(value(coordinates[0], i), value(coordinates[1], i), value(coordinates[2], i));
  }
}

void read_text_points(WordLines& lines, std::uint64_t count, std::size_t words,
                      const Coordinates& coordinates, PointCollector& out) {
  const auto value = [&](const Coordinate& coordinate) {
    const std::string_view word = lines.words()[coordinate.word];
    const auto number = parse_coordinate(word);
    if (!number) throw lines.error(fmt::format("a number is needed, \"{}\" found", printable(word, 40)));
    return *number;
  };
  for (std::uint64_t i = 0; i < count; ++i) {
    if (!lines.next()) throw lines.error(fmt::format("the file ends after {} of {} points", i, count));
    if (lines.words().size() != words) {
      throw lines.error(fmt::format("{} numbers where a point has {}", lines.words().size(), words));
    }
    const double x = value(coordinates[0]), y = value(coordinates[1]), z = value(coordinates[2]);
    out.add(x, y, z);
  }
}

}  // namespace hallway::import
