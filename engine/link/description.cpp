// SPDX-License-Identifier: MIT
#include "link/description.hpp"

#include <fmt/format.h>

#include <set>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "base/unit_quaternion.hpp"
#include "host/c_sensor.hpp"

namespace hallway::link {
namespace {

constexpr std::uint32_t kLockStep = 1;

struct RobotBytes {
  std::uint32_t flags = 0;
  std::uint32_t sensors = 0;
  std::int64_t period_ns = 0;
};
static_assert(sizeof(RobotBytes) == 16);

struct SensorBytes {
  std::uint32_t id = 0;
  std::uint32_t kind = 0;
  hw_pose_t T_body_sensor{};
  double horizontal_fov = 0;
  double vertical_fov = 0;
  double min_range_m = 0;
  double max_range_m = 0;
  double noise_m[3]{};
};
static_assert(sizeof(SensorBytes) == 120);

[[noreturn]] void bad(const std::string& cause) {
  throw Error(ErrorCode::kBadInput, cause, {.element = "description of the robot"});
}

void check_name(const std::string& name) {
  if (name.size() > kMaxNameBytes) bad(fmt::format("a name of more than {} bytes", kMaxNameBytes));
  if (printable(name, name.size() + 1) != name) {
    bad(fmt::format("a name that is no plain text: \"{}\"", printable(name)));
  }
}

void check_mount(const host::SensorInfo& sensor) {
  if (!is_pose(sensor.T_body_sensor.position, sensor.T_body_sensor.orientation))
    bad(fmt::format("the mount of sensor {} is no pose", sensor.id));
}

void check(const Description& description) {
  if (description.period_ns < 0) bad("a period below 0");
  if (description.sensors.size() > kMaxSensors) bad(fmt::format("more than {} sensors", kMaxSensors));
  check_name(description.name);
  std::set<std::uint32_t> ids;
  for (const host::SensorInfo& sensor : description.sensors) {
    check_name(sensor.name);
    check_mount(sensor);
    if (!ids.insert(sensor.id).second) bad(fmt::format("two sensors have the id {}", sensor.id));
  }
}

Description read_parts(std::span<const std::byte> message) {
  AlignedByteReader reader(message);
  const auto robot = reader.get<RobotBytes>();
  Description description;
  description.lock_step = (robot.flags & kLockStep) != 0;
  description.period_ns = robot.period_ns;
  description.name = reader.get_text();
  if (robot.sensors > kMaxSensors) bad(fmt::format("more than {} sensors", kMaxSensors));
  for (std::uint32_t i = 0; i < robot.sensors; ++i) {
    host::SensorInfo& sensor = description.sensors.emplace_back();
    host::copy_sensor_facts(reader.get<SensorBytes>(), sensor);
    sensor.name = reader.get_text();
  }
  reader.expect_end();
  return description;
}

}  // namespace

Bytes write_description(const Description& description) {
  check(description);
  Bytes message(kMaxDescriptionFragments * kFragmentBytes);
  AlignedByteWriter writer(message);
  writer.put(RobotBytes{.flags = description.lock_step ? kLockStep : 0,
                        .sensors = static_cast<std::uint32_t>(description.sensors.size()),
                        .period_ns = description.period_ns});
  writer.put_text(description.name);
  for (const host::SensorInfo& sensor : description.sensors) {
    SensorBytes bytes;
    host::copy_sensor_facts(sensor, bytes);
    writer.put(bytes);
    writer.put_text(sensor.name);
  }
  if (!writer.fits()) bad(fmt::format("it has more than {} bytes", message.size()));
  message.resize(writer.size());
  return message;
}

Description read_description(std::span<const std::byte> message) {
  try {
    Description description = read_parts(message);
    check(description);
    return description;
  } catch (const BadBytes& fault) {
    bad(fault.what);
  }
}

}  // namespace hallway::link
