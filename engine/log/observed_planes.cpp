// SPDX-License-Identifier: MIT
#include "log/observed_planes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/file.hpp"
#include "base/text.hpp"
#include "log/csv_reader.hpp"
#include "log/hull_field.hpp"
#include "log/row_writer.hpp"

namespace hallway::log {
namespace {

constexpr std::array<std::string_view, 19> kGeometry{"nx", "ny", "nz", "offset_m", "cx", "cy", "cz",
                                                     "x0", "y0", "z0", "x1",       "y1", "z1", "x2",
                                                     "y2", "z2", "x3", "y3",       "z3"};

enum Column : std::size_t {
  kIteration,
  kWall,
  kNormal,
  kOffset = kNormal + 3,
  kCentroid,
  kCorners = kCentroid + 3,
  kHull = kCorners + 12
};

std::vector<CsvColumn> columns() {
  std::vector<CsvColumn> names{{"iteration"}, {"wall_id", false}};
  for (const std::string_view name : kGeometry) names.push_back({name});
  names.push_back({"hull", false});
  return names;
}

bool is_empty_frame(const CsvReader& row) {
  for (std::size_t i = 0; i < kGeometry.size(); ++i) {
    if (!row.text(kNormal + i).empty()) return false;
  }
  return row.text(kWall).empty();
}

bool tells_hulls(const ObservedPlaneLog& log) {
  const auto& all = log.all();
  return std::any_of(all.begin(), all.end(), [](const ObservedPlane& seen) { return !seen.hull_m.empty(); });
}

ObservedPlane read_plane(const CsvReader& row) {
  ObservedPlane observed;
  observed.wall = row.landmark_or_none(kWall);
  Plane& plane = observed.plane;
  plane.normal = row.vector(kNormal);
  plane.offset_m = row.number(kOffset);
  plane.centroid_m = row.vector(kCentroid);
  for (std::size_t i = 0; i < 4; ++i) plane.corners_m[i] = row.vector(kCorners + 3 * i);
  plane.exclusive_share = 1.0;
  observed.hull_m = read_hull(row, kHull);
  return observed;
}

}  // namespace

bool is_of_planes(std::string_view text) {
  const std::string_view header = text.substr(0, text.find('\n'));
  const std::vector<std::string_view> names = split(header, ',');
  return std::any_of(names.begin(), names.end(),
                     [](std::string_view name) { return trim(name) == "offset_m"; });
}

ReadPlaneLog parse_observed_planes(std::string_view text, const std::string& file) {
  CsvReader row(text, file, columns());
  FrameRows<ObservedPlaneLog, ObservedPlane> rows(ObservedPlaneLog(row.has(kWall)), "a plane");
  std::uint64_t iteration = 0, place = 0;  // the table does not number the planes of a frame
  auto damage = rows.read_all(
      row, kIteration, [&] { return is_empty_frame(row); },
      [&] {
        const std::uint64_t present = row.whole(kIteration, kMaxIteration);
        place = present == iteration ? place : 0;
        iteration = present;
        ObservedPlane observed = read_plane(row);
        observed.plane.id = place++;
        return observed;
      });
  return {rows.finish(), std::move(damage)};
}

std::string describe(const Damage& damage, const ObservedPlaneLog& kept, const std::string& file) {
  return fmt::format("{}:{}: {}; kept what stands before: {} planes, iterations below {}", file, damage.line,
                     damage.cause, kept.all().size(), kept.iterations());
}

std::string print_observed_planes(const ObservedPlaneLog& log) {
  RowWriter out(',');
  out.word("iteration");
  if (log.has_identities()) out.word("wall_id");
  for (const std::string_view name : kGeometry) out.word(name);
  const bool hulls = tells_hulls(log);
  if (hulls) out.word("hull");
  out.end_row();
  for (const std::uint32_t iteration : log.filled_iterations()) {
    for (const ObservedPlane& observed : log.frame(iteration)) {
      out.whole(iteration);
      if (log.has_identities() && observed.wall == kNoLandmark) out.word("-1");
      if (log.has_identities() && observed.wall != kNoLandmark) out.whole(observed.wall);
      const Plane& plane = observed.plane;
      out.numbers(plane.normal).number(plane.offset_m).numbers(plane.centroid_m);
      for (const auto& corner : plane.corners_m) out.numbers(corner);
      if (hulls) out.word(hull_text(observed.hull_m));
      out.end_row();
    }
  }
  // Empty frames need no row but the last one, without which the log would seem to end earlier.
  if (log.iterations() > 0 && log.frame(log.iterations() - 1).empty()) {
    out.whole(log.iterations() - 1);
    if (log.has_identities()) out.word("");
    for (std::size_t i = 0; i < kGeometry.size(); ++i) out.word("");
    if (hulls) out.word("");
    out.end_row();
  }
  return out.take();
}

void write_observed_planes(const std::filesystem::path& path, const ObservedPlaneLog& log) {
  write_file_atomically(path, print_observed_planes(log));
}

}  // namespace hallway::log
