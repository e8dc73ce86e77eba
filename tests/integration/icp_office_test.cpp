// SPDX-License-Identifier: MIT
// Iterative closest point in the office without noise is exact: with robust weights as it is, and with plain least squares where the points
// that appear or disappear from frame to frame are left out, as thesis 3.2 does.
#include <gtest/gtest.h>

#include <algorithm>

#include "icp/core/localiser.hpp"
#include "sim/scenario.hpp"
#include "sim/simulator.hpp"
#include "support/data.hpp"

namespace hallway {
namespace {

using Seen = std::vector<sense::PointObservation>;

class IcpOffice : public testing::Test {
 protected:
  static sim::Scenario scenario() {
    sim::Scenario scenario = sim::load_scenario(test::source_folder() / "maps" / "office.toml");
    std::get<sense::PointSensorSpec>(scenario.sensors.front()).noise_m = Vec3::Zero();
    return scenario;
  }

  Seen seen(std::uint32_t step) const { return simulator_.step(step).readings.front().observations(); }
  /// Where the sensor is, seen from where it was at first.
  Pose truth(std::uint32_t step) const {
    const Pose& mount = std::get<sense::PointSensorSpec>(scenario_.sensors.front()).T_body_sensor;
    const Pose T = (simulator_.pose_at(0) * mount).inverse() * simulator_.pose_at(step) * mount;
    return {T.q, T.t};
  }
  std::uint32_t loop() const { return scenario_.steps / 2; }

  sim::Scenario scenario_ = scenario();
  sim::Simulator simulator_{scenario_, 2, trace::Backend::kEmbree};
};

TEST_F(IcpOffice, RobustWeightsFollowALoopToAMillimetre) {
  for (const icp::Against against : {icp::Against::previous, icp::Against::keyframe, icp::Against::map}) {
    icp::Options options;
    options.against = against;
    icp::Localiser localiser(options);
    double worst_m = 0.0;
    for (std::uint32_t step = 0; step <= loop(); ++step) {
      icp::Points points;
      for (const sense::PointObservation& each : seen(step)) points.push_back(each.point);
      const icp::Answer& answer = localiser.process(points);
      ASSERT_TRUE(answer.has_pose) << "step " << step;
      worst_m = std::max(worst_m, (answer.T_map_sensor.t - truth(step).t).norm());
    }
    EXPECT_LE(worst_m, 1e-3) << "against " << static_cast<int>(against);
  }
}

/// The points of `seen` whose landmark is in `other` too.
icp::Points common(const Seen& seen, const Seen& other) {
  icp::Points points;
  for (const sense::PointObservation& each : seen) {
    const auto same = [&each](const sense::PointObservation& one) { return one.landmark == each.landmark; };
    if (std::any_of(other.begin(), other.end(), same)) points.push_back(each.point);
  }
  return points;
}

TEST_F(IcpOffice, LeastSquaresFollowsALoopWithoutPointsThatComeAndGo) {
  const icp::Rules rules{.kernel = icp::Kernel::none, .reach_m = 1.5, .max_distance_m = 1.5};
  Pose T_map_sensor, motion;
  Seen last = seen(0);
  double worst_m = 0.0;
  for (std::uint32_t step = 1; step <= loop(); ++step) {
    const Seen now = seen(step);
    const icp::Target target(common(last, now), 0);
    const icp::Registration found = icp::register_cloud(target, common(now, last), motion, rules);
    ASSERT_EQ(found.outcome, icp::Outcome::converged) << "step " << step;
    motion = found.T_target_source;
    T_map_sensor = T_map_sensor * motion;
    worst_m = std::max(worst_m, (T_map_sensor.t - truth(step).t).norm());
    last = now;
  }
  EXPECT_LE(worst_m, 1e-3);
}

}  // namespace
}  // namespace hallway
