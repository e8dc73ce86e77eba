// SPDX-License-Identifier: MIT
#include "link/description.hpp"

#include <fmt/format.h>

#include <set>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "base/unit_quaternion.hpp"
#include "host/c_sensor.hpp"
#include "link/description_parts.hpp"

namespace hallway::link {
namespace {

constexpr std::uint32_t kLockStep = 1;

/// What stands in a description of either version behind what tells the sensor.
struct SensorFacts {
  hw_pose_t T_body_sensor{};
  double horizontal_fov = 0;
  double vertical_fov = 0;
  double min_range_m = 0;
  double max_range_m = 0;
  double noise_m[3]{};
};

/// In version 1.
struct Version1 {
  struct Robot {
    std::uint32_t flags = 0;
    std::uint32_t sensors = 0;
    std::int64_t period_ns = 0;
  };
  struct SensorHead {
    std::uint32_t id = 0;
    std::uint32_t kind = 0;
  };
  struct Sensor : SensorHead, SensorFacts {};
  static constexpr bool kSized = false;
};
static_assert(sizeof(Version1::Robot) == 16 && sizeof(Version1::Sensor) == 120);

/// In version 2 each struct begins with its own size, a multiple of 8, and may grow at its end.
struct Version2 {
  struct Robot {
    std::uint32_t size = sizeof(Robot);
    std::uint32_t flags = 0;
    std::uint32_t sensors = 0;
    std::uint32_t reserved = 0;
    std::int64_t period_ns = 0;
  };
  struct SensorHead {
    std::uint32_t size = 128;
    std::uint32_t id = 0;
    std::uint32_t kind = 0;
    std::uint32_t reserved = 0;
  };
  struct Sensor : SensorHead, SensorFacts {};
  static constexpr bool kSized = true;
};
static_assert(sizeof(Version2::Robot) == 24 && sizeof(Version2::Sensor) == 128);

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

void check_later_facts(const host::SensorInfo& sensor) {
  const std::string problem = host::problem_of(sensor);
  if (!problem.empty()) bad(fmt::format("sensor {}: {}", sensor.id, problem));
  if (const auto* bump = std::get_if<host::BumpIntrinsics>(&sensor.intrinsics)) {
    for (const host::BumpZoneInfo& zone : bump->zones) check_name(zone.name);
  }
}

void check_parts(const Description& description) {
  if (description.drive) {
    const std::string problem = host::problem_of(*description.drive);
    if (!problem.empty()) bad("the drive: " + problem);
  }
  if (description.body) {
    const std::string problem = host::problem_of(*description.body);
    if (!problem.empty()) bad(problem);
  }
}

void check(const Description& description) {
  if (description.period_ns < 0) bad("a period below 0");
  if (description.sensors.size() > kMaxSensors) bad(fmt::format("more than {} sensors", kMaxSensors));
  check_name(description.name);
  check_parts(description);
  std::set<std::uint32_t> ids;
  for (const host::SensorInfo& sensor : description.sensors) {
    check_name(sensor.name);
    check_mount(sensor);
    check_later_facts(sensor);
    if (!ids.insert(sensor.id).second) bad(fmt::format("two sensors have the id {}", sensor.id));
  }
}

/// A struct of a message, and the bytes behind what `T` has, where it says how large it is.
template <typename T>
struct Taken {
  T head{};
  std::span<const std::byte> rest{};
};

/// Takes a struct that may be larger than `T`, where it says how large it is.
template <typename T, bool kSized>
Taken<T> take_struct(AlignedByteReader& reader) {
  if constexpr (kSized) {
    AlignedByteReader ahead = reader;
    const auto size = ahead.get<std::uint32_t>();
    if (size < sizeof(T) || size % 8 != 0) bad(fmt::format("a size of {} bytes", size));
    const auto bytes = std::as_bytes(std::span(reader.take_raw(size)));
    return {load<T>(bytes.data()), bytes.subspan(sizeof(T))};
  } else {
    return {reader.get<T>(), {}};
  }
}

template <typename Version>
Description read_parts(std::span<const std::byte> message) {
  AlignedByteReader reader(message);
  const auto robot = take_struct<typename Version::Robot, Version::kSized>(reader);
  Description description;
  description.lock_step = (robot.head.flags & kLockStep) != 0;
  description.period_ns = robot.head.period_ns;
  read_robot_parts(robot.rest, description);
  description.name = reader.get_text();
  if (robot.head.sensors > kMaxSensors) bad(fmt::format("more than {} sensors", kMaxSensors));
  for (std::uint32_t i = 0; i < robot.head.sensors; ++i) {
    host::SensorInfo& sensor = description.sensors.emplace_back();
    const auto taken = take_struct<typename Version::Sensor, Version::kSized>(reader);
    host::copy_sensor_facts(taken.head, sensor);
    read_sensor_parts(taken.rest, sensor);
    sensor.name = reader.get_text();
  }
  reader.expect_end();
  return description;
}

/// Puts a struct, with `rest` behind it where it says how large it is.
template <typename Version, typename T>
void put_struct(AlignedByteWriter& writer, T head, std::span<const std::byte> rest) {
  if constexpr (Version::kSized) {
    head.size = static_cast<std::uint32_t>(sizeof(T) + rest.size());
    writer.put(head);
    for (std::size_t at = 0; at < rest.size(); at += 8) writer.put(load<std::uint64_t>(rest.data() + at));
  } else {
    writer.put(head);
  }
}

template <typename Version>
void put_parts(const Description& description, AlignedByteWriter& writer) {
  typename Version::Robot robot;
  robot.flags = description.lock_step ? kLockStep : 0;
  robot.sensors = static_cast<std::uint32_t>(description.sensors.size());
  robot.period_ns = description.period_ns;
  put_struct<Version>(writer, robot, robot_parts_bytes(description));
  writer.put_text(description.name);
  for (const host::SensorInfo& sensor : description.sensors) {
    typename Version::Sensor bytes;
    host::copy_sensor_facts(sensor, bytes);
    put_struct<Version>(writer, bytes, sensor_parts_bytes(sensor));
    writer.put_text(sensor.name);
  }
}

}  // namespace

Bytes write_description(const Description& description, std::uint8_t version) {
  check(description);
  Bytes message(kMaxDescriptionFragments * kFragmentBytes);
  AlignedByteWriter writer(message);
  if (version == kFirstVersion) {
    put_parts<Version1>(description, writer);
  } else {
    put_parts<Version2>(description, writer);
  }
  if (!writer.fits()) bad(fmt::format("it has more than {} bytes", message.size()));
  message.resize(writer.size());
  return message;
}

Description read_description(std::span<const std::byte> message, std::uint8_t version) {
  try {
    Description description =
        version == kFirstVersion ? read_parts<Version1>(message) : read_parts<Version2>(message);
    check(description);
    return description;
  } catch (const BadBytes& fault) {
    bad(fault.what);
  }
}

}  // namespace hallway::link
