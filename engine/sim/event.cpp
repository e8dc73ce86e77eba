// SPDX-License-Identifier: MIT
#include "sim/event.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <variant>

#include "base/text.hpp"

namespace hallway::sim {
namespace {

const std::vector<std::string> kEventKinds{"kidnap", "sensor_off", "sensor_on", "push",
                                           "wheels_blocked"};  // in the order of EventKind

constexpr Range kEventTime_s{0.0, 1e8};
constexpr Range kEventDuration_s{1e-6, 1e6};
constexpr Range kEventPlace_m{-1e7, 1e7};
constexpr Range kEventYaw_deg{-360.0, 360.0};
constexpr Range kPush_m_s{-100.0, 100.0};
constexpr Range kPush_rad_s{-100.0, 100.0};

/// The keys of each kind, in the order of EventKind.
const std::array<std::vector<std::string>, 5> kKeysOfKind{{
    {"at_s", "kind", "to", "place_m", "yaw_deg"},
    {"at_s", "kind", "sensor"},
    {"at_s", "kind", "sensor"},
    {"at_s", "kind", "linear_m_s", "lateral_m_s", "angular_rad_s", "duration_s"},
    {"at_s", "kind", "duration_s"},
}};

/// The keys of an event's kind; those of all kinds where it has none, so that it is the kind that is refused.
std::vector<std::string> known_event_keys(const TomlTable& table) {
  const TomlNode* kind = find(table, "kind");
  const auto* name = kind != nullptr ? std::get_if<std::string>(&kind->value) : nullptr;
  if (name != nullptr) {
    const auto found = std::ranges::find(kEventKinds, *name);
    if (found != kEventKinds.end())
      return kKeysOfKind.at(static_cast<std::size_t>(found - kEventKinds.begin()));
  }
  std::vector<std::string> all;
  for (const std::vector<std::string>& keys : kKeysOfKind) all.insert(all.end(), keys.begin(), keys.end());
  return all;
}

std::int64_t time_of(TableReader& event, std::string_view key, const Range& range) {
  return std::llround(event.number(key, range) * 1e9);
}

void read_kidnap(TableReader& event, EventSpec& spec) {
  if (event.has("to") == event.has("place_m"))
    throw event.error(event.has("to") ? "place_m" : "to",
                      event.has("to") ? "is given together with `to`; give one of them"
                                      : "is missing; give it or `place_m`");
  if (event.has("to")) {
    if (event.has("yaw_deg")) throw event.error("yaw_deg", "needs `place_m`; a robot start has its own");
    spec.to = event.text("to");
    return;
  }
  spec.place_m = event.vector("place_m", kEventPlace_m);
  spec.yaw_rad = event.number("yaw_deg", kEventYaw_deg, 0.0) * std::numbers::pi / 180.0;
}

void read_push(TableReader& event, EventSpec& spec) {
  spec.twist = {event.number("linear_m_s", kPush_m_s, 0.0), event.number("lateral_m_s", kPush_m_s, 0.0),
                event.number("angular_rad_s", kPush_rad_s, 0.0)};
  if (spec.twist.is_zero())
    throw event.error("linear_m_s", "is 0, as are `lateral_m_s` and `angular_rad_s`; a push moves the robot");
  spec.duration_ns = time_of(event, "duration_s", kEventDuration_s);
}

}  // namespace

std::string_view event_kind_name(EventKind kind) {
  return kEventKinds.at(static_cast<std::size_t>(kind));
}

bool acts_on_drive(EventKind kind) {
  return kind == EventKind::kKidnap || kind == EventKind::kPush || kind == EventKind::kWheelsBlocked;
}

std::string text_of(const EventSpec& event) {
  const auto name = [](const std::string& text) {
    std::string one = printable(text);
    std::ranges::replace(one, ',', ';');
    return one;
  };
  const double duration_s = static_cast<double>(event.duration_ns) / 1e9;
  switch (event.kind) {
    case EventKind::kKidnap:
      if (!event.place_m) return "to " + name(event.to);
      return fmt::format("to {} {} {}", event.place_m->x(), event.place_m->y(), event.place_m->z());
    case EventKind::kPush:
      return fmt::format("{} m/s {} m/s {} rad/s for {} s", event.twist.forward_m_s, event.twist.lateral_m_s,
                         event.twist.angular_rad_s, duration_s);
    case EventKind::kWheelsBlocked:
      return fmt::format("for {} s", duration_s);
    default:
      return name(event.sensor);
  }
}

EventSpec read_event(const std::string& file, const std::string& prefix, const TomlTable& table, int line,
                     std::vector<Setting>& settings) {
  TableReader event(file, prefix, table, line, known_event_keys(table), settings);
  EventSpec spec;
  spec.line = line;
  spec.kind = static_cast<EventKind>(event.choice("kind", kEventKinds));
  spec.t_ns = time_of(event, "at_s", kEventTime_s);
  switch (spec.kind) {
    case EventKind::kKidnap:
      read_kidnap(event, spec);
      break;
    case EventKind::kPush:
      read_push(event, spec);
      break;
    case EventKind::kWheelsBlocked:
      spec.duration_ns = time_of(event, "duration_s", kEventDuration_s);
      break;
    default:
      spec.sensor = event.text("sensor");
  }
  return spec;
}

}  // namespace hallway::sim
