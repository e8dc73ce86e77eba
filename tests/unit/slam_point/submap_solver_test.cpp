// SPDX-License-Identifier: MIT
#include "slam_point/core/submap_solver.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <numeric>
#include <vector>

#include "scenes.hpp"
#include "slam_point/core/alignment.hpp"

namespace hallway::slam_point {
namespace {

/// `submaps` submaps on a ring, each knowing the landmarks near it with noise; their poses are a little wrong.
SubmapGraph noisy_ring(int submaps, bool planar, std::uint64_t seed) {
  scenes::Random random(seed);
  const auto noise = [&](double size) {
    return Vec3(size * random.normal(), size * random.normal(), planar ? 0.0 : size * random.normal());
  };
  std::vector<Vec3> points;
  for (int i = 0; i < 6 * submaps; ++i) {
    const double a = 2.0 * std::numbers::pi * i / (6.0 * submaps);
    const double r = 20.0 + random.uniform(-4.0, 4.0);
    points.push_back(Vec3(r * std::cos(a), r * std::sin(a), planar ? 0.0 : random.uniform(-3.0, 3.0)));
  }
  SubmapGraph graph(1.0);
  for (const Vec3& p : points) graph.add_landmark(p, 0);
  for (int s = 0; s < submaps; ++s) {
    const double a = 2.0 * std::numbers::pi * s / submaps;
    const Pose truth = scenes::heading(Vec3(20.0 * std::cos(a), 20.0 * std::sin(a), 0.0), a + 1.57);
    const double off = s == 0 ? 0.0 : 1.0;
    const Vec3 turn = planar ? Vec3(0.0, 0.0, 0.02 * random.normal()) : noise(0.02);
    const Index submap = graph.add_submap({rotation_exp(off * turn) * truth.q, truth.t + off * noise(0.2)});
    for (Index l = 0; l < points.size(); ++l) {
      if ((points[l] - truth.t).norm() > 14.0) continue;
      const Index member = graph.join(submap, l, truth.inverse() * points[l] + noise(0.05), false);
      graph.submaps[submap].members[member].count = 1 + static_cast<std::uint32_t>(random.uniform(0.0, 9.0));
    }
  }
  return graph;
}

/// The cost as defined: each landmark at the weighted mean of its places.
double total_cost(const SubmapGraph& graph, const std::vector<Pose>& poses) {
  double cost = 0.0;
  for (const LandmarkRecord& landmark : graph.landmarks) {
    Vec3 sum = Vec3::Zero();
    double count = 0.0;
    for (const Membership& at : landmark.memberships) {
      const Member& member = graph.submaps[at.submap].members[at.member];
      sum += member.count * (poses[at.submap] * member.mean);
      count += member.count;
    }
    for (const Membership& at : landmark.memberships) {
      const Member& member = graph.submaps[at.submap].members[at.member];
      cost += member.count * (poses[at.submap] * member.mean - sum / count).squaredNorm();
    }
  }
  return cost;
}

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
      normal += member.count * jacobian.transpose() * jacobian;
      gradient += member.count * jacobian.transpose() * (y + poses[s].t - landmarks[member.landmark]);
    }
  }
  const Eigen::VectorXd move = normal.ldlt().solve(gradient);
  for (std::size_t s = 1; s < poses.size(); ++s) {
    const Eigen::Index at = 6 * (static_cast<Eigen::Index>(s) - 1);
    poses[s].t -= move.segment<3>(at);
    poses[s].q = (rotation_exp(-move.segment<3>(at + 3)) * poses[s].q).normalized();
  }
  for (std::size_t l = 0; l < landmarks.size(); ++l) {
    landmarks[l] -= move.segment<3>(pose_unknowns + 3 * static_cast<Eigen::Index>(l));
  }
}

std::vector<Index> all_of(const SubmapGraph& graph) {
  std::vector<Index> all(graph.submaps.size());
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

TEST(SubmapSolver, ReachesWhatBruteForceReaches) {
  const SubmapGraph graph = noisy_ring(7, false, 1);
  std::vector<Pose> brute = graph.poses;
  std::vector<Vec3> landmarks;
  for (const LandmarkRecord& landmark : graph.landmarks) landmarks.push_back(landmark.position);
  for (int step = 0; step < 30; ++step) brute_force_step(graph, brute, landmarks);

  std::vector<Pose> poses = graph.poses;
  SubmapSolver solver;
  EXPECT_GT(solver.solve_all(graph, false, 30, poses), 0);
  EXPECT_LT(total_cost(graph, poses), total_cost(graph, brute) * (1.0 + 1e-8));
  for (std::size_t s = 0; s < poses.size(); ++s) {
    EXPECT_LT((poses[s].t - brute[s].t).norm(), 1e-4) << "submap " << s;
    EXPECT_LT(rotation_log(poses[s].q * brute[s].q.conjugate()).norm(), 1e-5) << "submap " << s;
  }
}

TEST(SubmapSolver, DenseAndSparseStepsAreTheSame) {
  const SubmapGraph graph = noisy_ring(9, false, 2);
  std::vector<Pose> dense = graph.poses;
  std::vector<Pose> sparse = graph.poses;
  SubmapSolver solver;
  const SubmapSolver::Step d = solver.step_dense(graph, all_of(graph), false, dense);
  const SubmapSolver::Step s = solver.step_sparse(graph, all_of(graph), false, sparse);
  EXPECT_NEAR(d.cost_before, total_cost(graph, graph.poses), 1e-9 * d.cost_before);
  EXPECT_NEAR(d.cost_after, s.cost_after, 1e-9 * d.cost_after);
  for (std::size_t k = 0; k < dense.size(); ++k) EXPECT_LT((dense[k].t - sparse[k].t).norm(), 1e-9);
}

TEST(SubmapSolver, AWindowLowersTheCostAndHoldsTheRest) {
  const SubmapGraph graph = noisy_ring(12, false, 3);
  std::vector<Pose> poses = graph.poses;
  SubmapSolver solver;
  const SubmapSolver::Step step = solver.step_dense(graph, {11, 9, 10, 8}, false, poses);
  EXPECT_LT(step.cost_after, step.cost_before);
  EXPECT_LT(total_cost(graph, poses), total_cost(graph, graph.poses));
  for (std::size_t s = 0; s < 8; ++s) {
    EXPECT_EQ(poses[s].t, graph.poses[s].t);
    EXPECT_EQ(poses[s].q.coeffs(), graph.poses[s].q.coeffs());
  }
}

TEST(SubmapSolver, TheFirstSubmapNeverMoves) {
  const SubmapGraph graph = noisy_ring(6, false, 4);
  std::vector<Pose> poses = graph.poses;
  SubmapSolver().solve_all(graph, false, 20, poses);
  EXPECT_EQ(poses[0].t, graph.poses[0].t);
  EXPECT_EQ(poses[0].q.coeffs(), graph.poses[0].q.coeffs());
}

TEST(SubmapSolver, PlanarDataStaysInItsPlaneExactly) {
  const SubmapGraph graph = noisy_ring(8, true, 5);
  std::vector<Pose> poses = graph.poses;
  SubmapSolver solver;
  EXPECT_GT(solver.solve_all(graph, true, 20, poses), 0);
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
  EXPECT_GT(SubmapSolver().solve_all(graph, false, 20, poses), 0);
}

}  // namespace
}  // namespace hallway::slam_point
