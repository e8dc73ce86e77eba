// SPDX-License-Identifier: MIT
// In the office no landmark is ever seen through a wall, judged by the brute-force oracle.
#include <gtest/gtest.h>

#include <cmath>

#include "sense/occluders.hpp"
#include "sim/scenario.hpp"
#include "sim/simulator.hpp"
#include "support/data.hpp"
#include "support/long_mode.hpp"
#include "trace/scene.hpp"

namespace hallway {
namespace {

struct Office {
  sim::Scenario scenario = sim::load_scenario(test::source_folder() / "maps" / "office.toml");
  sim::Simulator simulator{scenario, 2, trace::Backend::kEmbree};
  /// Walls as they come out of the brushes, and the sculpture.
  trace::Scene oracle{
      sense::make_occluders(csg::build_surface(simulator.world()), sim::triangles_of(simulator.models())),
      trace::Backend::kBruteForce};

  Vec3 viewpoint(const sim::Frame& frame) const {
    return frame.T_world_body * std::get<sense::PointSensorSpec>(scenario.sensors.front()).T_body_sensor.t;
  }
};

TEST(Office, EveryObservationHasAFreeLineOfSight) {
  const Office office;
  // The oracle asks every triangle for every ray: all steps take minutes with a sanitizer.
  const std::uint32_t stride = test::long_mode() ? 1 : 7;
  std::size_t checked = 0;
  for (std::uint32_t step = 0; step < office.scenario.steps; step += stride) {
    const sim::Frame frame = office.simulator.step(step);
    const Vec3 eye = office.viewpoint(frame);
    for (const sense::PointObservation& seen : frame.readings.front().observations()) {
      ASSERT_FALSE(office.oracle.occluded(office.simulator.landmarks()[seen.landmark], eye))
          << "landmark " << seen.landmark << " at step " << step;
      ++checked;
    }
  }
  EXPECT_GT(checked, 1000u);
}

TEST(Office, WallsHideMostOfWhatIsInTheFieldOfView) {
  const Office office;
  const auto& sensor = std::get<sense::PointSensorSpec>(office.scenario.sensors.front());
  std::size_t in_view = 0;
  std::size_t seen = 0;
  for (std::uint32_t step = 0; step < office.scenario.steps; step += 50) {
    const sim::Frame frame = office.simulator.step(step);
    const Pose T_sensor_world = (frame.T_world_body * sensor.T_body_sensor).inverse();
    for (const Vec3& landmark : office.simulator.landmarks()) {
      const Vec3 p = T_sensor_world * landmark;
      const bool inside = p.norm() <= sensor.max_range_m && p.norm() >= sensor.min_range_m &&
                          std::abs(std::atan2(p.y(), p.x())) <= 0.5 * sensor.horizontal_fov &&
                          std::abs(std::atan2(p.z(), p.x())) <= 0.5 * sensor.vertical_fov;
      in_view += inside ? 1 : 0;
    }
    seen += frame.readings.front().observations().size();
  }
  EXPECT_GT(in_view, 2 * seen) << "the walls hide too little for the test above to mean anything";
  EXPECT_GT(seen, 0u);
}

TEST(Office, RobotSeesEnoughToKnowWhereItIs) {
  const Office office;
  for (std::uint32_t step = 0; step < office.scenario.steps; ++step) {
    EXPECT_GE(office.simulator.step(step).readings.front().observations().size(), 10u) << "step " << step;
  }
}

}  // namespace
}  // namespace hallway
