// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/random.hpp"
#include "map/world.hpp"
#include "sense/occluders.hpp"
#include "support/long_mode.hpp"
#include "trace/scene.hpp"
#include "unit/sense/map_text.hpp"
#include "unit/sense/plane_fixture.hpp"

// What the sensor of planes sees, against rays: from the same brushes, but through the triangles of all their faces in three
// dimensions. Nothing of walls, plans, intervals or shadows is shared.

namespace hallway::sense {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846;
constexpr int kRays = 2000;
constexpr double kOnEdge = 1e-6;  ///< radians; a ray this near to the end of a piece may fall on either side
constexpr double kSamePlace_m = 1e-6;

/// A hall of 24 by 18 m with turned prisms in it, some of them low or hanging, some in each other, some in the walls.
std::vector<std::string> random_brushes(const Random& random, std::uint32_t round) {
  std::vector<std::string> brushes{
      test::box_brush({-12, -9, 0}, {12, -8.7, 3}), test::box_brush({-12, 8.7, 0}, {12, 9, 3}),
      test::box_brush({-12, -9, 0}, {-11.7, 9, 3}), test::box_brush({11.7, -9, 0}, {12, 9, 3}),
      test::box_brush({-12, -9, -0.2}, {12, 9, 0}), test::box_brush({-12, -9, 3}, {12, 9, 3.2})};
  const auto count = static_cast<std::uint64_t>(random.uniform(round, 0, 3.0, 14.0));
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto number = [&](std::uint64_t which, double low, double high) {
      return random.uniform(round, 100 * (i + 1) + which, low, high);
    };
    const Vec2 middle(number(0, -11, 11), number(1, -8, 8));
    const double turn = number(2, 0, 7), half_length = number(3, 0.1, 3.0), half_width = number(4, 0.05, 0.8);
    const Eigen::Rotation2Dd rotation(i % 3 == 0 ? 0.0 : turn);
    std::vector<Vec2> corners{
        {-half_length, -half_width}, {half_length, -half_width}, {half_length, half_width}};
    if (i % 4 != 0) corners.push_back({-half_length, half_width});
    for (Vec2& corner : corners) corner = rotation * corner + middle;
    const double low = i % 5 == 0 ? number(5, 0.5, 2.0) : 0.0;
    brushes.push_back(test::prism_brush(corners, low, low + number(6, 0.3, 3.5)));
  }
  return brushes;
}

struct Scenery {
  explicit Scenery(const std::vector<std::string>& brushes)
      : surface(csg::build_surface(map::build_world(test::parse_map(test::worldspawn({}, brushes))))),
        mesh(make_occluders(surface)),
        scene(mesh, trace::Backend::kBruteForce),
        plan(make_wall_plan(surface, {}, test::kEye_m)) {}

  csg::Surface surface;
  trace::TriangleMesh mesh;
  trace::Scene scene;
  WallPlan plan;
};

/// Where a ray meets a vertical face from its empty side.
struct RayHit {
  double distance_m = 0.0;
  bool faces = false;
};

/// What a ray meets: the first thing alone, or everything up to its end.
std::vector<RayHit> shoot(const Scenery& scenery, const Vec3& from, const Vec3& direction, bool through_all) {
  constexpr double kFarthest_m = 60.0;
  std::vector<RayHit> hits;
  double begun_m = 0.0;
  while (true) {
    const auto hit = scenery.scene.first_hit({from + begun_m * direction, direction, kFarthest_m});
    if (!hit) return hits;
    const auto& corner = scenery.mesh.triangles[hit->triangle];
    const Vec3& a = scenery.mesh.vertices[corner[0]];
    const Vec3 normal =
        (scenery.mesh.vertices[corner[1]] - a).cross(scenery.mesh.vertices[corner[2]] - a).normalized();
    hits.push_back({begun_m + hit->distance, normal.dot(direction) < 0.0});
    if (!through_all) return hits;
    begun_m += hit->distance + 1e-7;
  }
}

/// Where a ray of a bearing meets a piece, or nothing where it passes it; `near_end` where that is hard to say.
std::optional<double> meet(const PlaneObservation& plane, double bearing, bool& near_end) {
  const Vec2 direction(std::cos(bearing), std::sin(bearing));
  const auto side = [&](const Vec3& corner) {
    const Vec2 at = corner.head<2>();
    const double sine = (direction.x() * at.y() - direction.y() * at.x()) / at.norm();
    near_end = near_end || (std::abs(sine) < kOnEdge && direction.dot(at) > 0.0);
    return sine;
  };
  const double left = side(plane.corners[0]), right = side(plane.corners[1]);
  const double ahead = plane.plane.offset / plane.plane.normal.head<2>().dot(direction);
  if (left < 0.0 || right > 0.0 || ahead < 0.0) return std::nullopt;
  return ahead;
}

