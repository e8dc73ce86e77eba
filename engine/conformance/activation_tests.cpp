// SPDX-License-Identifier: MIT
// The facts that are given once.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "conformance/instance.hpp"
#include "conformance/walk.hpp"

namespace hallway::conformance {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// What `plugin` makes of two frames of the sensors `ids`, each of which sees the same.
void look(Instance& plugin, const Subject& subject, const std::vector<std::uint32_t>& ids) {
  for (std::uint64_t step = 0; step < 2; ++step) {
    Frame frame = walk_frame(subject.seed, step);
    const Reading reading = frame.readings.front();
    frame.readings.clear();
    for (const std::uint32_t id : ids) {
      frame.readings.push_back(reading);
      frame.readings.back().sensor = id;
    }
    plugin.process(frame).demand_valid();
  }
}

void survives_no_sensors(const Subject& subject) {
  Instance plugin(subject);
  const Ended ended = plugin.activate({});
  ended.demand_reason();
  if (!ended.good()) return;
  plugin.process({}).demand_valid();
  plugin.report(0).demand_valid();
}

void skips_unknown_sensors(const Subject& subject) {
  Instance plugin(subject);
  hw_sensor_info_t unknown = ordinary_sensor(1);
  unknown.kind = 4711;
  hw_sensor_info_t last = ordinary_sensor(2);
  last.kind = UINT32_MAX;
  const Ended ended = plugin.activate({unknown, ordinary_sensor(0), last});
  if (!ended.good()) plugin.activate();  // skips the test where it needs more than points
  ended.demand_good();
  look(plugin, subject, {0});
}

void takes_unknown_facts(const Subject& subject) {
  Instance plugin(subject);
  hw_sensor_info_t sensor = ordinary_sensor();
  sensor.horizontal_fov = sensor.vertical_fov = sensor.min_range_m = sensor.max_range_m = kNan;
  for (double& noise : sensor.noise_m) noise = kNan;
  sensor.name = "";
  const Ended ended = plugin.activate({sensor});
  if (!ended.good()) plugin.activate();  // skips the test where it needs more than points
  ended.demand_good();
  look(plugin, subject, {0});
}

void survives_two_sensors(const Subject& subject) {
  Instance plugin(subject);
  const Ended ended = plugin.activate({ordinary_sensor(0), ordinary_sensor(1)});
  ended.demand_reason();
  if (!ended.good()) throw Skipped("the plugin refuses a second sensor, with a reason: " + ended.text());
  look(plugin, subject, {0, 1});
  look(plugin, subject, {1});
}

void takes_any_id(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  for (const std::uint32_t id : {0x7fffffffu, 0x80000000u, UINT32_MAX}) {
    Instance plugin(library, subject);
    const Ended ended = plugin.activate({ordinary_sensor(id)});
    if (!ended.good()) plugin.activate();
    ended.demand_good();
    look(plugin, subject, {id});
  }
}

void takes_any_mount(const Subject& subject) {
  Instance plugin(subject);
  hw_sensor_info_t sensor = ordinary_sensor();
  sensor.name = "hinter der Tür";
  const double half = std::sqrt(0.5);
  sensor.T_body_sensor = {{-0.3, 0.1, 1.2}, {half, 0.0, 0.0, -half}};
  const Ended ended = plugin.activate({sensor});
  if (!ended.good()) plugin.activate();
  ended.demand_good();
  look(plugin, subject, {0});
}

constexpr Test kActivationTests[] = {
    {"activate-no-sensors", "Without sensors activate() fails with a reason, or the plugin works.",
     survives_no_sensors},
    {"activate-unknown-kind", "Sensors of a kind that the plugin does not know are skipped.",
     skips_unknown_sensors},
    {"activate-unknown-facts", "NaN means that a fact is unknown, and is no reason to fail.",
     takes_unknown_facts},
    {"activate-two-sensors", "With two sensors of a kind the plugin works, or refuses them with a reason.",
     survives_two_sensors},
    {"activate-any-id", "Any number may be the id of a sensor.", takes_any_id},
    {"activate-any-mount", "A sensor may be mounted anywhere on the body, and have any name.",
     takes_any_mount},
};

}  // namespace

std::span<const Test> activation_tests() {
  return kActivationTests;
}

}  // namespace hallway::conformance
