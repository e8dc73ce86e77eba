// SPDX-License-Identifier: MIT
// What plugins take from a sensor's description where it was not set, in this process and in one of their own.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "fixtures.hpp"
#include "host/pipeline.hpp"

namespace hallway::host {
namespace {

using test_fixtures::point_sensors;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Noise {
  std::string value;
  bool from_sensor;
  bool operator==(const Noise&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Noise& noise) {
  return out << noise.value << (noise.from_sensor ? " from the sensor" : "");
}

std::vector<SensorInfo> sensor(double x, double y, double z, std::uint32_t kind = HW_SAMPLE_POINTS) {
  std::vector<SensorInfo> sensors = point_sensors(1);
  sensors[0].kind = kind;
  sensors[0].noise_m[0] = x;
  sensors[0].noise_m[1] = y;
  sensors[0].noise_m[2] = z;
  return sensors;
}

std::optional<Noise> noise_of(const StageFacts& facts) {
  for (std::size_t i = 0; i < facts.parameters.size(); ++i) {
    if (facts.parameters[i].name == "noise_m") return Noise{facts.values[i], facts.from_sensor[i]};
  }
  return std::nullopt;
}

class SensorValues : public testing::TestWithParam<bool> {
 protected:
  /// The noise in effect in a plugin with these settings.
  static std::optional<Noise> taken(const std::string& plugin, const std::vector<SensorInfo>& sensors,
                                    std::vector<ParameterSetting> settings = {}) {
    std::optional<Isolation> isolation;
    if (GetParam()) isolation.emplace();
    const Pipeline pipeline(
        {{.plugin = std::string(PLUGINS) + "/" + plugin + ".so:" + plugin, .parameters = settings}}, {},
        sensors, {}, isolation);
    return noise_of(pipeline.facts()[0]);
  }
};

TEST_P(SensorValues, TheLargestKnownNoiseIsTaken) {
  EXPECT_EQ(taken("slam_point", sensor(0.01, 0.03, 0.02)), (Noise{"0.03", true}));
  EXPECT_EQ(taken("slam_point", sensor(kNan, 0.015, kNan)), (Noise{"0.015", true}));
  EXPECT_EQ(taken("slam_point", sensor(0.05, 0.05, 0.05)), (Noise{"0.05", true}))
      << "also where it is the default";
}

TEST_P(SensorValues, TheRangeOfTheParameterBoundsIt) {
  EXPECT_EQ(taken("slam_point", sensor(0, 0, 0)), (Noise{"1e-04", true}));
  EXPECT_EQ(taken("slam_point", sensor(99, 0, 0)), (Noise{"10", true}));
}

TEST_P(SensorValues, AnUnknownNoiseLeavesTheDefault) {
  EXPECT_EQ(taken("slam_point", sensor(kNan, kNan, kNan)), (Noise{"0.05", false}));
  EXPECT_EQ(taken("slam_plane", sensor(kNan, kNan, kNan, HW_SAMPLE_PLANES)), (Noise{"0.02", false}));
}

TEST_P(SensorValues, WhatIsSetStands) {
  EXPECT_EQ(taken("slam_point", sensor(0.01, 0.03, 0.02), {{"noise_m", "0.2", {}}}), (Noise{"0.2", false}));
  EXPECT_EQ(taken("slam_plane", sensor(0.01, 0, 0, HW_SAMPLE_PLANES), {{"noise_m", "0.02", {}}}),
            (Noise{"0.02", false}));
}

TEST_P(SensorValues, EveryModeOfOursThatKnowsANoiseTakesIt) {
  EXPECT_EQ(taken("slam_point", sensor(0.01, 0, 0), {{"mode", "thesis", {}}}), (Noise{"0.01", true}));
  EXPECT_EQ(taken("slam_plane", sensor(0.01, 0, 0, HW_SAMPLE_PLANES)), (Noise{"0.01", true}));
  EXPECT_EQ(taken("slam_plane", sensor(0.01, 0, 0, HW_SAMPLE_PLANES), {{"dof", "6", {}}}),
            (Noise{"0.01", true}));
  EXPECT_EQ(taken("slam_plane", sensor(0.01, 0, 0, HW_SAMPLE_PLANES), {{"mode", "thesis", {}}}),
            (Noise{"0.02", false}))
      << "it knows no noise";
  EXPECT_EQ(taken("icp", sensor(0.01, 0, 0)), (Noise{"0.02", false})) << "it knows one of scans alone";
  EXPECT_EQ(taken("icp", sensor(0.01, 0, 0, HW_SAMPLE_RANGE_SCAN)), (Noise{"0.01", true}));
  EXPECT_EQ(taken("em", sensor(0.01, 0, 0)), std::nullopt) << "it measures the noise";
}

TEST_P(SensorValues, TheNoisiestOfTheSensorsThatItListensToCounts) {
  std::vector<SensorInfo> sensors = point_sensors(3);
  sensors[0].noise_m[0] = 0.01;
  sensors[1].noise_m[1] = 0.02;
  sensors[2].noise_m[2] = 0.5;
  sensors[2].kind = HW_SAMPLE_PLANES;
  EXPECT_EQ(taken("slam_point", sensors), (Noise{"0.02", true}));
}

TEST_P(SensorValues, PluginsAreStartedAgainWithTheSameValues) {
  std::optional<Isolation> isolation;
  if (GetParam()) isolation.emplace();
  Pipeline pipeline({{.plugin = std::string(PLUGINS) + "/slam_point.so", .parameters = {}}}, {},
                    sensor(0.02, 0, 0), {}, isolation);
  pipeline.restart();
  EXPECT_EQ(noise_of(pipeline.facts()[0]), (Noise{"0.02", true}));
}

INSTANTIATE_TEST_SUITE_P(Plugins, SensorValues, testing::Values(false, true),
                         [](const auto& instance) { return instance.param ? "Isolated" : "InProcess"; });

}  // namespace
}  // namespace hallway::host
