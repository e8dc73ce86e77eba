// SPDX-License-Identifier: MIT
#include "foxglove/reading_json.hpp"

#include <fmt/format.h>

#include <cmath>

namespace hallway::foxglove {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// Shortest decimals that read back as the same numbers.
std::string vector_text(const double (&vector)[3]) {
  static constexpr const char* kNames[] = {"x", "y", "z"};
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(vector[axis])) continue;
    text += fmt::format("{}\"{}\":{}", text.empty() ? "" : ",", kNames[axis], vector[axis]);
  }
  return "{" + text + "}";
}

std::string vector_schema(const char* description) {
  return fmt::format(
      R"({{"type":"object","description":"{}","properties":{{"x":{{"type":"number"}},"y":{{"type":"number"}},"z":{{"type":"number"}}}}}})",
      description);
}

/// With a time, and members as they follow.
/// @param required  their names, each in quotes, after a comma
std::string schema_of(const char* title, const std::string& members, const std::string& required) {
  return fmt::format(
      R"({{"$schema":"https://json-schema.org/draft/2020-12/schema","title":"{}","type":"object","properties":{{)"
      R"("timestamp":{{"type":"object","title":"time","properties":{{"sec":{{"type":"integer","minimum":0}},"nsec":{{"type":"integer","minimum":0,"maximum":999999999}}}},"required":["sec","nsec"]}},)"
      R"({}}},"required":["timestamp"{}]}})",
      title, members, required);
}

std::string timestamp_text(std::int64_t t_ns) {
  return fmt::format(R"("timestamp":{{"sec":{},"nsec":{}}})", t_ns / kSecond_ns, t_ns % kSecond_ns);
}

}  // namespace

std::string imu_schema() {
  return schema_of(kImuSchemaName,
                   fmt::format(R"("angular_rad_s":{},"force_m_s2":{})",
                               vector_schema("mean angular velocity of the interval, sensor frame, rad/s"),
                               vector_schema("mean specific force of the interval, sensor frame, m/s^2")),
                   R"(,"angular_rad_s","force_m_s2")");
}

std::string print_imu(std::int64_t t_ns, const hw_imu_t& imu) {
  return fmt::format(R"({{{},"angular_rad_s":{},"force_m_s2":{}}})", timestamp_text(t_ns),
                     vector_text(imu.angular_rad_s), vector_text(imu.force_m_s2));
}

std::string compass_schema() {
  return schema_of(
      kCompassSchemaName,
      R"("heading_rad":{"type":"number","description":"of the sensor's x axis from magnetic north, to the left, rad"},)"
      R"("variance_rad2":{"type":"number","description":"of its error, rad^2"})",
      "");
}

std::string print_compass(std::int64_t t_ns, const hw_magnetic_t& magnetic) {
  std::string text = "{" + timestamp_text(t_ns);
  if (std::isfinite(magnetic.heading_rad)) text += fmt::format(R"(,"heading_rad":{})", magnetic.heading_rad);
  if (std::isfinite(magnetic.variance_rad2))
    text += fmt::format(R"(,"variance_rad2":{})", magnetic.variance_rad2);
  return text + "}";
}

}  // namespace hallway::foxglove
