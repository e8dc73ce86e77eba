// SPDX-License-Identifier: MIT
//
// Built twice: with a host of today's headers and with one of grown headers. Each loads a plugin of today's headers and one of
// grown headers.

#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "host/plugin.hpp"
#include "host/samples/imu_kind.hpp"
#include "host/samples/odometry_kind.hpp"
#include "host/samples/point_kind.hpp"
#include "host/samples/range_scan_kind.hpp"
#include "support/errors.hpp"

namespace hallway::host {
namespace {

#ifdef HW_TEST_GROWN
constexpr bool kHostHasGrown = true;
#else
constexpr bool kHostHasGrown = false;
#endif

struct Build {
  const char* name;
  const char* file;
  bool has_grown;
  bool is_later = true;  ///< than 1.0
};

class Growth : public testing::TestWithParam<Build> {
 protected:
  Growth() : plugin_(find_plugin(GetParam().file, {})) {}

  static std::vector<SensorInfo> three_sensors() {
    std::vector<SensorInfo> sensors;
    for (std::uint32_t i = 0; i < 3; ++i) {
      sensors.push_back(point_sensor("sensor", i + 11));
      sensors[i].noise_m[2] = 0.25 * (i + 1);
    }
    return sensors;
  }

  const Outputs& process_three_samples() {
    builder_.begin(5, 1000);
    for (std::uint32_t i = 0; i < 3; ++i) {
      auto& points = add_points(builder_, i + 11);
      for (std::uint32_t j = 0; j <= i; ++j) points.push_back({1.0 + i, 0, 0});
    }
    return plugin_.process(builder_.finish());
  }

  std::map<std::string, double> counters_of_a_frame() {
    plugin_.activate(three_sensors());
    std::map<std::string, double> counters;
    for (const Counter& counter : process_three_samples().counters()) counters[counter.name] = counter.value;
    return counters;
  }

