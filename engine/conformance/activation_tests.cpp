// SPDX-License-Identifier: MIT
// The facts that are given once.
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "conformance/instance.hpp"
#include "conformance/walk.hpp"

namespace hallway::conformance {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// What `plugin` makes of two frames of ordinary sensors, whose ids begin at each of `first_ids`, and which see the same.
void look(Instance& plugin, const std::vector<std::uint32_t>& first_ids = {0}) {
  for (std::uint64_t step = 0; step < 2; ++step) {
    Frame frame = plugin.ordinary().frame(step);
    const std::vector<Reading> readings = std::exchange(frame.readings, {});
    for (const std::uint32_t first : first_ids) {
      for (Reading reading : readings) {
        reading.sensor += first;
        frame.readings.push_back(reading);
      }
    }
    plugin.process(frame).demand_valid();
  }
}

/// Activates `plugin` with sensors, and looks.
void activate_and_look(Instance& plugin, const std::vector<hw_sensor_info_t>& sensors,
                       std::uint32_t first_id = 0) {
  plugin.activate(sensors).demand_good();
  look(plugin, {first_id});
}

void survives_no_sensors(const Subject& subject) {
  Instance plugin(subject);
  const Ended ended = plugin.activate({});
  ended.demand_reason();
  if (!ended.good()) return;
  plugin.process(Frame()).demand_valid();
  plugin.report(0).demand_valid();
}

void skips_unknown_sensors(const Subject& subject) {
  Instance plugin(subject);
  std::vector<hw_sensor_info_t> sensors = plugin.ordinary().sensors();
  hw_sensor_info_t unknown = sensors.front();
  unknown.id = static_cast<std::uint32_t>(sensors.size());
  unknown.kind = 4711;
  unknown.intrinsics = &unknown;  // a struct that begins with its size
  hw_sensor_info_t last = unknown;
  last.id = unknown.id + 1;
  last.kind = UINT32_MAX;
  sensors.insert(sensors.begin(), unknown);
  sensors.push_back(last);
  activate_and_look(plugin, sensors);
}

void takes_unknown_facts(const Subject& subject) {
  Instance plugin(subject);
  std::vector<hw_sensor_info_t> sensors = plugin.ordinary().sensors();
  for (hw_sensor_info_t& sensor : sensors) {
    sensor.horizontal_fov = sensor.vertical_fov = sensor.min_range_m = sensor.max_range_m = kNan;
    for (double& noise : sensor.noise_m) noise = kNan;
    sensor.name = "";
  }
  activate_and_look(plugin, sensors);
}

void survives_two_sensors(const Subject& subject) {
  Instance plugin(subject);
  std::vector<hw_sensor_info_t> sensors = plugin.ordinary().sensors();
  const auto second = static_cast<std::uint32_t>(sensors.size());
  for (const hw_sensor_info_t& sensor : plugin.ordinary().sensors(second)) sensors.push_back(sensor);
  const Ended ended = plugin.activate(sensors);
  ended.demand_reason();
  if (!ended.good()) throw Skipped("the plugin refuses a second sensor, with a reason: " + ended.text());
  look(plugin, {0, second});
  look(plugin, {second});
}

void takes_any_id(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  for (const std::uint32_t id : {0x7fffffffu, 0x80000000u, UINT32_MAX}) {
    Instance plugin(library, subject);
    const auto others = static_cast<std::uint32_t>(plugin.ordinary().sensors().size() - 1);
    activate_and_look(plugin, plugin.ordinary().sensors(id - others), id - others);
  }
}

void takes_any_mount(const Subject& subject) {
  Instance plugin(subject);
  std::vector<hw_sensor_info_t> sensors = plugin.ordinary().sensors();
  const double half = std::sqrt(0.5);
  for (hw_sensor_info_t& sensor : sensors) {
    sensor.name = "hinter der Tür";
    sensor.T_body_sensor = {{-0.3, 0.1, 1.2}, {half, 0.0, 0.0, -half}};
  }
  activate_and_look(plugin, sensors);
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
