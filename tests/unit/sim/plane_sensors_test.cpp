// SPDX-License-Identifier: MIT
// Sensors of planes in scenarios and maps.
#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "sim/simulator.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"
#include "unit/sim/small_world.hpp"

namespace hallway::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

constexpr const char* kAll =
    "[sensor.eyes]\nkind = 'planes'\nhorizontal_fov_deg = 120\nvertical_fov_deg = 50\nmin_range_m = 0.5\n"
    "max_range_m = 7\nbounded_sides = true\nocclusion = false\nmin_length_m = 0.2\nnoise_m = 0.02\n"
    "noise_angle_deg = 0.3\nnoise_end_m = 0.005\nposition_m = [0.1, 0.2, 0.3]\nyaw_deg = 90\n";
constexpr const char* kAllOfAMap =
    "{\n\"classname\" \"hw_sensor\"\n\"name\" \"eyes\"\n\"kind\" \"planes\"\n\"horizontal_fov_deg\" \"120\"\n"
    "\"vertical_fov_deg\" \"50\"\n\"min_range_m\" \"0.5\"\n\"max_range_m\" \"7\"\n\"bounded_sides\" \"1\"\n"
    "\"occlusion\" \"0\"\n\"min_length_m\" \"0.2\"\n\"noise_m\" \"0.02\"\n\"noise_angle_deg\" \"0.3\"\n"
    "\"noise_end_m\" \"0.005\"\n\"position_m\" \"0.1 0.2 0.3\"\n\"yaw_deg\" \"90\"\n}\n";

/// The simulator of a scenario, in a map with pillars.
Simulator simulator_of(const test::TempFolder& folder, const std::string& sensors,
                       const std::string& entities = "") {
  folder.write("small.map", test::map_text(test::pillars(), entities));
  return Simulator(load_scenario(folder.write("s.toml", test::scenario_text(sensors))), 1,
                   trace::Backend::kBruteForce);
}

const sense::PlaneSensorSpec& spec_of(const Simulator& simulator) {
  return std::get<sense::PlaneSensorSpec>(simulator.scenario().sensors.at(0));
}

void expect_all(const sense::PlaneSensorSpec& spec) {
  EXPECT_EQ(spec.name, "eyes");
  EXPECT_EQ(spec.view.horizontal_fov, 120 * kDegree);
  EXPECT_EQ(spec.vertical_fov, 50 * kDegree);
  EXPECT_EQ(spec.view.min_range_m, 0.5);
  EXPECT_EQ(spec.view.max_range_m, 7.0);
  EXPECT_TRUE(spec.view.bounded_sides);
  EXPECT_FALSE(spec.view.occlusion);
  EXPECT_EQ(spec.view.min_length_m, 0.2);
  EXPECT_EQ(spec.noise_m, 0.02);
  EXPECT_EQ(spec.noise_angle, 0.3 * kDegree);
  EXPECT_EQ(spec.noise_end_m, 0.005);
  EXPECT_EQ(spec.T_body_sensor.t, Vec3(0.1, 0.2, 0.3));
  EXPECT_NEAR(angle_between(spec.T_body_sensor.q, from_yaw_pitch_roll(90 * kDegree, 0, 0)), 0.0, 1e-12);
}

TEST(PlaneSensors, AreReadFromScenarios) {
  const test::TempFolder folder;
  expect_all(spec_of(simulator_of(folder, kAll)));
}

TEST(PlaneSensors, AreReadFromMaps) {
  const test::TempFolder folder;
  expect_all(spec_of(simulator_of(folder, "", kAllOfAMap)));
}

TEST(PlaneSensors, HaveTheirDefaults) {
  const test::TempFolder folder;
  const Simulator simulator = simulator_of(folder, "[sensor.a]\nkind = 'planes'\n");
  const sense::PlaneSensorSpec& spec = spec_of(simulator);
  EXPECT_NEAR(spec.view.horizontal_fov, 90 * kDegree, 1e-15);
  EXPECT_EQ(spec.view.max_range_m, 100.0);
  EXPECT_FALSE(spec.view.bounded_sides);
  EXPECT_TRUE(spec.view.occlusion);
  EXPECT_EQ(spec.view.min_length_m, 0.05);
  EXPECT_EQ(spec.noise_m, 0.0);
}

TEST(PlaneSensors, SeeTheMapsWallsWhereTheyAre) {
  const test::TempFolder folder;
  const Simulator simulator =
      simulator_of(folder, "[sensor.a]\nkind = 'planes'\nposition_m = [0.2, 0, 0.5]\n");
  ASSERT_NE(simulator.walls(0), nullptr);
  EXPECT_EQ(simulator.walls(0)->walls.size(), 16u) << "four of each of the four pillars";
  EXPECT_EQ(simulator.walls(0)->height_m, 0.5);
  std::size_t seen = 0;
  for (std::uint32_t i = 0; i < 40; ++i) {
    const Frame frame = simulator.step(i);
    EXPECT_TRUE(std::holds_alternative<std::vector<PlaneObservation>>(frame.readings[0].sensed));
    const Pose T_world_sensor = frame.T_world_body * spec_of(simulator).T_body_sensor;
    for (const PlaneObservation& plane : frame.readings[0].planes()) {
      const sense::Wall& wall = simulator.walls(0)->walls.at(plane.true_plane);
      for (const Vec3& corner : plane.corners) {
        const Vec3 place = T_world_sensor * corner;
        EXPECT_NEAR((place.head<2>() - wall.left).dot(wall.normal()), 0.0, 1e-9);
        EXPECT_NEAR(std::abs(place.z()), 1.0, 1e-9) << "the pillars stand from -1 m to 1 m";
      }
      ++seen;
    }
  }
  EXPECT_GT(seen, 40u);
}

TEST(PlaneSensors, OfMapsAreRefusedLikeThoseOfScenarios) {
  const auto refused = [](const std::string& keys) {
    const test::TempFolder folder;
    const auto error = test::error_of([&] {
      simulator_of(folder, "",
                   "{\n\"classname\" \"hw_sensor\"\n\"name\" \"eyes\"\n\"kind\" \"planes\"\n" + keys + "}\n");
    });
    return error && error->code() == ErrorCode::kBadInput;
  };
  EXPECT_FALSE(refused(""));
  EXPECT_TRUE(refused("\"pitch_deg\" \"1\"\n"));
  EXPECT_TRUE(refused("\"noise_per_m\" \"1\"\n"));
  EXPECT_TRUE(refused("\"noise_m\" \"1 2 3\"\n"));
  EXPECT_TRUE(refused("\"occlusion\" \"yes\"\n"));
  EXPECT_TRUE(refused("\"noise_angle_deg\" \"91\"\n"));
}

}  // namespace
}  // namespace hallway::sim
