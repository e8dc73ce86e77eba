// SPDX-License-Identifier: MIT
#include "sim/simulator.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "map/entities.hpp"
#include "map/reader.hpp"
#include "sense/landmarks.hpp"
#include "sense/occluders.hpp"

namespace hallway::sim {
namespace {

double find_step_length(const Scenario& scenario, const map::Path& path) {
  if (scenario.robot.loop_steps) return path.length_m() / *scenario.robot.loop_steps;
  return scenario.robot.speed_m_s.value_or(0.0) * scenario.period_s();
}

std::string file_of(const map::Document& document) {
  return printable(document.file);
}

/// The first solid that holds the point, `slack_m` around it included.
const map::Solid* solid_at(const map::World& world, const Vec3& point, double slack_m) {
  for (const map::Solid& solid : world.solids) {
    if (solid.contains(point, -slack_m)) return &solid;
  }
  return nullptr;
}

void report_brushes(const map::Document& document, const map::World& world, std::vector<Error>& problems) {
  for (const map::Problem& problem : world.problems) {
    problems.emplace_back(
        ErrorCode::kBadInput, problem.message + "; the brush is left out",
        Where{file_of(document), problem.line, map::brush_name(problem.entity, problem.brush)});
  }
}

void report_robot_start(const map::Document& document, const map::World& world,
                        std::vector<Error>& problems) {
  const std::optional<map::RobotStart> start = map::find_robot_start(document);
  if (!start) return;
  if (const map::Solid* solid = solid_at(world, start->T_world_body.t, 0.0)) {
    problems.emplace_back(ErrorCode::kBadInput,
                          "the robot start stands inside " + map::brush_name(solid->entity, solid->brush),
                          Where{file_of(document), start->line, "hw_robot_start"});
  }
}

/// Follows the way that the robot will take in short chords and reports where it first meets a solid.
void report_obstacle(const Simulator& simulator, std::vector<Error>& problems) {
  constexpr double kChord_m = 0.1;
  constexpr double kMostChords = 20000.0;
  constexpr double kSlack_m = 1e-6;  // a hit lies on the solid's surface to within rounding
  const Scenario& scenario = simulator.scenario();
  const map::Path& path = simulator.path();
  const auto report = [&](const map::Solid* solid, double distance_m) {
    const std::string where = solid != nullptr ? map::brush_name(solid->entity, solid->brush) : "a solid";
    const int line = solid != nullptr ? solid->line : 0;
    problems.emplace_back(
        ErrorCode::kBadInput,
        distance_m == 0.0 ? "begins inside " + where
                          : "runs into " + where + " after " + format_double(distance_m) + " m",
        Where{file_of(simulator.document()), line, "path `" + printable(scenario.robot.path) + "`"});
  };
  if (const map::Solid* solid = solid_at(simulator.world(), path.at(0.0).t, 0.0)) {
    report(solid, 0.0);
    return;
  }
  const double way_m = std::min(path.length_m(), simulator.step_length_m() * (scenario.steps - 1));
  const double chords = std::clamp(std::ceil(way_m / kChord_m), 1.0, kMostChords);
  Vec3 from = path.at(0.0).t;
  for (double i = 1.0; i <= chords; i += 1.0) {
    const Vec3 to = path.at(way_m * (i / chords)).t;
    const Vec3 chord = to - from;
    if (const auto hit = simulator.scene().first_hit({from, chord, chord.norm()})) {
      const double rounded_m = std::round((way_m * ((i - 1.0) / chords) + hit->distance) * 100.0) / 100.0;
      report(solid_at(simulator.world(), from + hit->distance * chord.normalized(), kSlack_m),
             std::max(rounded_m, 0.01));
      return;
    }
    from = to;
  }
}

}  // namespace

Simulator::Simulator(const Scenario& scenario, unsigned threads, trace::Backend backend)
    : scenario_(scenario),
      threads_(std::max(threads, 1u)),
      document_(map::load(scenario.map_file)),
      world_(map::build_world(document_)),
      path_(map::find_path(document_, scenario.robot.path)),
      step_length_m_(find_step_length(scenario, path_)),
      scene_(sense::make_occluders(world_), backend),
      landmarks_(sense::make_landmarks(document_, world_)) {
  sensors_.reserve(scenario_.sensors.size());
  for (const sense::PointSensorSpec& spec : scenario_.sensors) {
    sensors_.emplace_back(spec, landmarks_, scene_, scenario_.seed);
  }
  report_brushes(document_, world_, problems_);
  report_robot_start(document_, world_, problems_);
  report_obstacle(*this, problems_);
}

Pose Simulator::pose_at(std::uint32_t index) const {
  return path_.at(step_length_m_ * index);
}

Frame Simulator::step(std::uint32_t index) const {
  if (index >= scenario_.steps)
    throw Error(ErrorCode::kInternal, "a frame beyond the scenario's last step was asked for");
  Frame frame;
  frame.step = index;
  frame.t_ns = scenario_.period_ns * std::int64_t{index};
  frame.T_world_body = pose_at(index);
  frame.readings.resize(sensors_.size());
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    frame.readings[i].sensor = i;
    sensors_[i].observe(frame.T_world_body, index, threads_, frame.readings[i].observations);
  }
  return frame;
}

}  // namespace hallway::sim
