// SPDX-License-Identifier: MIT
#include "import/victoria_park.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "import/true_track.hpp"
#include "import/words.hpp"
#include "log/csv_reader.hpp"
#include "log/observations.hpp"

namespace hallway::import {
namespace {

namespace fs = std::filesystem;

struct Scan {
  std::uint64_t number = 0;
  std::int64_t t_ns = 0;
  std::uint64_t trees = 0;
  std::size_t first = 0;  ///< of its points
};

std::int64_t time_in(const log::CsvReader& rows, std::size_t column) {
  const auto t_ns = parse_seconds(rows.text(column));
  if (!t_ns) throw rows.bad_field(column, "a time in seconds below 9e9");
  return *t_ns;
}

std::vector<Scan> read_scans(const fs::path& path) {
  enum Column { kScan, kTime, kTrees };
  const std::string text = read_file(path);
  log::CsvReader rows(text, printable(path.string(), 4096), {{"scan"}, {"t_s"}, {"n_trees"}});
  std::vector<Scan> scans;
  std::size_t trees = 0;
  while (rows.next()) {
    constexpr std::uint64_t kMaxTrees = 1'000'000;
    const Scan scan{rows.whole(kScan, log::kMaxIteration), time_in(rows, kTime),
                    rows.whole(kTrees, kMaxTrees), trees};
    if (!scans.empty() && scan.number <= scans.back().number) throw rows.bad_field(kScan, "a higher number");
    if (!scans.empty() && scan.t_ns < scans.back().t_ns)
      throw rows.bad_field(kTime, "a time not before the last");
    scans.push_back(scan);
    trees += static_cast<std::size_t>(scan.trees);
  }
  if (scans.empty()) throw rows.error("has no scans");
  return scans;
}

/// The points of all scans, one after the other.
PointList read_trees(const fs::path& path, const std::vector<Scan>& scans) {
  enum Column { kScan, kRange, kBearing };
  const std::string text = read_file(path);
  log::CsvReader rows(text, printable(path.string(), 4096), {{"scan"}, {"range_m"}, {"bearing_rad"}});
  PointList points;
  std::size_t scan = 0;
  const auto full = [&] { return points.size() == scans[scan].first + scans[scan].trees; };
  while (rows.next()) {
    while (full() && scan + 1 < scans.size()) ++scan;
    if (full() || rows.whole(kScan, log::kMaxIteration) != scans[scan].number) {
      throw rows.bad_field(kScan,
                           fmt::format("tree {} of {} of scan {}", points.size() - scans[scan].first + 1,
                                       scans[scan].trees, scans[scan].number));
    }
    const double range = rows.number(kRange), bearing = rows.number(kBearing);
    points.push_back({range * std::cos(bearing), range * std::sin(bearing), 0.0});
  }
  if (const std::size_t needed = scans.back().first + scans.back().trees; points.size() != needed) {
    throw rows.error(fmt::format("ends after {} of {} trees", points.size(), needed));
  }
  return points;
}

TrueTrack read_fixes(const fs::path& path, std::int64_t within_ns) {
  enum Column { kTime, kEast, kNorth };
  std::error_code code;
  if (!fs::exists(path, code)) return {};
  const std::string text = read_file(path);
  log::CsvReader rows(text, printable(path.string(), 4096), {{"t_s"}, {"east_lo_m"}, {"north_la_m"}});
  std::vector<TimedPose> fixes;
  while (rows.next()) {
    const std::int64_t t_ns = time_in(rows, kTime);
    if (!fixes.empty() && t_ns <= fixes.back().t_ns) throw rows.bad_field(kTime, "a time after the last");
    fixes.push_back({t_ns, {Quat::Identity(), Vec3(rows.number(kEast), rows.number(kNorth), 0.0)}});
  }
  return {std::move(fixes), within_ns};
}

class VictoriaPark : public Recording {
 public:
  VictoriaPark(std::vector<Scan> scans, PointList trees, TrueTrack fixes)
      : scans_(std::move(scans)), trees_(std::move(trees)), fixes_(std::move(fixes)) {}

  std::uint32_t frames() const override { return static_cast<std::uint32_t>(scans_.size()); }
  void read(std::uint32_t index, Frame& frame) override {
    const Scan& scan = scans_[index];
    frame.t_ns = scan.t_ns;
    const auto first = trees_.begin() + static_cast<std::ptrdiff_t>(scan.first);
    frame.points.assign(first, first + static_cast<std::ptrdiff_t>(scan.trees));
    frame.not_finite = 0;
    frame.T_world_body = fixes_.at(scan.t_ns);
    frame.orientation_known = false;
  }
  std::int64_t period_ns() const override {
    constexpr std::int64_t kUsual_ns = 214'000'000;
    return mean_period_ns(scans_.front().t_ns, scans_.back().t_ns, scans_.size(), kUsual_ns);
  }
  std::string sensor() const override { return "laser"; }
  bool has_truth() const override { return !fixes_.empty(); }

 private:
  std::vector<Scan> scans_;
  PointList trees_;
  TrueTrack fixes_;
};

}  // namespace

std::unique_ptr<Recording> open_victoria_park(const fs::path& folder, const VictoriaParkOptions& options) {
  std::vector<Scan> scans = read_scans(folder / "scans.csv");
  PointList trees = read_trees(folder / "observations.csv", scans);
  return std::make_unique<VictoriaPark>(std::move(scans), std::move(trees),
                                        read_fixes(folder / "gps.csv", options.truth_within_ns));
}

}  // namespace hallway::import
