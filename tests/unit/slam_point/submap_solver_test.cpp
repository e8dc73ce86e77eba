// SPDX-License-Identifier: MIT
#include "slam_point/core/solver/map_step.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "rings.hpp"
#include "slam_point/core/fit/alignment.hpp"
#include "support/dense.hpp"

namespace hallway::slam_point {
namespace {

using rings::noisy_ring;
using rings::total_cost;

/// One Gauss-Newton step with poses *and* landmarks as unknowns in one dense system, submap 0 held: the oracle.
void brute_force_step(const SubmapGraph& graph, std::vector<Pose>& poses, std::vector<Vec3>& landmarks) {
  const Eigen::Index pose_unknowns = 6 * (static_cast<Eigen::Index>(poses.size()) - 1);
  const Eigen::Index unknowns = pose_unknowns + 3 * static_cast<Eigen::Index>(landmarks.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(unknowns);
  for (std::size_t s = 0; s < poses.size(); ++s) {
    for (const Member& member : graph.submaps[s].members) {
      Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(3, unknowns);
      const Vec3 y = poses[s].q * member.mean;
      if (s > 0) {
        const Eigen::Index at = 6 * (static_cast<Eigen::Index>(s) - 1);
        jacobian.block<3, 3>(0, at).setIdentity();
        jacobian.block<3, 3>(0, at + 3) << 0.0, y.z(), -y.y(), -y.z(), 0.0, y.x(), y.y(), -y.x(), 0.0;
      }
      jacobian.block<3, 3>(0, pose_unknowns + 3 * static_cast<Eigen::Index>(member.landmark)) =
          -Mat3::Identity();
      normal += dense::product(member.count * jacobian.transpose(), jacobian);
      gradient += member.count * jacobian.transpose() * (y + poses[s].t - landmarks[member.landmark]);
    }
  }
  const Eigen::VectorXd move = dense::solve_symmetric(normal, gradient);
  for (std::size_t s = 1; s < poses.size(); ++s) {
    const Eigen::Index at = 6 * (static_cast<Eigen::Index>(s) - 1);
    poses[s].t -= move.segment<3>(at);
    poses[s].q = (rotation_exp(-move.segment<3>(at + 3)) * poses[s].q).normalized();
  }
  for (std::size_t l = 0; l < landmarks.size(); ++l) {
    landmarks[l] -= move.segment<3>(pose_unknowns + 3 * static_cast<Eigen::Index>(l));
  }
}

TEST(SubmapSolver, ReachesWhatBruteForceReaches) {
  const SubmapGraph graph = noisy_ring(7, false, 1);
  std::vector<Pose> brute = graph.poses;
  std::vector<Vec3> landmarks;
  for (const LandmarkRecord& landmark : graph.landmarks) landmarks.push_back(landmark.position);
  for (int step = 0; step < 30; ++step) brute_force_step(graph, brute, landmarks);

  std::vector<Pose> poses = graph.poses;
  EXPECT_GT(optimise(graph, 30, poses), 0);
  EXPECT_LT(total_cost(graph, poses), total_cost(graph, brute) * (1.0 + 1e-8));
  for (std::size_t s = 0; s < poses.size(); ++s) {
    EXPECT_LT((poses[s].t - brute[s].t).norm(), 1e-4) << "submap " << s;
    EXPECT_LT(rotation_log(poses[s].q * brute[s].q.conjugate()).norm(), 1e-5) << "submap " << s;
  }
}

TEST(SubmapSolver, AStepIsThatOfBruteForce) {
  const SubmapGraph graph = noisy_ring(9, false, 2);
  std::vector<Pose> brute = graph.poses;
  std::vector<Vec3> landmarks;
  for (Index l = 0; l < graph.landmarks.size(); ++l) landmarks.push_back(graph.mean_position(l));
  brute_force_step(graph, brute, landmarks);
  std::vector<Pose> poses = graph.poses;
  EXPECT_EQ(optimise(graph, 1, poses), 1);
  for (std::size_t k = 0; k < poses.size(); ++k) EXPECT_LT((brute[k].t - poses[k].t).norm(), 1e-6);
}

TEST(SubmapSolver, TheWorkOfAStepIsKnownBeforehand) {
  const SubmapGraph graph = noisy_ring(30, false, 7);
  MapStep step;
  step.begin(graph, graph.poses, kNone);
  ASSERT_TRUE(step.advance(1e12));
  const double work = step_work(graph);
  EXPECT_GT(work, 0.0);
  EXPECT_LT(work, step.work()) << "which has the making of the rows in it";
}

TEST(SubmapSolver, TheFirstSubmapNeverMoves) {
  const SubmapGraph graph = noisy_ring(7, false, 4);
  std::vector<Pose> poses = graph.poses;
  EXPECT_GT(optimise(graph, 20, poses), 0);
  EXPECT_EQ(poses[0].t, graph.poses[0].t);
  EXPECT_EQ(poses[0].q.coeffs(), graph.poses[0].q.coeffs());
}

TEST(SubmapSolver, PlanarDataStaysInItsPlaneExactly) {
  const SubmapGraph graph = noisy_ring(8, true, 5);
  std::vector<Pose> poses = graph.poses;
  EXPECT_GT(optimise(graph, 20, poses), 0);
  for (const Pose& pose : poses) {
    EXPECT_EQ(pose.t.z(), 0.0);
    EXPECT_EQ(pose.q.x(), 0.0);
    EXPECT_EQ(pose.q.y(), 0.0);
  }
}

TEST(SubmapSolver, MergedLandmarksCountAsOne) {
  SubmapGraph graph = noisy_ring(5, false, 6);
  const std::uint32_t count = [&] {
    std::uint32_t sum = 0;
    for (const SubmapRecord& submap : graph.submaps) {
      for (const Member& member : submap.members)
        sum += member.landmark == 3 || member.landmark == 4 ? member.count : 0;
    }
    return sum;
  }();
  graph.merge(3, 4);
  EXPECT_EQ(graph.landmarks[3].count, count);
  EXPECT_EQ(graph.landmarks[4].count, 0u);
  EXPECT_EQ(graph.landmarks[4].merged_into, 3u);
  std::vector<Pose> poses = graph.poses;
  EXPECT_GT(optimise(graph, 20, poses), 0);
}

}  // namespace
}  // namespace hallway::slam_point
