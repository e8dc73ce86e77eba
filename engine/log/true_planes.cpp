// SPDX-License-Identifier: MIT
#include "log/true_planes.hpp"

#include "base/file.hpp"
#include "log/csv_reader.hpp"
#include "log/plane_fields.hpp"
#include "log/plane_names.hpp"
#include "log/row_writer.hpp"
#include "log/unique_ids.hpp"

namespace hallway::log {
namespace {

enum Column : std::size_t { kId, kCorners, kHull = kCorners + 12 };

std::vector<CsvColumn> columns() {
  return {{plane_names::kTruePlaneColumn},
          {"x0"},
          {"y0"},
          {"z0"},
          {"x1"},
          {"y1"},
          {"z1"},
          {"x2"},
          {"y2"},
          {"z2"},
          {"x3"},
          {"y3"},
          {"z3"},
          {"hull", false}};
}

}  // namespace

std::vector<TruePlane> parse_true_planes(std::string_view text, const std::string& file) {
  CsvReader row(text, file, columns());
  std::vector<TruePlane> planes;
  UniqueIds ids;
  while (row.next()) {
    TruePlane& plane = planes.emplace_back();
    plane.id = ids.read(row, kId);
    plane.hull_m = read_hull(row, kHull);
    plane.corners_m = read_corners(row, kCorners);
  }
  return planes;
}

std::vector<TruePlane> read_true_planes(const std::filesystem::path& path) {
  return parse_true_planes(read_file(path), path.string());
}

std::string print_true_planes(std::span<const TruePlane> planes) {
  RowWriter out(',');
  const bool hulls = any_hull(planes);
  for (const CsvColumn& column : columns()) {
    if (column.required || hulls) out.word(column.name);
  }
  out.end_row();
  for (const TruePlane& plane : planes) {
    out.whole(plane.id);
    for (const auto& corner : plane.corners_m) out.numbers(corner);
    if (hulls) out.word(hull_text(plane.hull_m));
    out.end_row();
  }
  return out.take();
}

void write_true_planes(const std::filesystem::path& path, std::span<const TruePlane> planes) {
  write_file_atomically(path, print_true_planes(planes));
}

}  // namespace hallway::log
