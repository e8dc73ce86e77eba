// SPDX-License-Identifier: MIT
#include "sim/pattern_file.hpp"

#include <cstddef>
#include <numbers>

#include "base/file.hpp"
#include "base/text.hpp"
#include "log/csv_reader.hpp"

namespace hallway::sim {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;
constexpr std::uint64_t kMaxRing = 65'535;

enum PatternColumn : std::size_t { kAzimuth, kElevation, kTime, kRing };

/// A number within [-most, most].
double angle_of(const log::CsvReader& row, PatternColumn column, double most_deg) {
  const double angle_deg = row.number(column);
  if (angle_deg < -most_deg || angle_deg > most_deg)
    throw row.bad_field(column, "from -" + format_double(most_deg) + " to " + format_double(most_deg));
  return angle_deg * kRadians;
}

}  // namespace

sense::RayPattern parse_pattern(std::string_view text, const std::string& file, double scan_s) {
  log::CsvReader row(text, file, {{"azimuth_deg"}, {"elevation_deg"}, {"t_s"}, {"ring", false}});
  sense::RayPattern pattern;
  while (row.next()) {
    if (pattern.rays.size() == sense::kMostRays)
      throw row.error("a scan has more than " + std::to_string(sense::kMostRays) + " beams");
    const double t_s = row.number(kTime), share = t_s / scan_s;
    if (!(share >= 0.0 && share < 1.0))
      throw row.bad_field(kTime, "from 0 to below " + format_double(scan_s) + ", the time of a scan");
    pattern.rays.push_back({angle_of(row, kAzimuth, 360.0), angle_of(row, kElevation, 90.0), share,
                            row.has(kRing) ? static_cast<std::uint32_t>(row.whole(kRing, kMaxRing)) : 0});
  }
  if (pattern.rays.empty()) throw row.error("there is no beam");
  return pattern;
}

sense::RayPattern read_pattern_file(const std::filesystem::path& file, double scan_s) {
  return parse_pattern(read_file(file), file.string(), scan_s);
}

}  // namespace hallway::sim
