// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "support/process.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {

/// A map with one block beside a straight path, and a cloud of points around the path.
inline std::string small_map() {
  return R"({
"classname" "worldspawn"
"_hallway" "1"
"_scale" "0.01"
{
( 0 500 0 ) ( 0 700 0 ) ( 0 500 100 ) wall [ 0 1 0 0 ] [ 0 0 -1 0 ] 0 1 1
( 100 500 0 ) ( 100 500 100 ) ( 100 700 0 ) wall [ 0 1 0 0 ] [ 0 0 -1 0 ] 0 1 1
( 0 500 0 ) ( 0 500 100 ) ( 100 500 0 ) wall [ 1 0 0 0 ] [ 0 0 -1 0 ] 0 1 1
( 0 700 0 ) ( 100 700 0 ) ( 0 700 100 ) wall [ 1 0 0 0 ] [ 0 0 -1 0 ] 0 1 1
( 0 500 0 ) ( 100 500 0 ) ( 0 700 0 ) wall [ 1 0 0 0 ] [ 0 -1 0 0 ] 0 1 1
( 0 500 100 ) ( 0 700 100 ) ( 100 500 100 ) wall [ 1 0 0 0 ] [ 0 -1 0 0 ] 0 1 1
}
}
{
"classname" "hw_path"
"name" "straight"
"origin" "0 0 0"
}
{
"classname" "hw_waypoint"
"path" "straight"
"index" "0"
"origin" "0 0 0"
}
{
"classname" "hw_waypoint"
"path" "straight"
"index" "1"
"origin" "6000 0 0"
}
{
"classname" "hw_landmark_cloud"
"name" "cloud"
"path" "straight"
"per_100m" "60"
"sideways_m" "12"
"height_m" "4"
"seed" "3"
}
)";
}

/// A scenario in small_map(), with a few seconds of driving.
inline std::string small_scenario() {
  return R"(map = "small.map"
seed = 5
steps = 60
period_s = 0.1

[robot]
path = "straight"
speed_m_s = 3.0

[sensor.eyes]
kind = "points"
horizontal_fov_deg = 90
vertical_fov_deg = 60
max_range_m = 60
noise_m = 0.05

[[plugin]]
name = "slam_point"
)";
}

/// A folder with small_map() and small_scenario(), and where runs go.
class SmallWorld {
 public:
  SmallWorld() {
    folder_.write("small.map", small_map());
    scenario_ = folder_.write("small.toml", small_scenario());
  }
  const TempFolder& folder() const { return folder_; }
  std::string scenario() const { return scenario_; }
  std::string out(const std::string& name = "run") const { return folder_.path() / "out" / name; }

  /// `hallway run` of the scenario with more arguments.
  Ended run(const std::vector<std::string>& more = {}, const std::string& name = "run") const {
    std::vector<std::string> arguments{"run", scenario(), "--out", out(name)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return hallway(arguments);
  }

 private:
  TempFolder folder_;
  std::filesystem::path scenario_;
};

/// Replaces the first `what` in `text`.
inline std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  return at == std::string::npos ? text : text.replace(at, what.size(), with);
}

}  // namespace hallway::test
