// SPDX-License-Identifier: MIT
#include "sim/default_scenario.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "base/toml_text.hpp"
#include "map/entities.hpp"
#include "map/path.hpp"
#include "map/sensors.hpp"

namespace hallway::sim {
namespace {

constexpr double kDefaultSpeed_m_s = 1.0;
constexpr double kDefaultPeriod_s = 0.1;
constexpr std::uint32_t kStepsWithoutPath = 100;

std::string joined(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "`" : ", `") + printable(name, 60) + "`";
  return out;
}

/// Writes the tables of one scenario, one after the other.
class Writer {
 public:
  Writer(const map::Document& document, const std::string& map_file)
      : document_(document), map_file_(map_file), paths_(map::path_names(document)) {}

  DefaultScenario write() {
    if (paths_.empty() && !map::find_robot_start(document_)) {
      throw Error(ErrorCode::kBadInput,
                  "the map has neither a path nor a robot start; `hallway edit MAP help path` and `help "
                  "start` explain both",
                  {.file = printable(document_.file)});
    }
    write_top();
    write_robot();
    write_sensors();
    write_plugin();
    made_.text +=
        "\n[[picture]]\nfile = \"top.png\"\nview = \"top\"\nshow = [\"map\", \"truth\", \"estimate\", "
        "\"landmarks\", \"errors\"]\n";
    return std::move(made_);
  }

 private:
  /// @param unless  settings that make it untrue
  void assume(std::string sentence, std::vector<std::string> unless = {}) {
    made_.text += "# " + sentence + "\n";
    made_.assumed.push_back({std::move(sentence), std::move(unless)});
  }

  std::uint32_t steps() const {
    if (paths_.empty()) return kStepsWithoutPath;
    constexpr double kMost = 1e6;
    const double length_m = map::find_path(document_, paths_.front()).length_m();
    return static_cast<std::uint32_t>(
               std::clamp(std::ceil(length_m / (kDefaultSpeed_m_s * kDefaultPeriod_s)), 1.0, kMost)) +
           1;
  }

  void write_top() {
    made_.text =
        "# Made by `hallway scenario new` for a map without a scenario. docs/formats.md explains every key.\n"
        "schema = \"hallway.scenario/1\"\n";
    made_.text += "map = " + toml_text(map_file_) + "\n";
    made_.text += "seed = 1            # of the sensors' noise\n";
    made_.text += "period_s = " + format_double(kDefaultPeriod_s) + "      # from frame to frame\n";
    made_.text += "steps = " + std::to_string(steps()) + "         # frames\n";
  }

  void write_robot() {
    made_.text += "\n[robot]\n";
    if (paths_.empty()) {
      assume("The map has no path: the robot stays at its hw_robot_start.", {"robot.path"});
      assume("The run has " + std::to_string(kStepsWithoutPath) + " frames.", {"robot.path", "steps"});
      return;
    }
    assume(
        (paths_.size() == 1 ? "The robot follows the map's path `" + printable(paths_.front(), 60) + "`"
                            : "The map has the paths " + joined(paths_) + ": the robot follows the first") +
            " once, at " + format_double(kDefaultSpeed_m_s) + " m/s.",
        {"robot.path", "robot.speed_m_s", "robot.loop_steps"});
    made_.text +=
        "path = " + toml_text(paths_.front()) + "\nspeed_m_s = " + format_double(kDefaultSpeed_m_s) + "\n";
  }

  void write_sensors() {
    std::vector<std::string> names;
    for (const map::Entity* sensor : map::sensors(document_)) {
      names.push_back(map::EntityKeys(document_, *sensor).text("name"));
      const std::string* kind = sensor->find("kind");
      kinds_.insert(kind != nullptr ? *kind : "points");
    }
    made_.text += "\n";
    if (!names.empty()) {
      made_.text += "# The sensors are those of the map: " + joined(names) + ".\n";
    } else {
      kinds_.insert("points");
      assume("The map has no hw_sensor: the robot has a sensor of points that looks 12 m ahead.");
      made_.text +=
          "[sensor.eyes]\nkind = \"points\"\nhorizontal_fov_deg = 90\nvertical_fov_deg = 60\nmin_range_m = "
          "0.1\n"
          "max_range_m = 12\nnoise_m = 0.01      # standard deviation along each axis\n";
    }
    if (!kinds_.contains("points") || has_points()) return;
    assume(
        "The map has no points for sensors of points: worldspawn's `_points_per_m2` or an hw_landmark_cloud "
        "makes some.");
  }

  bool has_points() const {
    if (map::face_points(document_).per_m2 > 0.0 || !map::landmark_clouds(document_).empty()) return true;
    return std::any_of(document_.entities.begin(), document_.entities.end(),
                       [](const map::Entity& entity) { return entity.find("_points_per_m2") != nullptr; });
  }

  /// Empty: none.
  std::string plugin_for_sensors() const {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kPlugins{
        {{"points", "slam_point"},
         {"planes", "slam_plane"},
         {"faces", "slam_plane"},
         {"lidar", "icp"},
         {"encoders", "dead_reckoning"},
         {"odometry", "dead_reckoning"}}};
    for (const auto& [kind, plugin] : kPlugins) {
      if (kinds_.contains(kind)) return std::string(plugin);
    }
    return {};
  }

  void write_plugin() {
    const std::string plugin = plugin_for_sensors();
    made_.text += "\n";
    if (plugin.empty()) {
      assume("No plugin is for these sensors alone: the run records them. `--plugin NAME` runs one.",
             {"plugin"});
      return;
    }
    assume("The plugin is `" + plugin + "`; `--plugin NAME` runs another one.", {"plugin"});
    made_.text += "[[plugin]]\nname = " + toml_text(plugin) + "\n";
  }

  const map::Document& document_;
  std::string map_file_;
  std::vector<std::string> paths_;
  std::set<std::string, std::less<>> kinds_;  ///< of the sensors
  DefaultScenario made_;
};

}  // namespace

DefaultScenario default_scenario(const map::Document& document, const std::string& map_file) {
  constexpr std::size_t kLongest = 8192;
  if (printable(map_file, kLongest) != map_file) {
    throw Error(ErrorCode::kBadInput, "a scenario cannot name this map: its name is no printable UTF-8",
                {.file = printable(document.file)});
  }
  return Writer(document, map_file).write();
}

}  // namespace hallway::sim
