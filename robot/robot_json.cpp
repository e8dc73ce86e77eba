// SPDX-License-Identifier: MIT
#include "robot/robot_json.hpp"

#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/origin.hpp"
#include "base/text.hpp"
#include "record/sensor_json.hpp"

namespace hallway::robot {
namespace {

using Json = nlohmann::ordered_json;

Json print_timing(const RobotFacts& facts) {
  const LoopCounts& counts = facts.loop.counts();
  const auto share = [&] {
    return counts.answered == 0 ? 0.0
                                : static_cast<double>(counts.misses) / static_cast<double>(counts.answered);
  };
  Json timing{{"deadline_ms", facts.timing.deadline ? Json(milliseconds(*facts.timing.deadline)) : Json()},
              {"deadline_misses", facts.timing.deadline ? Json(counts.misses) : Json()},
              {"deadline_miss_share", facts.timing.deadline ? Json(share()) : Json()},
              {"latency_ms", Json()}};
  if (counts.answered > 0) {
    timing["latency_ms"] = {{"median", milliseconds(counts.latency.quantile(0.5))},
                            {"p99", milliseconds(counts.latency.quantile(0.99))},
                            {"worst", milliseconds(counts.latency.worst())}};
  }
  timing["watchdog_trips"] = facts.gate.trips;
  timing["late_answers"] = facts.gate.late_answers;
  timing["worst_stop_ms"] = milliseconds(facts.gate.worst_stop);
  return timing;
}

}  // namespace

Json print_driver(const Config& config, const host::Driver& driver) {
  Json settings = Json::array();
  for (const host::DriverSetting& setting : config.driver.settings) {
    settings.push_back({{"key", setting.key},
                        {"value", printable(setting.value, 4096)},
                        {"origin", origin_of(setting.where.file, setting.where.line)}});
  }
  return {{"id", driver.info().id},
          {"version", driver.info().version},
          {"hash", content_hash(read_file(driver.file()))},
          {"settings", settings}};
}

Json print_sensors(const host::RobotInfo& robot) {
  Json sensors = Json::array();
  for (const host::SensorInfo& sensor : robot.sensors) sensors.push_back(record::print_sensor(sensor));
  return sensors;
}

Json print_limits(const host::PluginLimits& limits) {
  return {{"call_timeout_s", limits.call_timeout_s}, {"memory_limit_mib", limits.memory_mib}};
}

std::string loop_end_name(LoopEnd end) {
  switch (end) {
    case LoopEnd::kDriver:
      return "driver";
    case LoopEnd::kDuration:
      return "duration";
    case LoopEnd::kInterrupt:
      return "interrupt";
    case LoopEnd::kPlugin:
      return "plugin";
  }
  return "driver";
}

/// By sensor, those of which samples are missing: what was lost or dropped with their frames.
Json print_missing(const RobotFacts& facts) {
  Json sensors = Json::object();
  for (const host::SensorInfo& sensor : facts.robot.sensors) {
    const auto counts = facts.loop.samples().sensors().find(sensor.id);
    if (counts == facts.loop.samples().sensors().end() || counts->second.missing == 0) continue;
    sensors[sensor.name] = {{"given", counts->second.given}, {"missing", counts->second.missing}};
  }
  return sensors;
}

Json print_robot(const RobotFacts& facts) {
  const IntakeCounts intake = facts.loop.intake();
  Json counters = Json::object();
  for (const host::Counter& counter : facts.driver_counters) counters[counter.name] = counter.value;
  const bool watched = facts.timing.watchdog > Clock::duration::zero();
  Json frames{{"read", intake.read},
              {"lost", intake.lost},
              {"dropped", intake.dropped},
              {"refused", intake.refused},
              {"given", facts.loop.counts().iterations},
              {"answered", facts.loop.counts().answered},
              {"unrecorded", facts.unrecorded}};
  if (Json missing = print_missing(facts); !missing.empty()) frames["samples_missing"] = std::move(missing);
  Json timing = print_timing(facts);
  if (facts.command_timeout_s > 0) timing["command_timeouts"] = facts.loop.command_timeouts();
  return {{"name", facts.robot.name},
          {"lock_step", facts.robot.lock_step},
          {"watchdog_ms", watched ? Json(milliseconds(facts.timing.watchdog)) : Json()},
          {"ended_by", facts.end},
          {"frames", std::move(frames)},
          {"driver_counters", counters},
          {"timing", std::move(timing)}};
}

}  // namespace hallway::robot