  FrameBuilder builder_;
  Plugin plugin_;
};

TEST_P(Growth, SensorInfosAreReadThroughTheArrayOfPointers) {
  const auto counters = counters_of_a_frame();
  EXPECT_EQ(counters.at("sensor_sum"), 111213);
  EXPECT_EQ(counters.at("last_noise"), 0.75);
}

TEST_P(Growth, SamplesAreReadThroughTheArrayOfPointers) {
  const auto counters = counters_of_a_frame();
  EXPECT_EQ(counters.at("sample_sum"), 111213);
  EXPECT_EQ(counters.at("x_sum"), 1 + 2 * 2 + 3 * 3);
}

TEST_P(Growth, AMemberIsSeenOnlyWhereBothSidesHaveIt) {
  const bool both = GetParam().has_grown && kHostHasGrown;
  EXPECT_EQ(counters_of_a_frame().at("grown_structs"), both ? 6 : 0);
}

TEST_P(Growth, DriveBodyAndIntrinsicsAreReadWhereTheyAreKnown) {
  Activation robot = three_sensors();
  SensorInfo& wheels = robot.sensors.emplace_back();
  wheels.id = 14;
  wheels.kind = HW_SAMPLE_ENCODER;
  wheels.noise_m[2] = 1.0;
  wheels.intrinsics = EncoderIntrinsics{{{.m_per_tick = 0.5}, {.m_per_tick = 0.75}}};
  robot.drive = DriveInfo{.kind = HW_DRIVE_TRACKED, .max_speed_m_s = 0.25};
  robot.body = BodyInfo{.corners = {{0, 0}, {2, 0}, {1, 3}}};
  plugin_.activate(robot);
  std::map<std::string, double> counters;
  for (const Counter& counter : process_three_samples().counters()) counters[counter.name] = counter.value;
  const bool known = GetParam().is_later;
  EXPECT_EQ(counters.at("sensor_sum"), 11121314);
  EXPECT_EQ(counters.at("speed"), known ? 0.25 : 0);
  EXPECT_EQ(counters.at("corner"), known ? 3 : 0);
  EXPECT_EQ(counters.at("wheel"), known ? 0.75 : 0);
  EXPECT_EQ(counters.at("grown_parts"), GetParam().has_grown && kHostHasGrown ? 3 : 0);
}

TEST_P(Growth, RatesAndLaterKindsAreReadWhereTheyAreKnown) {
  Activation robot = three_sensors();
  robot.sensors[0].rate_hz = 10.0;
  robot.sensors[0].noise_per_m[2] = 0.5;
  SensorInfo& imu = robot.sensors.emplace_back();
  imu.id = 14;
  imu.kind = HW_SAMPLE_IMU;
  imu.noise_m[2] = 1.0;
  imu.intrinsics = ImuIntrinsics{.gravity_m_s2 = 9.75};
  plugin_.activate(robot);
  builder_.begin(5, 1000);
  add_points(builder_, 11) = {{1, 0, 0}, {2, 0, 0}};
  add_point_data(builder_).ring = {3, 4};
  add_range_scan(builder_, 15).rays = {{0, 0, 1}, {0, 0, 2.5}};
  add_odometry(builder_, 16).T_odom_sensor.position[0] = 0.25;
  builder_.last().payload<hw_odometry_t>().covariance[20] = 0.5;
  add_imu(builder_, 14).angular_rad_s[2] = -0.75;
  std::map<std::string, double> counters;
  for (const Counter& counter : plugin_.process(builder_.finish()).counters())
    counters[counter.name] = counter.value;
  const bool known = GetParam().is_later;
  EXPECT_EQ(counters.at("x_sum"), 3);
  EXPECT_EQ(counters.at("rate"), known ? 10.5 : 0);
  EXPECT_EQ(counters.at("gravity"), known ? 9.75 : 0);
  EXPECT_EQ(counters.at("ring"), known ? 4 : 0);
  EXPECT_EQ(counters.at("range"), known ? 2.5 : 0);
  EXPECT_EQ(counters.at("way"), known ? 0.75 : 0);
  EXPECT_EQ(counters.at("turn"), known ? -0.75 : 0);
  EXPECT_EQ(counters.at("grown_payloads"), GetParam().has_grown && kHostHasGrown ? 3 : 0);
}

TEST_P(Growth, OutputsOfAFrameArrive) {
  plugin_.activate(three_sensors());
  const Outputs& outputs = process_three_samples();
  ASSERT_TRUE(outputs.pose());
  EXPECT_EQ(outputs.pose()->T_map_body.position[0], 14);
  EXPECT_EQ(outputs.pose()->t_ns, GetParam().is_later ? 999 : 0);
  EXPECT_EQ(outputs.drive_command(), (DriveCommand{0.5, -14, GetParam().is_later ? 0.25 : 0.0}));
  const auto ids = outputs.associations(2);
  ASSERT_TRUE(ids);
  EXPECT_EQ(std::vector<std::uint64_t>(ids->begin(), ids->end()), std::vector<std::uint64_t>({2, 2, 2}));
}

TEST_P(Growth, PlanesArriveWhereTheyAreKnown) {
  plugin_.activate(three_sensors());
  const auto planes = process_three_samples().planes(0);
  ASSERT_EQ(planes.has_value(), GetParam().is_later);
  if (!planes) return;
  ASSERT_EQ(planes->planes.size(), 1u);
  EXPECT_EQ(planes->planes[0].id, 3u);
  EXPECT_EQ(planes->members_of(planes->planes[0]).size(), 1u);
}

TEST_P(Growth, TopologyAndDrawingArriveWhereTheyAreKnown) {
  plugin_.activate(three_sensors());
  const Outputs& outputs = process_three_samples();
  ASSERT_EQ(outputs.topology() != nullptr, GetParam().is_later);
  ASSERT_EQ(outputs.drawing() != nullptr, GetParam().is_later);
  if (outputs.topology() == nullptr) return;
  const Topology& topology = *outputs.topology();
  ASSERT_EQ(topology.nodes().size(), 1u);
  EXPECT_EQ(topology.nodes()[0].id, 4u);
  EXPECT_EQ(topology.nodes()[0].t_ns, 1000);
  ASSERT_EQ(topology.edges().size(), 1u);
  EXPECT_EQ(topology.edges()[0].length_m, 2.5);
  EXPECT_EQ(topology.loop(), HW_LOOP_CLOSED);
  EXPECT_EQ(topology.note(), "it came back");
  const Drawing& drawing = *outputs.drawing();
  ASSERT_EQ(drawing.items().size(), 2u);
  EXPECT_EQ(drawing.items()[0].text, "here");
  EXPECT_EQ(drawing.points_of(drawing.items()[1])[0].y_m, 4);
  EXPECT_EQ(drawing.items()[1].radius_m, 0.5);
}

TEST_P(Growth, TheMapArrives) {
  plugin_.activate(three_sensors());
  const Outputs& map = plugin_.report(true);
  ASSERT_EQ(map.landmarks().size(), 2u);
  EXPECT_EQ(map.landmarks()[1].id, 8u);
  EXPECT_EQ(map.landmarks()[1].position[2], 7);
  ASSERT_EQ(map.plane_landmarks().planes().size(), GetParam().is_later ? 1u : 0u);
  for (const hw_mapped_plane_t& plane : map.plane_landmarks().planes()) {
    ASSERT_EQ(map.plane_landmarks().outline(plane).size(), 3u);
    EXPECT_EQ(map.plane_landmarks().outline(plane)[0].flags, HW_EDGE_CERTAIN);
  }
  ASSERT_EQ(map.submaps().size(), 1u);
  EXPECT_EQ(map.members(map.submaps()[0]).size(), 2u);
}

TEST_P(Growth, ParametersAreDescribedAndSet) {
  ASSERT_EQ(plugin_.parameters().size(), 2u);
  EXPECT_EQ(plugin_.parameters()[1].unit, "m");
  plugin_.set_parameter("first", "3");
  plugin_.set_parameter("second_m", "4.5");
  const auto counters = counters_of_a_frame();
  EXPECT_EQ(counters.at("first"), 3);
  EXPECT_EQ(counters.at("second"), 4.5);
}

TEST_P(Growth, ReasonsOfFailuresArrive) {
  plugin_.set_parameter("first", "9");
  const auto error = test::error_of([&] { plugin_.activate(three_sensors()); });
  ASSERT_TRUE(error);
  EXPECT_NE(error->message().find("nine is refused"), std::string::npos) << error->what();
}

INSTANTIATE_TEST_SUITE_P(Plugins, Growth,
                         testing::Values(Build{"OfToday", GROWTH_PLUGIN_TODAY, false},
                                         Build{"OfVersion1_0", GROWTH_PLUGIN_FROZEN, false, false},
                                         Build{"Grown", GROWTH_PLUGIN_GROWN, true}),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace hallway::host
