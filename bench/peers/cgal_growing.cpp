// SPDX-License-Identifier: MIT
#include <CGAL/Shape_detection/Region_growing/Region_growing.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing_on_point_set.h>

#include <iterator>

#include "cgal_cloud.hpp"
#include "peer.hpp"

namespace hallway::peers {
namespace {

namespace shapes = CGAL::Shape_detection;

/// Planes that are refitted as they grow. Growing from the flattest neighbourhoods first takes longer and finds no more.
struct CgalGrowing {
  using Query = shapes::Point_set::K_neighbor_query<CgalKernel, CgalCloud, CgalPointMap>;
  using Region =
      shapes::Point_set::Least_squares_plane_fit_region<CgalKernel, CgalCloud, CgalPointMap, CgalNormalMap>;

  static constexpr hw_plugin_info_t kInfo =
      peer_info("peer_cgal_growing", "CGAL: region growing",
                "CGAL::Shape_detection::Region_growing on CGAL::pca_estimate_normals.");

  int normal_neighbours = 20;
  int neighbours = 12;
  double angle_deg = 25.0;
  double distance = 3.0;

  void declare(sdk::Parameters& parameters) {
    parameters.add("normal_neighbours", &normal_neighbours, 3, 1000, "points",
                   "A normal is of so many points.");
    parameters.add("neighbours", &neighbours, 3, 1000, "points", "A region grows to so many at once.");
    parameters.add("angle_deg", &angle_deg, 0.1, 90.0, "deg", "Between a point's normal and its plane's.");
    parameters.add("distance", &distance, 0.1, 1000.0, "noises", "Points lie so near to their plane.");
  }

  std::vector<Members> find(const Task& task) const {
    const CgalCloud cloud = cgal_cloud(task.points, normal_neighbours);
    Query query(cloud, static_cast<std::size_t>(neighbours));
    Region region(cloud, distance * task.noise, angle_deg, static_cast<std::size_t>(task.min_points));
    std::vector<std::vector<std::size_t>> found;
    shapes::Region_growing<CgalCloud, Query, Region> growing(cloud, query, region);
    growing.detect(std::back_inserter(found));
    std::vector<Members> planes;
    for (const auto& indices : found) planes.push_back(cgal_members(cloud, indices));
    return planes;
  }
};

}  // namespace
}  // namespace hallway::peers

HALLWAY_PLUGINS(hallway::peers::PeerPlugin<hallway::peers::CgalGrowing>);
