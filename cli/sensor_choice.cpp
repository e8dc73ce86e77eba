// SPDX-License-Identifier: MIT
#include "sensor_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "base/refuse.hpp"
#include "base/text.hpp"
#include "host/samples/sample_kind.hpp"

namespace hallway::cli {
namespace {

std::vector<std::string> names_with_kinds(const std::vector<host::SensorInfo>& sensors) {
  std::vector<std::string> names;
  for (const host::SensorInfo& sensor : sensors)
    names.push_back(fmt::format("{} ({})", printable(sensor.name), host::sample_kind_name(sensor.kind)));
  return names;
}

}  // namespace

const host::SensorInfo& find_named_sensor(const std::vector<host::SensorInfo>& sensors,
                                          const std::string& name) {
  const auto found = std::ranges::find(sensors, name, &host::SensorInfo::name);
  if (found != sensors.end()) return *found;
  refuse("the log has no sensor {}; it has {}", printable(name), fmt::join(names_with_kinds(sensors), ", "));
}

const host::SensorInfo& find_sensor(const std::vector<host::SensorInfo>& sensors, const std::string& name,
                                    const SensorQuestion& question) {
  if (!name.empty()) {
    const host::SensorInfo& sensor = find_named_sensor(sensors, name);
    if (std::ranges::find(question.kinds, sensor.kind) == question.kinds.end())
      refuse("{} {}: the sensor gives {}, and {} are needed", question.option, printable(name),
             host::sample_kind_name(sensor.kind), question.what);
    return sensor;
  }
  for (const std::uint32_t kind : question.kinds) {
    std::vector<host::SensorInfo> found;
    std::ranges::copy_if(sensors, std::back_inserter(found),
                         [&](const host::SensorInfo& sensor) { return sensor.kind == kind; });
    if (found.size() > 1)
      refuse("the log has several sensors of {}: {} names one of {}", question.what, question.option,
             fmt::join(names_with_kinds(found), ", "));
    if (found.size() == 1) return *std::ranges::find(sensors, kind, &host::SensorInfo::kind);
  }
  throw Error(ErrorCode::kBadInput, fmt::format("the log has no sensor of {}; it has {}", question.what,
                                                fmt::join(names_with_kinds(sensors), ", ")));
}

}  // namespace hallway::cli
