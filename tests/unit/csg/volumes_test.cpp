// SPDX-License-Identifier: MIT
// Volumes of two and three bodies, against those of the bodies alone and of what they share, which is one convex brush.
#include <gtest/gtest.h>

#include "csg/surface.hpp"
#include "support/long_mode.hpp"
#include "support/random_brushes.hpp"
#include "surface_checks.hpp"

namespace hallway::csg {
namespace {

using map::BrushRole;
using test::Act;
using test::RandomActs;
using test::WorldKind;

double volume(const std::vector<Act>& acts) {
  return test::volume_of(build_surface(map::build_world(test::document_of(acts))));
}

/// Volume of a convex body by its own polygons, without csg.
double body_volume(const map::Brush& brush) {
  const map::World world = map::build_world(test::document_of({{BrushRole::kAdd, brush}}));
  if (world.solids.empty()) return 0.0;  // nothing lies behind all faces
  double sum = 0.0;
  const Vec3 centre = world.bounds.center();
  for (const map::SolidFace& face : world.solids.front().faces) {
    const auto& v = face.polygon.vertices;
    for (std::size_t i = 2; i < v.size(); ++i)
      sum += (v[0] - centre).dot((v[i - 1] - centre).cross(v[i] - centre)) / 6.0;
  }
  return sum;
}

/// All faces of some brushes, no plane twice: what the brushes share.
map::Brush common(const std::vector<map::Brush>& brushes) {
  map::Brush out;
  std::vector<Plane> planes;
  for (const map::Brush& brush : brushes) {
    for (const map::Face& face : brush.faces) {
      const Vec3 n = (face.points[2] - face.points[0]).cross(face.points[1] - face.points[0]).normalized();
      const Plane plane{n, n.dot(face.points[0])};
      const bool there = std::any_of(planes.begin(), planes.end(), [&](const Plane& other) {
        return (other.normal - n).norm() < 1e-9 && std::abs(other.offset - plane.offset) < 1e-7;
      });
      if (there) continue;
      planes.push_back(plane);
      out.faces.push_back(face);
    }
  }
  return out;
}

class VolumesOf : public testing::TestWithParam<WorldKind> {
 protected:
  std::vector<map::Brush> bodies(std::uint64_t seed, std::size_t count) {
    std::vector<map::Brush> out;
    for (std::uint64_t k = 0; out.size() < count; ++k) {
      for (const Act& act : RandomActs(GetParam(), 1000 * seed + k).make()) out.push_back(act.brush);
    }
    out.resize(count);
    return out;
  }
};
INSTANTIATE_TEST_SUITE_P(Volumes, VolumesOf,
                         testing::Values(WorldKind::kGrid, WorldKind::kDecimals, WorldKind::kTurned,
                                         WorldKind::kPrisms, WorldKind::kPolyhedra));

TEST_P(VolumesOf, OfTwoBodies) {
  int share = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(test::sized(40, 2000)); ++seed) {
    const auto b = bodies(seed, 2);
    const double v0 = body_volume(b[0]), v1 = body_volume(b[1]), both = body_volume(common(b));
    const double size = 1e-9 * (v0 + v1);
    share += both > 0.0 ? 1 : 0;
    EXPECT_NEAR(volume({{BrushRole::kAdd, b[0]}}), v0, size) << "seed " << seed;
    EXPECT_NEAR(volume({{BrushRole::kAdd, b[0]}, {BrushRole::kAdd, b[1]}}), v0 + v1 - both, size)
        << "union, seed " << seed;
    EXPECT_NEAR(volume({{BrushRole::kAdd, b[0]}, {BrushRole::kSubtract, b[1]}}), v0 - both, size)
        << "difference, seed " << seed;
  }
  EXPECT_GT(share, 4);
}

TEST_P(VolumesOf, OfThreeBodies) {
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(test::sized(30, 2000)); ++seed) {
    const auto b = bodies(seed, 3);
    const double v0 = body_volume(b[0]), v1 = body_volume(b[1]), v2 = body_volume(b[2]);
    const double v01 = body_volume(common({b[0], b[1]})), v02 = body_volume(common({b[0], b[2]}));
    const double v12 = body_volume(common({b[1], b[2]})), v012 = body_volume(common(b));
    const double size = 1e-9 * (v0 + v1 + v2);
    constexpr BrushRole add = BrushRole::kAdd, sub = BrushRole::kSubtract;
    EXPECT_NEAR(volume({{add, b[0]}, {add, b[1]}, {add, b[2]}}), v0 + v1 + v2 - v01 - v02 - v12 + v012, size)
        << "a + b + c, seed " << seed;
    EXPECT_NEAR(volume({{add, b[0]}, {add, b[1]}, {sub, b[2]}}), v0 + v1 - v01 - v02 - v12 + v012, size)
        << "a + b - c, seed " << seed;
    EXPECT_NEAR(volume({{add, b[0]}, {sub, b[1]}, {add, b[2]}}), v0 - v01 + v2 - v02 + v012, size)
        << "a - b + c, seed " << seed;
    EXPECT_NEAR(volume({{add, b[0]}, {sub, b[1]}, {sub, b[2]}}), v0 - v01 - v02 + v012, size)
        << "a - b - c, seed " << seed;
  }
}

}  // namespace
}  // namespace hallway::csg
