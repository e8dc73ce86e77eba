// SPDX-License-Identifier: MIT
#include "slam_point/core/solver/landmark_covariances.hpp"

#include <gtest/gtest.h>

#include "rings.hpp"
#include "slam_point/core/solver/map_step.hpp"
#include "support/dense.hpp"

namespace hallway::slam_point {
namespace {

Eigen::Matrix<double, 3, 6> motion_by_hand(const Vec3& y) {
  Eigen::Matrix<double, 3, 6> motion = Eigen::Matrix<double, 3, 6>::Zero();
  motion.leftCols<3>().setIdentity();
  for (int i = 0; i < 3; ++i) motion.col(3 + i) = Vec3::Unit(i).cross(y);
  return motion;
}

/// By definition: the inverse of the whole normal equations over poses and landmarks with submap 0 held, then the fit taken out
/// of all landmarks' errors at once.
Eigen::MatrixXd dense_covariance(const SubmapGraph& graph, const std::vector<bool>& in_gauge) {
  const auto submaps = static_cast<Eigen::Index>(graph.submaps.size());
  const auto landmarks = static_cast<Eigen::Index>(graph.landmarks.size());
  const Eigen::Index poses = 6 * (submaps - 1);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(poses + 3 * landmarks, poses + 3 * landmarks);
  Eigen::MatrixXd positions = Eigen::MatrixXd::Zero(3, landmarks);
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(landmarks);
  for (Eigen::Index s = 0; s < submaps; ++s) {
    for (const Member& member : graph.submaps[static_cast<std::size_t>(s)].members) {
      const Pose& pose = graph.poses[static_cast<std::size_t>(s)];
      const auto l = static_cast<Eigen::Index>(member.landmark);
      Eigen::MatrixXd derivative = Eigen::MatrixXd::Zero(3, normal.rows());
      if (s > 0) derivative.block<3, 6>(0, 6 * (s - 1)) = motion_by_hand(pose.q * member.mean);
      derivative.block<3, 3>(0, poses + 3 * l) = -Mat3::Identity();
      normal += dense::product(member.count * derivative.transpose(), derivative);
      positions.col(l) += member.count * (pose * member.mean);
      counts(l) += member.count;
    }
  }
  for (Eigen::Index l = 0; l < landmarks; ++l) positions.col(l) /= counts(l);
  const Eigen::MatrixXd held = dense::inverse(normal).bottomRightCorner(3 * landmarks, 3 * landmarks);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 * landmarks, 6);
  Eigen::MatrixXd fitted = all;
  for (Eigen::Index l = 0; l < landmarks; ++l) {
    all.middleRows<3>(3 * l) = motion_by_hand(positions.col(l));
    if (in_gauge[static_cast<std::size_t>(l)]) fitted.middleRows<3>(3 * l) = all.middleRows<3>(3 * l);
  }
  const Eigen::MatrixXd gauge = dense::inverse(dense::product(fitted.transpose(), fitted));
  const Eigen::MatrixXd project = Eigen::MatrixXd::Identity(3 * landmarks, 3 * landmarks) -
                                  dense::product(dense::product(all, gauge), fitted.transpose());
  return dense::product(dense::product(project, held), project.transpose());
}

TEST(LandmarkCovariances, AreThoseOfTheWholeNormalEquations) {
  SubmapGraph graph = rings::noisy_ring(9, false, 4);
  optimise(graph, 20, graph.poses);
  std::vector<bool> in_gauge(graph.landmarks.size(), true);
  for (std::size_t l = 0; l < in_gauge.size(); l += 5) in_gauge[l] = false;
  const Eigen::MatrixXd expected = dense_covariance(graph, in_gauge);
  const auto covariances = landmark_covariances(graph, in_gauge);
  for (std::size_t l = 0; l < covariances.size(); ++l) {
    ASSERT_TRUE(covariances[l]);
    const auto at = 3 * static_cast<Eigen::Index>(l);
    const Mat3 block = expected.block<3, 3>(at, at);
    EXPECT_LT((*covariances[l] - block).norm(), 1e-6 * block.norm()) << l;
  }
}

TEST(LandmarkCovariances, InPlanarDataNothingMovesAlongZ) {
  SubmapGraph graph = rings::noisy_ring(9, true, 5);
  optimise(graph, 20, graph.poses);
  for (const auto& covariance :
       landmark_covariances(graph, std::vector<bool>(graph.landmarks.size(), true))) {
    ASSERT_TRUE(covariance);
    EXPECT_TRUE(covariance->row(2).isZero(0.0) && covariance->col(2).isZero(0.0));
    EXPECT_GT((*covariance)(0, 0), 0.0);
    EXPECT_GT((*covariance)(1, 1), 0.0);
  }
}

TEST(LandmarkCovariances, OneSubmapKnowsItsLandmarksToTheirCounts) {
  SubmapGraph graph(1.0);
  graph.add_submap({});
  for (Index l = 0; l < 200; ++l) {
    const double a = 0.1 * l;
    const Vec3 p(10.0 * std::cos(a), 10.0 * std::sin(a), std::sin(7.0 * a));
    graph.add_landmark(p, 0);
    graph.submaps[0].members[graph.join(0, l, p, true)].count = 4;
  }
  const auto covariances = landmark_covariances(graph, std::vector<bool>(200, true));
  for (const auto& covariance : covariances) {
    ASSERT_TRUE(covariance);
    // A little less than 1/4: the fit takes its share.
    EXPECT_LT(covariance->trace(), 0.75);
    EXPECT_GT(covariance->trace(), 0.72);
  }
}

TEST(LandmarkCovariances, WithoutAFitThereAreNone) {
  SubmapGraph graph(1.0);
  EXPECT_TRUE(landmark_covariances(graph, {}).empty());
  graph.add_submap({});
  for (Index l = 0; l < 5; ++l) {
    graph.add_landmark(Vec3(l, 0, 0), 0);
    graph.submaps[0].members[graph.join(0, l, Vec3(l, 0, 0), true)].count = 1;
  }
  for (const auto& covariance : landmark_covariances(graph, std::vector<bool>(5, true)))
    EXPECT_FALSE(covariance) << "all on a line";
}

}  // namespace
}  // namespace hallway::slam_point
