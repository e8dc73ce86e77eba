// SPDX-License-Identifier: MIT
//
// Hits compared with what geometry says by other formulas, in long double.
#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <vector>

#include "support/long_mode.hpp"
#include "trace/scene.hpp"
#include "unit/trace/backend_under_test.hpp"
#include "unit/trace/shapes.hpp"

namespace hallway::trace {
namespace {

using Real = long double;
using RealVec = Eigen::Matrix<Real, 3, 1>;

/// Where a line is inside a convex body, by cutting it with the body's half-spaces.
struct Inside {
  Real enter = -std::numeric_limits<Real>::infinity();
  Real leave = std::numeric_limits<Real>::infinity();
};

Inside inside_of(const test::Body& body, const Ray& ray) {
  Inside inside;
  for (const Polygon& face : body) {
    const RealVec normal = face.plane.normal.cast<Real>();
    const Real slope = normal.dot(ray.direction.cast<Real>());
    const Real height = normal.dot(face.vertices[0].cast<Real>() - ray.origin.cast<Real>());
    if (slope < 0) inside.enter = std::max(inside.enter, height / slope);
    if (slope > 0) inside.leave = std::min(inside.leave, height / slope);
    if (slope == 0 && height < 0) inside.leave = -std::numeric_limits<Real>::infinity();
  }
  return inside;
}

TEST(AgainstGeometry, ConvexBodiesAreEnteredAndLeftWhereTheirHalfSpacesSay) {
  test::Draw draw(11);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    const auto body = test::clutter(draw, 2, 10.0, Vec3::Zero()).back();
    const Scene scene(test::mesh_of({body}), kBackend);
    const Vec3 centre = 0.5 * (body[0].vertices[0] + body[1].vertices[0]);
    for (int j = 0; j < 50; ++j) {
      Ray ray{draw.point(15.0), Vec3::Zero(), 100.0};
      ray.direction = (centre + draw.point(2.0) - ray.origin).normalized();
      const Inside inside = inside_of(body, ray);
      const Real chord = inside.leave - inside.enter;
      if (std::abs(chord) < 1e-6L) continue;  // at the outline, where rounding decides
      const auto hit = scene.first_hit(ray);
      const bool expected = chord > 0 && inside.leave > 0;
      ASSERT_EQ(hit.has_value(), expected) << i << " " << j;
      if (!hit) continue;
      ++hits;
      const Real distance = inside.enter > 0 ? inside.enter : inside.leave;
      ASSERT_NEAR(hit->distance, static_cast<double>(distance), 1e-9) << i << " " << j;
    }
  }
  EXPECT_GT(hits, 3000);
}

TEST(AgainstGeometry, NoRayLeavesAClosedBodyThroughItsSeams) {
  test::Draw draw(12);
  for (int i = 0; i < 200; ++i) {
    const auto body = test::clutter(draw, 1 + i % 2, 10.0, Vec3::Zero()).back();
    const Scene scene(test::mesh_of({body}), kBackend);
    Vec3 centre = Vec3::Zero();
    for (const Polygon& face : body) centre += face.vertices[0] / static_cast<double>(body.size());
    for (const Polygon& face : body) {
      for (std::size_t j = 0; j < face.vertices.size(); ++j) {
        const Vec3& a = face.vertices[j];
        const Vec3& b = face.vertices[(j + 1) % face.vertices.size()];
        for (const double along : {0.0, 1e-12, draw.uniform(0.0, 1.0), 0.5}) {
          const Vec3 target = a + along * (b - a);
          const auto hit = scene.first_hit({centre, target - centre, 1000.0});
          ASSERT_TRUE(hit) << i;
          ASSERT_NEAR(hit->distance, (target - centre).norm(), 1e-9) << i;
        }
      }
    }
  }
}

/// What one triangle is to a line, and how far from the nearest edge the line passes.
struct Crossing {
  Real distance;
  bool inside;
  Real edge_distance;
};

std::optional<Crossing> crossing(const TriangleMesh& mesh, std::uint32_t triangle, const Ray& ray) {
  std::array<RealVec, 3> v;
  for (std::size_t i = 0; i < 3; ++i) v[i] = mesh.vertices[mesh.triangles[triangle][i]].cast<Real>();
  const RealVec direction = ray.direction.cast<Real>().normalized();
  const RealVec normal = (v[1] - v[0]).cross(v[2] - v[0]).normalized();
  const Real slope = normal.dot(direction);
  if (slope == 0) return std::nullopt;
  Crossing crossing{normal.dot(v[0] - ray.origin.cast<Real>()) / slope, true, 1e9L};
  const RealVec point = ray.origin.cast<Real>() + crossing.distance * direction;
  for (std::size_t i = 0; i < 3; ++i) {
    const RealVec edge = (v[(i + 1) % 3] - v[i]).normalized();
    const Real inward = normal.cross(edge).dot(point - v[i]);
    const Real along = edge.dot(direction);
    crossing.inside = crossing.inside && inward > 0;
    const Real line_distance =
        std::abs(inward * slope) / std::sqrt(std::max<Real>(1e-30L, 1 - along * along));
    crossing.edge_distance = std::min(crossing.edge_distance, line_distance);
  }
  return crossing;
}

/// Rays through a cluttered scene against the reference: whatever passes 0.1 mm from all edges' lines must be
/// as in exact arithmetic.
void compare_with_reference(double size, const Vec3& centre, double tolerance_m) {
  test::Draw draw(13);
  const TriangleMesh mesh = test::mesh_of(test::clutter(draw, 12, size, centre));
  const Scene scene(mesh, kBackend);
  int compared = 0;
  const int rays = test::sized(3000, 100000);
  for (int i = 0; i < rays; ++i) {
    const Ray ray{centre + draw.point(1.2 * size), draw.direction(), 4.0 * size};
    Real nearest = std::numeric_limits<Real>::infinity();
    bool decided = true;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto c = crossing(mesh, t, ray);
      if (!c) continue;
      decided = decided && c->edge_distance > 1e-4L;
      if (c->inside && c->distance >= 0) nearest = std::min(nearest, c->distance);
    }
    if (!decided) continue;
    ++compared;
    const auto hit = scene.first_hit(ray);
    ASSERT_EQ(hit.has_value(), nearest <= 4.0L * size) << i;
    if (!hit) continue;
    ASSERT_NEAR(hit->distance, static_cast<double>(nearest), tolerance_m) << i;
  }
  EXPECT_GT(compared, rays / 2);
}

TEST(AgainstGeometry, RaysAwayFromEdgesAreAsInExactArithmeticInARoom) {
  compare_with_reference(10.0, Vec3::Zero(), 1e-10);
}

TEST(AgainstGeometry, RaysAwayFromEdgesAreAsInExactArithmeticFarFromTheOrigin) {
  compare_with_reference(10.0, Vec3(1e4, -1e4, 9e3), 1e-6);
}

TEST(AgainstGeometry, RaysAwayFromEdgesAreAsInExactArithmeticInALandscape) {
  compare_with_reference(1e4, Vec3::Zero(), 1e-6);
}

}  // namespace
}  // namespace hallway::trace
