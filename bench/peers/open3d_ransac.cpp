// SPDX-License-Identifier: MIT
#include <open3d/geometry/PointCloud.h>
#include <open3d/utility/Random.h>

#include <algorithm>
#include <cmath>

#include "peeling.hpp"

namespace hallway::peers {
namespace {

/// The plane with most points within `distance` by RANSAC, refined by least squares; of its points the largest DBSCAN cluster.
struct Open3dRansac {
  static constexpr hw_plugin_info_t kInfo =
      peer_info("peer_open3d_ransac", "Open3D: RANSAC and DBSCAN",
                "Planes one after the other: PointCloud::SegmentPlane, PointCloud::ClusterDBSCAN.");

  double distance = 3.0;
  double gap = 4.0;
  int core_points = 10;
  int iterations = 1000;
  double probability = 0.99;
  int patience = 3;

  void declare(sdk::Parameters& parameters) {
    parameters.add("distance", &distance, 0.1, 1000.0, "noises", "Inliers lie so near to the plane.");
    parameters.add("gap", &gap, 0.1, 1000.0, "spacings", "Reach of a point of a cluster.");
    parameters.add("core_points", &core_points, 1, 1000, "points", "Within its reach it has so many.");
    parameters.add("iterations", &iterations, 1, 10'000'000, "iterations", "Most triples tried for a plane.");
    parameters.add("probability", &probability, 0.01, 0.999999, "1", "That one triple was of inliers alone.");
    parameters.add("patience", &patience, 1, 1000, "planes", "So many too small ones in a row end it.");
  }

  std::vector<Members> find(const Task& task) const {
    open3d::utility::SetVerbosityLevel(open3d::utility::VerbosityLevel::Error);  // plugins print nothing
    open3d::utility::random::Seed(0);
    return peel(task, patience, [&](const std::vector<std::uint32_t>& rest) { return next(task, rest); });
  }

 private:
  Members next(const Task& task, const std::vector<std::uint32_t>& rest) const {
    open3d::geometry::PointCloud left;
    left.points_.reserve(rest.size());
    for (const std::uint32_t i : rest) left.points_.push_back(task.points[i]);
    const Eigen::Vector4d plane =
        std::get<0>(left.SegmentPlane(distance * task.noise, 3, iterations, probability));
    const std::vector<std::size_t> inliers = near(plane, left, distance * task.noise);
    if (inliers.size() < static_cast<std::size_t>(task.min_points)) return {};
    Members members = largest_cluster(task, left, inliers);
    for (std::uint32_t& i : members) i = rest[i];
    return members;
  }

  /// The inliers that the search gives are those of three points; the plane is fitted to them.
  static std::vector<std::size_t> near(const Eigen::Vector4d& plane, const open3d::geometry::PointCloud& left,
                                       double distance) {
    std::vector<std::size_t> inliers;
    for (std::size_t i = 0; i < left.points_.size(); ++i) {
      if (std::abs(plane.head<3>().dot(left.points_[i]) + plane[3]) < distance) inliers.push_back(i);
    }
    return inliers;
  }

  Members largest_cluster(const Task& task, const open3d::geometry::PointCloud& left,
                          const std::vector<std::size_t>& inliers) const {
    const std::vector<int> labels =
        left.SelectByIndex(inliers)->ClusterDBSCAN(gap * task.spacing, static_cast<std::size_t>(core_points));
    std::vector<Members> clusters;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (labels[i] < 0) continue;
      const auto label = static_cast<std::size_t>(labels[i]);
      if (clusters.size() <= label) clusters.resize(label + 1);
      clusters[label].push_back(static_cast<std::uint32_t>(inliers[i]));
    }
    if (clusters.empty()) return {};
    return *std::max_element(clusters.begin(), clusters.end(),
                             [](const Members& a, const Members& b) { return a.size() < b.size(); });
  }
};

}  // namespace
}  // namespace hallway::peers

HALLWAY_PLUGINS(hallway::peers::PeerPlugin<hallway::peers::Open3dRansac>);
