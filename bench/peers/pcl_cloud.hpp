// SPDX-License-Identifier: MIT
#pragma once

#include <pcl/PointIndices.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <memory>
#include <vector>

#include "plane_list.hpp"

namespace hallway::peers {

using PclCloud = pcl::PointCloud<pcl::PointXYZ>::ConstPtr;

/// PCL's form of points, in single precision.
inline PclCloud pcl_cloud(const std::vector<Vec3>& points) {
  const auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->reserve(points.size());
  for (const Vec3& p : points) {
    cloud->emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
  }
  return cloud;
}

inline Members to_members(const pcl::PointIndices& indices) {
  return {indices.indices.begin(), indices.indices.end()};
}

}  // namespace hallway::peers
