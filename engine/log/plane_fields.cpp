// SPDX-License-Identifier: MIT
#include "log/plane_fields.hpp"

#include <cmath>
#include <optional>
#include <string_view>

#include "base/text.hpp"

namespace hallway::log {

std::array<std::array<double, 3>, 4> read_corners(const CsvReader& row, std::size_t first_column) {
  std::array<std::array<double, 3>, 4> corners{};
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = row.vector(first_column + 3 * i);
  return corners;
}

std::vector<std::array<double, 3>> read_hull(const CsvReader& row, std::size_t column) {
  std::vector<std::array<double, 3>> hull;
  const std::string_view text = row.text(column);
  if (text.empty()) return hull;
  const auto bad = [&] { return row.bad_field(column, "the corners of a hull, three finite numbers each"); };
  const std::vector<std::string_view> numbers = split(text, ' ');
  if (numbers.size() < 9 || numbers.size() % 3 != 0) throw bad();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::optional<double> value = parse_double(numbers[i]);
    if (!value || !std::isfinite(*value)) throw bad();
    if (i % 3 == 0) hull.emplace_back();
    hull.back()[i % 3] = *value;
  }
  return hull;
}

std::string hull_text(std::span<const std::array<double, 3>> hull_m) {
  std::string text;
  for (const auto& point : hull_m) {
    for (const double value : point) text += (text.empty() ? "" : " ") + format_double(value);
  }
  return text;
}

}  // namespace hallway::log
