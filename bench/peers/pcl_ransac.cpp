// SPDX-License-Identifier: MIT
#include <pcl/segmentation/extract_clusters.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <memory>

#include "pcl_cloud.hpp"
#include "peeling.hpp"

namespace hallway::peers {
namespace {

/// The plane with most points within `distance` by RANSAC, refined by least squares; of its points the largest Euclidean cluster.
struct PclRansac {
  static constexpr hw_plugin_info_t kInfo =
      peer_info("peer_pcl_ransac", "PCL: RANSAC and Euclidean clusters",
                "Planes one after the other: pcl::SACSegmentation, pcl::EuclideanClusterExtraction.");

  double distance = 3.0;
  double gap = 4.0;
  int iterations = 1000;
  double probability = 0.99;
  int patience = 2;

  void declare(sdk::Parameters& parameters) {
    parameters.add("distance", &distance, 0.1, 1000.0, "noises", "Inliers lie so near to the plane.");
    parameters.add("gap", &gap, 0.1, 1000.0, "spacings", "Points so near to each other are one cluster.");
    parameters.add("iterations", &iterations, 1, 10'000'000, "iterations", "Most triples tried for a plane.");
    parameters.add("probability", &probability, 0.01, 0.999999, "1", "That one triple was of inliers alone.");
    parameters.add("patience", &patience, 1, 1000, "planes", "So many too small ones in a row end it.");
  }

  std::vector<Members> find(const Task& task) const {
    const auto cloud = pcl_cloud(task.points);
    return peel(task, patience,
                [&](const std::vector<std::uint32_t>& rest) { return next(task, cloud, rest); });
  }

 private:
  Members next(const Task& task, const PclCloud& cloud, const std::vector<std::uint32_t>& rest) const {
    const auto indices = std::make_shared<pcl::Indices>(rest.begin(), rest.end());
    const auto inliers = std::make_shared<pcl::PointIndices>();
    pcl::ModelCoefficients coefficients;
    pcl::SACSegmentation<pcl::PointXYZ> search;  // its random numbers have a fixed seed
    search.setModelType(pcl::SACMODEL_PLANE);
    search.setMethodType(pcl::SAC_RANSAC);
    search.setDistanceThreshold(distance * task.noise);
    search.setMaxIterations(iterations);
    search.setProbability(probability);
    search.setOptimizeCoefficients(true);
    search.setInputCloud(cloud);
    search.setIndices(indices);
    search.segment(*inliers, coefficients);
    if (inliers->indices.size() < static_cast<std::size_t>(task.min_points)) return {};
    return largest_cluster(task, cloud, inliers);
  }

  Members largest_cluster(const Task& task, const PclCloud& cloud,
                          const pcl::PointIndices::ConstPtr& inliers) const {
    pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
    extraction.setClusterTolerance(gap * task.spacing);
    extraction.setInputCloud(cloud);
    extraction.setIndices(inliers);
    std::vector<pcl::PointIndices> clusters;
    extraction.extract(clusters);  // largest first
    if (clusters.empty()) return {};
    return to_members(clusters.front());
  }
};

}  // namespace
}  // namespace hallway::peers

HALLWAY_PLUGINS(hallway::peers::PeerPlugin<hallway::peers::PclRansac>);
