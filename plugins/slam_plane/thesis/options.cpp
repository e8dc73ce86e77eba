// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/options.hpp"

namespace hallway::slam_plane::thesis {
namespace {

constexpr OptionRow<Options> kParameters[] = {
    {"thesis_match_angle_deg", "deg", 0.1, 60.0,
     "mode=thesis: largest angle between a plane observation and its plane.", &Options::match_angle_deg},
    {"thesis_match_distance_m", "m", 1e-3, 10.0,
     "mode=thesis: largest difference of the distances of an observation and of a plane seen in the last "
     "frames.",
     &Options::match_distance_m},
    {"thesis_recent_iterations", "iterations", 1, 1000,
     "mode=thesis: a plane unseen for longer is searched in the map only.", &Options::recent_iterations},
    {"thesis_map_distance_m", "m", 1e-3, 10.0,
     "mode=thesis: largest distance between an observation and a plane of the map.",
     &Options::map_distance_m},
    {"thesis_storage", "observations", 50, 16384, "mode=thesis: how many observations of a plane are kept.",
     &Options::storage},
    {"thesis_trend_hysteresis_m", "m", 1e-4, 1.0,
     "mode=thesis: change of a plane's length that distinguishes growing from shrinking.",
     &Options::trend_hysteresis_m},
    {"thesis_max_deviation_m", "m", 1e-4, 10.0,
     "mode=thesis: least standard deviation of a comparison above which no end is static.",
     &Options::max_deviation_m},
    {"thesis_close_ratio", "1", 1.0, 100.0,
     "mode=thesis: standard deviations, and times, up to this ratio count as equal.", &Options::close_ratio},
    {"thesis_min_readings", "observations", 2, 1000, "mode=thesis: of a plane before it joins a submap.",
     &Options::min_readings},
    {"thesis_link_planes", "planes", 2, 20,
     "mode=thesis: how many members a new submap takes over from an older one.", &Options::link_planes},
    {"thesis_min_interval", "iterations", 2, 1000,
     "mode=thesis: over how many a member of a submap must be compared.", &Options::min_interval},
    {"thesis_judge_after", "iterations", 2, 1000,
     "mode=thesis: when that is checked, after the member has joined.", &Options::judge_after},
    {"thesis_max_references", "submaps", 1, 1000,
     "mode=thesis: a plane in this many submaps begins no further one when it is met again.",
     &Options::max_references},
    {"thesis_reorder_every", "iterations", 1, 1000,
     "mode=thesis: how often the order of a submap's comparisons is rebuilt.", &Options::reorder_every},
    {"thesis_motion_after", "iterations", 1, 1000,
     "mode=thesis: iterations without a position before the motion model begins.", &Options::motion_after},
    {"thesis_motion_parallel_deg", "deg", 0.1, 89.0,
     "mode=thesis: a wall at a smaller angle to the motion does not measure it.",
     &Options::motion_parallel_deg},
    {"thesis_roll_back_limit", "iterations", 0, 500, "mode=thesis: the longest roll back; 0: never.",
     &Options::roll_back_limit},
};

}  // namespace

MatchOptions Options::match() const {
  MatchOptions options;
  options.angle_deg = match_angle_deg;
  options.distance_m = match_distance_m;
  options.recent_iterations = recent_iterations;
  return options;
}

MatchOptions Options::map_match() const {
  MatchOptions options = match();
  options.distance_m = map_distance_m;
  return options;
}

TrackOptions Options::track() const {
  TrackOptions options;
  options.capacity = storage;
  options.trend_hysteresis_m = trend_hysteresis_m;
  return options;
}

CompareOptions Options::compare() const {
  CompareOptions options;
  options.max_deviation_m = max_deviation_m;
  options.close_ratio = close_ratio;
  return options;
}

std::span<const OptionRow<Options>> parameters() {
  return kParameters;
}

void Options::validate() const {
  check_options(*this, parameters());
}

}  // namespace hallway::slam_plane::thesis
