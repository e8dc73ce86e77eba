// SPDX-License-Identifier: MIT
// The covariances that the mapper states, against the errors that it makes: Monte Carlo over seeds.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <map>
#include <set>

#include "scenes.hpp"
#include "slam_point/core/fit/alignment.hpp"
#include "slam_point/core/mapper.hpp"
#include "support/dense.hpp"
#include "support/long_mode.hpp"

namespace hallway::slam_point {
namespace {

/// The mean of normalised squared errors per degree of freedom, of one run.
struct Nees {
  double landmarks = 0.0;
  double poses = 0.0;
};

struct Statistic {
  double mean = 0.0;
  double half_width = 0.0;  ///< of the 95 % interval of the mean, from the runs' own spread
};

Statistic statistic_of(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double sum = 0.0;
  for (const double value : values) sum += value;
  double squares = 0.0;
  for (const double value : values) squares += (value - sum / n) * (value - sum / n);
  // Student's t of 95 %, for 24 and, 5 % too wide, for more.
  return {sum / n, 2.07 * std::sqrt(squares / (n - 1.0) / n)};
}

/// A sensor that drives round a court of 12 m radius, looking outwards at a ring of points: it closes the loop every 240 frames.
scenes::Log court(std::uint64_t seed) {
  scenes::Random random(seed);
  scenes::Log log;
  for (int l = 0; l < 150; ++l) {
    const double a = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double r = random.uniform(25.0, 45.0);
    log.landmarks.push_back(Vec3(r * std::cos(a), r * std::sin(a), random.uniform(-6.0, 6.0)));
  }
  for (int f = 0; f < 480; ++f) {
    const double a = 2.0 * std::numbers::pi * f / 240.0;
    log.poses.push_back(scenes::heading(Vec3(12.0 * std::cos(a), 12.0 * std::sin(a), 0.0), a));
  }
  scenes::Sensor sensor;
  sensor.noise_m = 0.04;  // the mapper is not told
  observe(log, sensor, random);
  return log;
}

using Truths = std::map<LandmarkId, std::int64_t>;

/// T_map_world by the mapped landmarks of `map` that are among `fitted`.
Pose fit_to_world(const Map& map, const std::set<LandmarkId>& fitted, const Truths& truth_of,
                  const scenes::Log& log) {
  Eigen::Matrix3Xd from(3, 0);
  Eigen::Matrix3Xd to(3, 0);
  for (const Landmark& landmark : map.landmarks) {
    if (landmark.status != LandmarkStatus::mapped || !fitted.contains(landmark.id)) continue;
    from.conservativeResize(3, from.cols() + 1);
    to.conservativeResize(3, to.cols() + 1);
    from.rightCols<1>() = log.landmarks[static_cast<std::size_t>(truth_of.at(landmark.id))];
    to.rightCols<1>() = landmark.position;
  }
  const Eigen::Matrix4d T = dense::rigid_motion(from, to);
  return {Eigen::Quaterniond(Mat3(T.topLeftCorner<3, 3>())), T.topRightCorner<3, 1>()};
}

double landmark_nees(const Map& map, const Truths& truth_of, const scenes::Log& log) {
  std::set<LandmarkId> all;
  for (const Landmark& landmark : map.landmarks) all.insert(landmark.id);
  const Pose T_map_world = fit_to_world(map, all, truth_of, log);
  double sum = 0.0;
  double freedom = 0.0;
  for (const Landmark& landmark : map.landmarks) {
    if (landmark.status != LandmarkStatus::mapped) continue;
    EXPECT_TRUE(landmark.covariance);
    if (!landmark.covariance) continue;
    const Vec3 error =
        T_map_world * log.landmarks[static_cast<std::size_t>(truth_of.at(landmark.id))] - landmark.position;
    sum += error.dot(landmark.covariance->inverse() * error);
    freedom += 3.0;
  }
  return sum / freedom;
}

Nees nees_of_run(std::uint64_t seed) {
  const scenes::Log log = court(seed);
  Mapper mapper{Options()};
  Truths truth_of;
  double sum = 0.0;
  double freedom = 0.0;
  for (std::size_t f = 0; f < log.frames.size(); ++f) {
    std::vector<Vec3> points;
    for (const scenes::Seen& seen : log.frames[f]) points.push_back(seen.point);
    const Answer answer = mapper.process(points);
    EXPECT_TRUE(answer.has_pose);
    for (std::size_t i = 0; i < points.size(); ++i)
      truth_of.emplace(answer.associations[i], log.frames[f][i].truth);
    // Every so often in the second lap, when the map stands: the pose's error against the part of the map that it sees, as that is then. Where
    // that part lies in the whole is not in the covariance.
    if (f < 300 || f % 20 != 0) continue;
    EXPECT_TRUE(answer.covariance);
    if (!answer.covariance) continue;
    const std::set<LandmarkId> seen(answer.associations.begin(), answer.associations.end());
    const Pose truth = fit_to_world(mapper.map(), seen, truth_of, log) * log.poses[f];
    Eigen::Matrix<double, 6, 1> error;
    error << truth.t - answer.T_map_sensor.t, rotation_log(truth.q * answer.T_map_sensor.q.conjugate());
    sum += error.dot(dense::inverse(*answer.covariance) * error);
    freedom += 6.0;
  }
  return {landmark_nees(mapper.refined_map(), truth_of, log), sum / freedom};
}

class ConsistencyOfMapper : public testing::Test {};

TEST_F(ConsistencyOfMapper, ErrorsAreAsLargeAsTheCovariancesSay) {
  std::vector<double> landmarks;
  std::vector<double> poses;
  const std::uint64_t runs = test::sized<std::uint64_t>(24, 200);
  for (std::uint64_t seed = 1; seed <= runs; ++seed) {
    const Nees nees = nees_of_run(seed);
    landmarks.push_back(nees.landmarks);
    poses.push_back(nees.poses);
  }
  const Statistic of_landmarks = statistic_of(landmarks);
  const Statistic of_poses = statistic_of(poses);
  EXPECT_NEAR(of_landmarks.mean, 1.0, of_landmarks.half_width + 0.03);
  EXPECT_NEAR(of_poses.mean, 1.0, of_poses.half_width + 0.03);
}

}  // namespace
}  // namespace hallway::slam_point
