// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

#include "scenes.hpp"
#include "slam_point/core/fit/alignment.hpp"
#include "slam_point/core/submaps/submap_graph.hpp"

/// Graphs of submaps made up for the tests of what places them.
namespace hallway::slam_point::rings {

/// `submaps` submaps on a ring, each knowing the landmarks near it with noise; their poses are a little wrong.
inline SubmapGraph noisy_ring(int submaps, bool planar, std::uint64_t seed) {
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
  graph.planar = planar;
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
inline double total_cost(const SubmapGraph& graph, const std::vector<Pose>& poses) {
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

/// Every submap of the graph.
inline std::vector<Index> all_of(const SubmapGraph& graph) {
  std::vector<Index> all(graph.submaps.size());
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

}  // namespace hallway::slam_point::rings
