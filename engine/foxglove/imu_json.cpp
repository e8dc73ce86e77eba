// SPDX-License-Identifier: MIT
#include "foxglove/imu_json.hpp"

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

}  // namespace

std::string imu_schema() {
  return fmt::format(
      R"({{"$schema":"https://json-schema.org/draft/2020-12/schema","title":"{}","type":"object","properties":{{)"
      R"("timestamp":{{"type":"object","title":"time","properties":{{"sec":{{"type":"integer","minimum":0}},"nsec":{{"type":"integer","minimum":0,"maximum":999999999}}}},"required":["sec","nsec"]}},)"
      R"("angular_rad_s":{},"force_m_s2":{}}},"required":["timestamp","angular_rad_s","force_m_s2"]}})",
      kImuSchemaName, vector_schema("mean angular velocity of the interval, sensor frame, rad/s"),
      vector_schema("mean specific force of the interval, sensor frame, m/s^2"));
}

std::string print_imu(std::int64_t t_ns, const hw_imu_t& imu) {
  return fmt::format(R"({{"timestamp":{{"sec":{},"nsec":{}}},"angular_rad_s":{},"force_m_s2":{}}})",
                     t_ns / kSecond_ns, t_ns % kSecond_ns, vector_text(imu.angular_rad_s),
                     vector_text(imu.force_m_s2));
}

}  // namespace hallway::foxglove