bool in_view(const WallViewSpec& view, double bearing, double distance_m) {
  if (std::abs(bearing) > 0.5 * view.horizontal_fov) return false;
  const bool round = view.bounded_sides || view.horizontal_fov >= kHalfTurn;
  const double range_m = round ? distance_m : distance_m * std::cos(bearing);
  return range_m >= view.min_range_m && range_m <= view.max_range_m;
}

/// Whether a place is on one of the walls that a piece says it belongs to.
bool is_on_wall(const Wall& wall, const Vec2& place) {
  const Vec2 along = (wall.right - wall.left).normalized();
  const double u = along.dot(place - wall.left);
  return std::abs(wall.normal().dot(place - wall.left)) < kSamePlace_m && u > -kSamePlace_m &&
         u < wall.length_m() + kSamePlace_m;
}

struct Counts {
  int compared = 0, met = 0, skipped = 0;
};

void compare(const Scenery& scenery, const PlaneSensorSpec& spec, const Pose& pose, Counts& counts) {
  const auto planes = test::observe(PlaneSensor(spec, scenery.plan, 1), pose);
  for (int i = 0; i < kRays; ++i) {
    const double bearing =
        (2.0 * (i + 0.37) / kRays - 1.0) * std::min(0.55 * spec.view.horizontal_fov, kHalfTurn);
    const Vec3 direction = pose.q * Vec3(std::cos(bearing), std::sin(bearing), 0.0);
    std::vector<double> expected;
    bool unsure = std::abs(std::abs(bearing) - 0.5 * spec.view.horizontal_fov) < kOnEdge;
    for (const RayHit& hit : shoot(scenery, pose.t, direction, !spec.view.occlusion)) {
      if (hit.faces && in_view(spec.view, bearing, hit.distance_m)) expected.push_back(hit.distance_m);
    }
    std::vector<double> given;
    for (const PlaneObservation& plane : planes) {
      const auto distance_m = meet(plane, bearing, unsure);
      if (!distance_m) continue;
      given.push_back(*distance_m);
      const Vec2 place = (pose.t + *distance_m * direction).head<2>();
      ASSERT_TRUE(unsure || is_on_wall(scenery.plan.walls[plane.true_plane], place)) << plane.true_plane;
    }
    if (unsure) {
      ++counts.skipped;
      continue;
    }
    std::sort(expected.begin(), expected.end());
    std::sort(given.begin(), given.end());
    ++counts.compared;
    counts.met += static_cast<int>(expected.size());
    ASSERT_EQ(given.size(), expected.size()) << "bearing " << bearing << " from " << pose.t.transpose();
    for (std::size_t k = 0; k < given.size(); ++k) ASSERT_NEAR(given[k], expected[k], kSamePlace_m);
  }
}

class PlaneRays : public testing::TestWithParam<WallViewSpec> {};

TEST_P(PlaneRays, AgreeWithWhatIsSeen) {
  const Random random(11, stream_id("test.plane_rays"));
  PlaneSensorSpec spec = test::plane_camera();
  spec.view = GetParam();
  Counts counts;
  const std::uint32_t rounds = test::sized(12u, 300u);
  for (std::uint32_t round = 0; round < rounds; ++round) {
    const Scenery scenery(random_brushes(random, round));
    for (std::uint64_t place = 0; place < 4; ++place) {
      const Pose pose = test::standing(random.uniform(round, 3 * place + 1, -11, 11),
                                       random.uniform(round, 3 * place + 2, -8, 8),
                                       random.uniform(round, 3 * place + 3, -4, 4));
      ASSERT_NO_FATAL_FAILURE(compare(scenery, spec, pose, counts))
          << "round " << round << ", place " << place;
    }
  }
  EXPECT_GT(counts.compared, 50 * counts.skipped);
  EXPECT_GT(counts.met, counts.compared / 4);
}

WallViewSpec view(double fov_deg, double min_range_m, double max_range_m, bool bounded_sides,
                  bool occlusion) {
  return {.horizontal_fov = fov_deg * kHalfTurn / 180.0,
          .min_range_m = min_range_m,
          .max_range_m = max_range_m,
          .bounded_sides = bounded_sides,
          .occlusion = occlusion,
          .min_length_m = 0.0};
}

INSTANTIATE_TEST_SUITE_P(Views, PlaneRays,
                         testing::Values(view(90, 0, 12, false, true), view(90, 0.5, 8, true, true),
                                         view(60, 1, 6, false, false), view(200, 0.3, 15, true, true),
                                         view(360, 0, 30, false, true), view(270, 1, 10, false, false)));

}  // namespace
}  // namespace hallway::sense
