// SPDX-License-Identifier: MIT
#include <pcl/features/normal_3d.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/region_growing.h>

#include <cmath>
#include <memory>

#include "pcl_cloud.hpp"
#include "peer.hpp"

namespace hallway::peers {
namespace {

/// Regions of points whose normals turn little from one to the next.
struct PclGrowing {
  static constexpr hw_plugin_info_t kInfo =
      peer_info("peer_pcl_growing", "PCL: region growing", "pcl::RegionGrowing on pcl::NormalEstimation.");

  int normal_neighbours = 30;
  int neighbours = 15;
  double angle_deg = 8.0;
  double curvature = 0.1;

  void declare(sdk::Parameters& parameters) {
    parameters.add("normal_neighbours", &normal_neighbours, 3, 1000, "points",
                   "A normal is of so many points.");
    parameters.add("neighbours", &neighbours, 3, 1000, "points", "A region grows to so many at once.");
    parameters.add("angle_deg", &angle_deg, 0.1, 90.0, "deg", "Between normals of neighbours, at most.");
    parameters.add("curvature", &curvature, 1e-6, 1.0, "1", "Points that are flatter let the region grow.");
  }

  std::vector<Members> find(const Task& task) const {
    const auto cloud = pcl_cloud(task.points);
    const auto tree = std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
    const auto normals = std::make_shared<pcl::PointCloud<pcl::Normal>>();
    pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
    estimation.setSearchMethod(tree);
    estimation.setInputCloud(cloud);
    estimation.setKSearch(normal_neighbours);
    estimation.compute(*normals);
    pcl::RegionGrowing<pcl::PointXYZ, pcl::Normal> growing;
    growing.setMinClusterSize(static_cast<pcl::uindex_t>(task.min_points));
    growing.setSearchMethod(tree);
    growing.setNumberOfNeighbours(static_cast<unsigned>(neighbours));
    growing.setInputCloud(cloud);
    growing.setInputNormals(normals);
    growing.setSmoothnessThreshold(static_cast<float>(angle_deg * M_PI / 180.0));
    growing.setCurvatureThreshold(static_cast<float>(curvature));
    std::vector<pcl::PointIndices> clusters;
    growing.extract(clusters);
    std::vector<Members> planes;
    for (const pcl::PointIndices& cluster : clusters) planes.push_back(to_members(cluster));
    return planes;
  }
};

}  // namespace
}  // namespace hallway::peers

HALLWAY_PLUGINS(hallway::peers::PeerPlugin<hallway::peers::PclGrowing>);
