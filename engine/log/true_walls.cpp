// SPDX-License-Identifier: MIT
#include "log/true_walls.hpp"

#include <algorithm>
#include <utility>

#include "base/file.hpp"
#include "log/csv_reader.hpp"
#include "log/hull_field.hpp"
#include "log/row_writer.hpp"
#include "log/unique_ids.hpp"

namespace hallway::log {
namespace {

enum Column : std::size_t { kId, kCorners, kHull = kCorners + 12 };

std::vector<CsvColumn> columns() {
  return {{"wall_id"}, {"x0"}, {"y0"}, {"z0"}, {"x1"}, {"y1"}, {"z1"},
          {"x2"},      {"y2"}, {"z2"}, {"x3"}, {"y3"}, {"z3"}, {"hull", false}};
}

}  // namespace

std::vector<TrueWall> parse_true_walls(std::string_view text, const std::string& file) {
  CsvReader row(text, file, columns());
  std::vector<TrueWall> walls;
  UniqueIds ids;
  while (row.next()) {
    TrueWall wall{.id = ids.read(row, kId), .corners_m = {}, .hull_m = read_hull(row, kHull)};
    for (std::size_t i = 0; i < 4; ++i) wall.corners_m[i] = row.vector(kCorners + 3 * i);
    walls.push_back(std::move(wall));
  }
  return walls;
}

std::vector<TrueWall> read_true_walls(const std::filesystem::path& path) {
  return parse_true_walls(read_file(path), path.string());
}

std::string print_true_walls(std::span<const TrueWall> walls) {
  RowWriter out(',');
  const bool hulls =
      std::any_of(walls.begin(), walls.end(), [](const TrueWall& wall) { return !wall.hull_m.empty(); });
  for (const CsvColumn& column : columns()) {
    if (column.required || hulls) out.word(column.name);
  }
  out.end_row();
  for (const TrueWall& wall : walls) {
    out.whole(wall.id);
    for (const auto& corner : wall.corners_m) out.numbers(corner);
    if (hulls) out.word(hull_text(wall.hull_m));
    out.end_row();
  }
  return out.take();
}

void write_true_walls(const std::filesystem::path& path, std::span<const TrueWall> walls) {
  write_file_atomically(path, print_true_walls(walls));
}

}  // namespace hallway::log
