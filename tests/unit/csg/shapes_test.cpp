// SPDX-License-Identifier: MIT
// Shapes whose surface is known by heart.
#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "csg/surface.hpp"
#include "surface_checks.hpp"

namespace hallway::csg {
namespace {

using test::box;
using test::MapMaker;

/// World and surface of a map whose unit is a metre.
struct Made {
  explicit Made(const MapMaker& maker) : world(maker.world()), surface(build_surface(world)) {
    EXPECT_TRUE(world.problems.empty());
    EXPECT_EQ(test::not_closed(surface), "");
    EXPECT_EQ(test::unsound_polygon(world, surface, 5e-6), "");
    EXPECT_EQ(test::t_junction(surface, 1e-6), "");
    EXPECT_EQ(test::wrong_owner(world, surface, 3e-6), "");
  }

  std::size_t polygons() const {
    return static_cast<std::size_t>(std::count_if(surface.polygons.begin(), surface.polygons.end(),
                                                  [](const auto& p) { return !p.vertices.empty(); }));
  }
  double volume() const { return test::volume_of(surface); }
  int euler_characteristic() const {
    const auto edges = test::edges_of(surface);
    return static_cast<int>(surface.vertices.size()) - static_cast<int>(edges.size() / 2) +
           static_cast<int>(polygons());
  }
  /// The polygon that holds a point in its inside; fails if it is not exactly one.
  const SurfacePolygon* at(const Vec3& point) const {
    const SurfacePolygon* found = nullptr;
    for (const SurfacePolygon& polygon : surface.polygons) {
      if (polygon.vertices.empty() || std::abs(polygon.plane.distance(point)) > 1e-6) continue;
      bool inside = true;
      for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
        const Vec3& a = surface.vertices[polygon.vertices[i]];
        const Vec3& b = surface.vertices[polygon.vertices[(i + 1) % polygon.vertices.size()]];
        inside = inside && (b - a).cross(point - a).dot(polygon.plane.normal) >= 0.0;
      }
      if (!inside) continue;
      EXPECT_EQ(found, nullptr) << "two polygons at " << point.transpose();
      found = &polygon;
    }
    return found;
  }
  std::string material_at(const Vec3& point) const {
    const SurfacePolygon* polygon = at(point);
    return polygon ? world.solids[polygon->solid].faces[polygon->face].material : "nothing";
  }

