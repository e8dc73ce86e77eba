// SPDX-License-Identifier: MIT
#include <CGAL/Random.h>
#include <CGAL/Shape_detection/Efficient_RANSAC.h>

#include <cmath>

#include "cgal_cloud.hpp"
#include "peer.hpp"

namespace hallway::peers {
namespace {

/// Schnabel's RANSAC: triples from cells of an octree, tested on parts of the cloud, connected in cells on the plane.
struct CgalRansac {
  using Traits =
      CGAL::Shape_detection::Efficient_RANSAC_traits<CgalKernel, CgalCloud, CgalPointMap, CgalNormalMap>;
  using Search = CGAL::Shape_detection::Efficient_RANSAC<Traits>;

  static constexpr hw_plugin_info_t kInfo =
      peer_info("peer_cgal_ransac", "CGAL: efficient RANSAC",
                "CGAL::Shape_detection::Efficient_RANSAC on CGAL::pca_estimate_normals.");

  int normal_neighbours = 20;
  double distance = 2.5;
  double gap = 4.0;
  double angle_deg = 25.0;
  double probability = 0.01;

  void declare(sdk::Parameters& parameters) {
    parameters.add("normal_neighbours", &normal_neighbours, 3, 1000, "points",
                   "A normal is of so many points.");
    parameters.add("distance", &distance, 0.1, 1000.0, "noises", "Points lie so near to their plane.");
    parameters.add("gap", &gap, 0.1, 1000.0, "spacings", "Side of the cells on a plane that hang together.");
    parameters.add("angle_deg", &angle_deg, 0.1, 90.0, "deg", "Between a point's normal and its plane's.");
    parameters.add("probability", &probability, 1e-6, 1.0, "1", "That a larger plane was missed.");
  }

  std::vector<Members> find(const Task& task) const {
    CgalCloud cloud = cgal_cloud(task.points, normal_neighbours);
    CGAL::get_default_random() = CGAL::Random(0);  // the same answer each time
    Search search;
    search.set_input(cloud);
    search.add_shape_factory<CGAL::Shape_detection::Plane<Traits>>();
    Search::Parameters parameters;
    parameters.probability = probability;
    parameters.min_points = static_cast<std::size_t>(task.min_points);
    parameters.epsilon = distance * task.noise;
    parameters.cluster_epsilon = gap * task.spacing;
    parameters.normal_threshold = std::cos(angle_deg * M_PI / 180.0);
    search.detect(parameters);
    std::vector<Members> planes;
    for (const auto& shape : search.shapes())
      planes.push_back(cgal_members(cloud, shape->indices_of_assigned_points()));
    return planes;
  }
};

}  // namespace
}  // namespace hallway::peers

HALLWAY_PLUGINS(hallway::peers::PeerPlugin<hallway::peers::CgalRansac>);
