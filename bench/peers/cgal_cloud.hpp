// SPDX-License-Identifier: MIT
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/pca_estimate_normals.h>
#include <CGAL/property_map.h>

#include <cstdint>
#include <tuple>
#include <vector>

#include "plane_list.hpp"

namespace hallway::peers {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
/// A point, its normal and its place in the cloud: the RANSAC puts points into another order.
using CgalPoint = std::tuple<CgalKernel::Point_3, CgalKernel::Vector_3, std::uint32_t>;
using CgalCloud = std::vector<CgalPoint>;
using CgalPointMap = CGAL::Nth_of_tuple_property_map<0, CgalPoint>;
using CgalNormalMap = CGAL::Nth_of_tuple_property_map<1, CgalPoint>;

/// The places that indices into a cloud stand for.
inline Members cgal_members(const CgalCloud& cloud, const std::vector<std::size_t>& indices) {
  Members members;
  members.reserve(indices.size());
  for (const std::size_t i : indices) members.push_back(std::get<2>(cloud[i]));
  return members;
}

/// CGAL's form of points, with normals by principal component analysis of the `neighbours` nearest, one thread.
inline CgalCloud cgal_cloud(const std::vector<Vec3>& points, int neighbours) {
  CgalCloud cloud;
  cloud.reserve(points.size());
  for (const Vec3& p : points) {
    cloud.emplace_back(CgalKernel::Point_3(p.x(), p.y(), p.z()), CgalKernel::Vector_3(),
                       static_cast<std::uint32_t>(cloud.size()));
  }
  CGAL::pca_estimate_normals<CGAL::Sequential_tag>(
      cloud, static_cast<unsigned>(neighbours),
      CGAL::parameters::point_map(CgalPointMap()).normal_map(CgalNormalMap()));
  return cloud;
}

}  // namespace hallway::peers
