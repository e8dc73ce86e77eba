// SPDX-License-Identifier: MIT
#include "log/planes.hpp"

#include <algorithm>

#include "log/csv_reader.hpp"
#include "log/observations.hpp"

namespace hallway::log {
namespace {

enum Column : std::size_t {
  kIteration,
  kId,
  kNormal,
  kOffset = kNormal + 3,
  kCentroid,
  kCorners = kCentroid + 3,
  kPoints = kCorners + 12,
  kRms,
  kExclusiveShare
};

std::vector<CsvColumn> columns() {
  std::vector<CsvColumn> names;
  for (std::string_view rest = kPlaneColumns; !rest.empty();) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    names.push_back({rest.substr(0, comma)});
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return names;
}

Plane read_plane(const CsvReader& row) {
  Plane plane;
  plane.id = row.whole(kId, UINT64_MAX);
  plane.normal = row.vector(kNormal);
  plane.offset_m = row.number(kOffset);
  plane.centroid_m = row.vector(kCentroid);
  for (std::size_t i = 0; i < 4; ++i) plane.corners_m[i] = row.vector(kCorners + 3 * i);
  plane.points = row.whole(kPoints, UINT64_MAX);
  plane.rms_m = row.number(kRms);
  plane.exclusive_share = row.number(kExclusiveShare);
  return plane;
}

}  // namespace

std::vector<IterationPlane> parse_planes(std::string_view text, const std::string& file) {
  CsvReader row(text, file, columns());
  std::vector<IterationPlane> planes;
  while (row.next()) {
    const auto iteration = static_cast<std::uint32_t>(row.whole(kIteration, kMaxIteration));
    if (!planes.empty() && iteration < planes.back().iteration)
      throw row.bad_field(kIteration, "an iteration not before that of the row above");
    planes.push_back({iteration, read_plane(row)});
  }
  return planes;
}

void add_row(RowWriter& out, const IterationPlane& row) {
  const Plane& plane = row.plane;
  out.whole(row.iteration).whole(plane.id).numbers(plane.normal).number(plane.offset_m);
  out.numbers(plane.centroid_m);
  for (const auto& corner : plane.corners_m) out.numbers(corner);
  out.whole(plane.points).number(plane.rms_m).number(plane.exclusive_share).end_row();
}

std::string print_planes(std::span<const IterationPlane> planes) {
  RowWriter out(',');
  out.word(kPlaneColumns).end_row();
  for (const IterationPlane& plane : planes) add_row(out, plane);
  return out.take();
}

}  // namespace hallway::log