  map::World world;
  Surface surface;
};

MapMaker metres() {
  return MapMaker(1.0);
}

TEST(Shapes, ABox) {
  const Made made(metres().add(box({1, 2, 3}, {4, 6, 8})));
  EXPECT_EQ(made.polygons(), 6u);
  EXPECT_EQ(made.surface.vertices.size(), 8u);
  EXPECT_DOUBLE_EQ(made.volume(), 60.0);
  EXPECT_EQ(test::not_manifold(made.surface), "");
}

TEST(Shapes, ASurfaceIsInMetres) {
  const Made made(MapMaker(0.01).add(box({0, 0, 0}, {100, 200, 300})));
  EXPECT_NEAR(made.volume(), 6.0, 1e-12);
  for (const SurfacePolygon& polygon : made.surface.polygons) {
    for (const std::uint32_t v : polygon.vertices)
      EXPECT_NEAR(polygon.plane.distance(made.surface.vertices[v]), 0.0, 1e-12);
  }
}

TEST(Shapes, NothingAtAll) {
  EXPECT_EQ(Made(metres()).polygons(), 0u);
  EXPECT_EQ(Made(metres().subtract(box({0, 0, 0}, {1, 1, 1}))).polygons(), 0u);
  EXPECT_EQ(Made(metres().hint(box({0, 0, 0}, {1, 1, 1}))).polygons(), 0u);
}

TEST(Shapes, ABrushTakenAwayWholeLeavesNothing) {
  EXPECT_EQ(Made(metres().add(box({0, 0, 0}, {1, 1, 1})).subtract(box({0, 0, 0}, {1, 1, 1}))).polygons(), 0u);
  EXPECT_EQ(Made(metres().add(box({0, 0, 0}, {1, 1, 1})).subtract(box({-1, 0, 0}, {2, 1, 3}))).polygons(),
            0u);
}

TEST(Shapes, FacesBetweenNeighboursAreGone) {
  const Made made(metres().add(box({0, 0, 0}, {1, 1, 1})).add(box({1, 0, 0}, {2, 1, 1})));
  EXPECT_EQ(made.polygons(), 10u);
  EXPECT_EQ(made.at({1.0, 0.5, 0.5}), nullptr);
  EXPECT_DOUBLE_EQ(made.volume(), 2.0);
}

TEST(Shapes, OfOverlappingBrushesTheLaterOwnsCommonFaces) {
  const Made made(
      metres().add(box({0, 0, 0}, {10, 10, 10}, "early")).add(box({5, 0, 0}, {15, 10, 10}, "late")));
  EXPECT_EQ(made.material_at({2, 5, 10}), "early");
  EXPECT_EQ(made.material_at({7, 5, 10}), "late");
  EXPECT_EQ(made.material_at({12, 5, 10}), "late");
  EXPECT_EQ(made.polygons(), 10u);
  EXPECT_DOUBLE_EQ(made.volume(), 1500.0);
}

TEST(Shapes, ADuplicateBrushOwnsEverything) {
  const Made made(metres().add(box({0, 0, 0}, {1, 1, 1}, "early")).add(box({0, 0, 0}, {1, 1, 1}, "late")));
  EXPECT_EQ(made.polygons(), 6u);
  for (const SurfacePolygon& polygon : made.surface.polygons) EXPECT_EQ(polygon.solid, 1u);
}

TEST(Shapes, ABrushInABrushIsNotSeen) {
  const Made made(metres().add(box({0, 0, 0}, {9, 9, 9})).add(box({3, 3, 3}, {6, 6, 6})));
  EXPECT_EQ(made.polygons(), 6u);
  EXPECT_DOUBLE_EQ(made.volume(), 729.0);
  const Made other(metres().add(box({3, 3, 3}, {6, 6, 6})).add(box({0, 0, 0}, {9, 9, 9})));
  EXPECT_EQ(other.polygons(), 6u);
  for (const SurfacePolygon& polygon : other.surface.polygons) EXPECT_EQ(polygon.solid, 1u);
}

TEST(Shapes, ATunnelMakesARing) {
  const Made made(metres().add(box({0, 0, 0}, {9, 9, 9})).subtract(box({-1, 3, 3}, {10, 6, 6}, "cut")));
  EXPECT_DOUBLE_EQ(made.volume(), 729.0 - 81.0);
  EXPECT_EQ(test::not_manifold(made.surface), "");
  EXPECT_EQ(made.euler_characteristic(), 0);
  EXPECT_EQ(made.material_at({4, 4, 3}), "cut") << "a cut's faces are those of the brush that cuts";
  EXPECT_EQ(made.material_at({0, 1, 1}), "wall");
  const SurfacePolygon* floor = made.at({4, 4, 3});
  EXPECT_GT(floor->plane.normal.z(), 0.99) << "they look into the tunnel";
}

TEST(Shapes, TunnelsThatCross) {
  const Made made(metres()
                      .add(box({0, 0, 0}, {9, 9, 9}))
                      .subtract(box({-1, 3, 3}, {10, 6, 6}), 1)
                      .subtract(box({3, -1, 3}, {6, 10, 6}), 2)
                      .subtract(box({3, 3, -1}, {6, 6, 10}), 3));
  EXPECT_DOUBLE_EQ(made.volume(), 729.0 - 3 * 81.0 + 2 * 27.0);
  EXPECT_EQ(test::not_manifold(made.surface), "");
  EXPECT_EQ(made.euler_characteristic(), -8) << "a sphere with five handles";
}

TEST(Shapes, RoomInRoomInRoom) {
  const Made made(metres()
                      .add(box({0, 0, 0}, {100, 100, 100}))
                      .subtract(box({10, 10, 10}, {90, 90, 90}), 1)
                      .add_later(box({20, 20, 20}, {80, 80, 80}), 2)
                      .subtract(box({30, 30, 30}, {70, 70, 70}), 3));
  EXPECT_EQ(made.polygons(), 24u);
  EXPECT_NEAR(made.volume(), 1e6 - 512e3 + 216e3 - 64e3, 1e-6);
  EXPECT_EQ(made.euler_characteristic(), 8) << "four spheres";
}

TEST(Shapes, OrderDecides) {
  const auto made = [](int add, int subtract) {
    return Made(metres()
                    .add(box({0, 0, 0}, {4, 4, 4}))
                    .add_later(box({1, 1, 0}, {2, 2, 6}), add)
                    .subtract(box({0, 0, 2}, {4, 4, 8}), subtract))
        .volume();
  };
  EXPECT_DOUBLE_EQ(made(1, 2), 32.0) << "cut after it was added";
  EXPECT_DOUBLE_EQ(made(2, 1), 32.0 + 4.0) << "added after the cut";
  EXPECT_DOUBLE_EQ(made(7, 7), 32.0) << "a tie: the order of the file";
  // worldspawn and the detail of other games come first, hw_detail by its order.
  const auto detail = [](const std::string& classname) {
    MapMaker maker = metres();
    maker.subtract(box({0, 0, 2}, {4, 4, 8}), -5).entity(classname, {box({0, 0, 0}, {4, 4, 4})});
    return Made(maker).volume();
  };
  EXPECT_DOUBLE_EQ(detail("func_group"), 32.0);
  EXPECT_DOUBLE_EQ(detail("func_detail"), 32.0);
  EXPECT_DOUBLE_EQ(detail("hw_detail"), 64.0) << "its order is 0";
}

TEST(Shapes, BrushesThatTouchInAnEdgeOrACornerAreClosedEach) {
  const Made edge(metres().add(box({0, 0, 0}, {1, 1, 1})).add(box({1, 1, 0}, {2, 2, 1})));
  EXPECT_EQ(edge.polygons(), 12u);
  EXPECT_NE(test::not_manifold(edge.surface), "") << "four polygons meet along the edge";
  const Made corner(metres().add(box({0, 0, 0}, {1, 1, 1})).add(box({1, 1, 1}, {2, 2, 2})));
  EXPECT_EQ(corner.polygons(), 12u);
  EXPECT_EQ(corner.surface.vertices.size(), 15u);
}

TEST(Shapes, VerticesOfNeighboursAreOnEdgesToo) {
  const Made made(metres()
                      .add(box({0, 0, 0}, {4, 1, 1}))
                      .add(box({0, 1, 0}, {1, 2, 1}))
                      .add(box({1, 1, 0}, {3, 2, 1}))
                      .add(box({3, 1, 0}, {4, 2, 1})));
  const SurfacePolygon* top = made.at({2, 0.5, 1});
  ASSERT_NE(top, nullptr);
  EXPECT_EQ(top->vertices.size(), 6u) << "the corners at 1 and 3 lie on its edge";
}

TEST(Shapes, ACylinderOf362Sides) {
  std::vector<Vec2> corners;
  for (int i = 0; i < 362; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 362.0;
    corners.push_back({1000.0 * std::cos(angle), 1000.0 * std::sin(angle)});
  }
  const Made made(metres().add(test::prism(corners, -100.0, 300.0)));
  EXPECT_EQ(made.polygons(), 364u);
  EXPECT_EQ(test::not_manifold(made.surface), "");
  const double area = 0.5 * 362.0 * 1e6 * std::sin(2.0 * std::numbers::pi / 362.0);
  EXPECT_NEAR(made.volume() / (400.0 * area), 1.0, 1e-9);
  const Made hollow(metres()
                        .add(box({-2000, -2000, -50}, {2000, 2000, 250}))
                        .subtract(test::prism(corners, -100.0, 300.0)));
  EXPECT_NEAR(hollow.volume() / (300.0 * (16e6 - area)), 1.0, 1e-9);
}

TEST(Shapes, ThinPlatesAndThinGaps) {
  for (const double thin : {1.0, 1e-3, 1e-4, 1e-5}) {
    const Made plate(metres().add(box({0, 0, 0}, {100, 100, thin})));
    EXPECT_EQ(plate.polygons(), 6u);
    EXPECT_NEAR(plate.volume() / (1e4 * thin), 1.0, 1e-9);
    const Made gap(
        metres().add(box({0, 0, 0}, {100, 100, 1})).add(box({0, 0, 1.0 + thin}, {100, 100, 2.0 + thin})));
    EXPECT_EQ(gap.polygons(), 12u) << thin;
    EXPECT_NEAR(gap.volume(), 2e4, 1e-5);
  }
}

TEST(Shapes, DetailIsPartOfTheSurfaceAndAHintIsNot) {
  const Made made(metres()
                      .add(box({0, 0, 0}, {4, 4, 1}))
                      .detail(box({1, 1, 1}, {2, 2, 3}, "pillar"))
                      .hint(box({0, 0, 1}, {4, 4, 2})));
  EXPECT_DOUBLE_EQ(made.volume(), 16.0 + 2.0);
  EXPECT_EQ(made.material_at({1.5, 1.5, 3}), "pillar");
  EXPECT_EQ(made.at({1.5, 1.5, 1}), nullptr);
  EXPECT_EQ(made.at({3.5, 3.5, 2}), nullptr);
}

TEST(Shapes, AFaceThatIsCutApartIsPutTogether) {
  // The tower's foot is covered by the slab it stands on and is cut by no one else.
  const Made made(
      metres().add(box({0, 0, 0}, {9, 9, 1})).add(box({3, 3, 1}, {6, 6, 2})).add(box({3, 3, 0}, {6, 6, 1})));
  std::size_t below = 0;
  for (const SurfacePolygon& polygon : made.surface.polygons)
    below += polygon.plane.normal.z() < -0.9 ? 1u : 0u;
  EXPECT_EQ(below, 5u) << "the slab's underside around that of the tower's foot, and the foot";
  EXPECT_DOUBLE_EQ(made.volume(), 81.0 + 9.0);
}

TEST(Shapes, ABadBrushTakesNoOtherWithIt) {
  map::Brush inverted = box({2, 0, 0}, {3, 1, 1});
  for (map::Face& face : inverted.faces) std::swap(face.points[1], face.points[2]);
  map::Brush open = box({4, 0, 0}, {5, 1, 1});
  open.faces.pop_back();
  const map::World world =
      metres().add(box({0, 0, 0}, {1, 1, 1})).add(inverted).add(open).add(box({6, 0, 0}, {7, 1, 1})).world();
  EXPECT_EQ(world.problems.size(), 2u);
  const Surface surface = build_surface(world);
  EXPECT_EQ(surface.polygons.size(), 12u);
  EXPECT_DOUBLE_EQ(test::volume_of(surface), 2.0);
}

TEST(Shapes, FarFromTheOriginAndLarge) {
  const Vec3 far(1e6 + 0.5, -2e6, 3e6);
  const Made made(metres()
                      .add(box(far, far + Vec3(10, 10, 10)))
                      .subtract(box(far + Vec3(2, 2, -1), far + Vec3(4, 4, 11))));
  EXPECT_NEAR(made.volume(), 1000.0 - 40.0, 1e-6);
  EXPECT_EQ(made.euler_characteristic(), 0);
  const double huge = 16777216.0;
  const Made whole(
      metres().add(box({-huge, -huge, -huge}, {huge, huge, huge})).subtract(box({-1, -1, -1}, {1, 1, 1})));
  EXPECT_EQ(whole.polygons(), 12u);
}

TEST(Shapes, TrianglesCoverEachPolygonOnce) {
  const Made made(metres()
                      .add(box({0, 0, 0}, {9, 9, 9}))
                      .subtract(box({-1, 3, 3}, {10, 6, 6}), 1)
                      .subtract(box({3, -1, 1}, {6, 10, 5}), 2));
  for (const SurfacePolygon& polygon : made.surface.polygons) {
    double area = 0.0, sum = 0.0;
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    const auto corner = [&](std::size_t i) -> const Vec3& {
      return made.surface.vertices[polygon.vertices[i % polygon.vertices.size()]];
    };
    for (std::size_t i = 2; i < polygon.vertices.size(); ++i)
      area += (corner(i - 1) - corner(0)).cross(corner(i) - corner(0)).dot(polygon.plane.normal);
    for (const auto& triangle : triangulate(made.surface, polygon)) {
      const Vec3& a = made.surface.vertices[triangle[0]];
      const double twice = (made.surface.vertices[triangle[1]] - a)
                               .cross(made.surface.vertices[triangle[2]] - a)
                               .dot(polygon.plane.normal);
      EXPECT_GT(twice, 0.0);
      sum += twice;
      for (std::size_t k = 0; k < 3; ++k) edges.insert({triangle[k], triangle[(k + 1) % 3]});
    }
    EXPECT_NEAR(sum, area, 1e-12);
    for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
      EXPECT_TRUE(edges.count({polygon.vertices[i], polygon.vertices[(i + 1) % polygon.vertices.size()]}));
    }
  }
}

}  // namespace
}  // namespace hallway::csg
