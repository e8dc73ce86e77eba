// SPDX-License-Identifier: MIT
#include "render/map_layers.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "bsp/point_location.hpp"
#include "map/occupants.hpp"
#include "map/reader.hpp"
#include "render/draw.hpp"
#include "render/leaf_pieces.hpp"
#include "support/room_maps.hpp"

namespace hallway::render {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;

const Vec3 kInA(1.0, 1.0, 0.0);  ///< on the floor of room A
const Vec3 kInB(8.0, 1.0, 0.0);  ///< on the floor of room B

/// A map that is compiled, and how a plan shows it.
struct Rooms {
  explicit Rooms(const std::string& text) {
    const map::Document document = map::parse(text, "rooms.map");
    world = map::build_world(document);
    std::vector<Vec3> places;
    for (const map::Occupant& occupant : map::occupants(document)) places.push_back(occupant.position_m);
    compiled = bsp::compile(world, places, {});
    plan = plan_of(compiled);
  }

  std::vector<Surface> surfaces() const { return map_surfaces(world, compiled, plan.faces); }
  std::vector<Surface> surfaces(const LeafColour& colour) const {
    return map_surfaces(world, compiled, plan.faces, colour);
  }
  std::vector<bool> clusters_of(const Vec3& place) const {
    std::vector<bool> seen(compiled.tree.clusters, false);
    seen.at(static_cast<std::size_t>(bsp::cluster_at(compiled.tree, place + Vec3(0.0, 0.0, 0.5)))) = true;
    return seen;
  }

  map::World world;
  bsp::Compiled compiled;
  Plan plan;
};

Rgb pixel_at(const Picture& picture, const Plan& plan, const Vec3& place) {
  View view;
  view.cut_z_m = plan.cut_z_m;
  const auto at = picture_camera(picture, view, kWidth, kHeight).project(place);
  EXPECT_TRUE(at);
  return draw(picture, view, kWidth, kHeight)
      .at(static_cast<int>(at->pixel.x()), static_cast<int>(at->pixel.y()));
}

int brightness(Rgb colour) {
  return colour.r + colour.g + colour.b;
}

bool near(Rgb a, Rgb b, int most) {
  return std::abs(a.r - b.r) <= most && std::abs(a.g - b.g) <= most && std::abs(a.b - b.b) <= most;
}

double area_of(const Polygon& polygon) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < polygon.vertices.size(); ++i) {
    sum += (polygon.vertices[i - 1] - polygon.vertices[0]).cross(polygon.vertices[i] - polygon.vertices[0]);
  }
  return 0.5 * sum.norm();
}

TEST(MapLayers, RoomsCutFromSolidShowTheirFloorAndTheCutWall) {
  const Rooms rooms(test::two_rooms());
  ASSERT_TRUE(rooms.compiled.enclosure.sealed);
  Picture picture;
  picture.surfaces = rooms.surfaces();
  EXPECT_TRUE(near(pixel_at(picture, rooms.plan, {5.0, 1.0, 0.0}), palette::kCut, 12));
  EXPECT_GT(brightness(pixel_at(picture, rooms.plan, kInA)), brightness(palette::kCut) + 200);
  EXPECT_GT(brightness(pixel_at(picture, rooms.plan, {5.0, 6.5, 0.0})), brightness(palette::kCut) + 200);
}

TEST(MapLayers, HiddenRoomIsDarkerThanTheSeenOne) {
  const Rooms rooms(test::two_rooms());
  for (const bool from_a : {true, false}) {
    Picture picture;
    const std::vector<bool> seen = rooms.clusters_of(from_a ? kInA : kInB);
    picture.surfaces = rooms.surfaces(sight_colours(rooms.compiled.tree, seen));
    add_sight_legend(picture, seen);
    const int a = brightness(pixel_at(picture, rooms.plan, kInA));
    const int b = brightness(pixel_at(picture, rooms.plan, kInB));
    EXPECT_GT(from_a ? a - b : b - a, 150);
    ASSERT_EQ(picture.swatches.size(), 2u);
    EXPECT_NE(picture.swatches[0].label.find(" 1 of "), std::string::npos) << picture.swatches[0].label;
  }
}

TEST(MapLayers, LeakLineRunsOutOfTheHull) {
  const Rooms rooms(test::two_rooms(test::hole()));
  ASSERT_TRUE(rooms.compiled.enclosure.leak);
  const bsp::Leak& leak = *rooms.compiled.enclosure.leak;
  Picture picture;
  picture.surfaces = rooms.surfaces();
  const Vec3 end = leak.way.back();
  const Vec3 before = leak.way[leak.way.size() - 2];
  ASSERT_LE(end.x(), -1.0 + 1e-9);
  // Labels have rims that would cover the line's end, so look beside them.
  add_leak(picture, leak, "robot");
  picture.labels.clear();
  EXPECT_EQ(pixel_at(picture, rooms.plan, end), palette::kError);
  EXPECT_EQ(pixel_at(picture, rooms.plan, before + 0.9 * (end - before)), palette::kError);
  EXPECT_NE(pixel_at(picture, rooms.plan, kInB), palette::kError);
  const auto opening = std::find_if(
      picture.markers.begin(), picture.markers.end(),
      [](const Markers& markers) { return markers.label.find("0.50 m × 2.00 m") != std::string::npos; });
  EXPECT_NE(opening, picture.markers.end());
}

TEST(MapLayers, PortalsTintWhereTheyStand) {
  const Rooms rooms(test::two_rooms());
  Picture with;
  with.surfaces = rooms.surfaces();
  const Picture without = with;
  add_portals(with, rooms.compiled.portals);
  ASSERT_EQ(with.patches.size(), 1u);
  const Vec3 door(2.0, 3.0, 0.0);  // where room A meets the passage
  const Rgb tinted = pixel_at(with, rooms.plan, door);
  const Rgb plain = pixel_at(without, rooms.plan, door);
  EXPECT_GT(plain.r - tinted.r, 60);
  EXPECT_LT(tinted.r, tinted.b);
  EXPECT_EQ(pixel_at(with, rooms.plan, {5.0, 1.0, 0.0}), pixel_at(without, rooms.plan, {5.0, 1.0, 0.0}));
}

TEST(MapLayers, WireframeHasEveryEdgeOnceAndNoFace) {
  const Rooms rooms(test::two_rooms());
  Picture picture;
  add_wireframe(picture, rooms.compiled.surface, rooms.compiled.inside, Faces::kInside);
  ASSERT_EQ(picture.segments.size(), 1u);
  const auto& pairs = picture.segments[0].pairs;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (std::size_t k = i + 1; k < pairs.size(); ++k) {
      EXPECT_FALSE(pairs[i] == pairs[k] || (pairs[i][0] == pairs[k][1] && pairs[i][1] == pairs[k][0]));
    }
    for (const Vec3& end : pairs[i]) EXPECT_GE(end.x(), -1e-9);  // the shell begins at -1
  }
  EXPECT_LT(brightness(pixel_at(picture, {}, {0.0, 1.0, 0.0})), brightness(palette::kPaper) - 100);
  EXPECT_GT(brightness(pixel_at(picture, {}, {5.0, 1.03, 0.0})), brightness(palette::kPaper) - 60);
}

TEST(MapLayers, DepthColoursTellDepthsApart) {
  const Rooms rooms(test::two_rooms());
  const bsp::Tree& tree = rooms.compiled.tree;
  const std::vector<std::uint32_t> depths = leaf_depths(tree);
  const LeafColour colour = depth_colours(tree);
  for (std::uint32_t a = 0; a < depths.size(); ++a) {
    for (std::uint32_t b = 0; b < depths.size(); ++b) {
      const bool empty =
          tree.leaves[a].content == bsp::Content::kEmpty && tree.leaves[b].content == bsp::Content::kEmpty;
      if (!empty) continue;
      EXPECT_EQ(colour(a, {}) == colour(b, {}), depths[a] == depths[b]);
    }
  }
  Picture picture;
  add_depth_legend(picture, tree);
  EXPECT_FALSE(picture.scale.colours.empty());
  EXPECT_NE(picture.scale.label.find(" to "), std::string::npos);
}

TEST(MapLayers, DepthIsTheNumberOfNodesOnTheWayDown) {
  const Rooms rooms(test::two_rooms());
  const bsp::Tree& tree = rooms.compiled.tree;
  const std::vector<std::uint32_t> depths = leaf_depths(tree);
  for (const Vec3& place : {Vec3(1, 1, 1), Vec3(8, 1, 1), Vec3(2, 5, 1), Vec3(5, 6.5, 1), Vec3(5, 1, 1)}) {
    std::uint32_t depth = 0;
    bsp::Child child = tree.root;
    while (!child.is_leaf()) {
      child = tree.nodes[child.index()].child[tree.distance(child, place) >= 0.0 ? 0 : 1];
      ++depth;
    }
    EXPECT_EQ(depths[child.index()], depth);
  }
}

TEST(MapLayers, PiecesCoverTheFaceAndEachBoundsItsLeaf) {
  const Rooms rooms(test::two_rooms());
  const csg::Surface& surface = rooms.compiled.surface;
  for (const csg::SurfacePolygon& polygon : surface.polygons) {
    Polygon face{{}, polygon.plane};
    for (const std::uint32_t vertex : polygon.vertices) face.vertices.push_back(surface.vertices[vertex]);
    double sum = 0.0;
    for (const LeafPiece& piece : leaf_pieces(rooms.compiled.tree, face)) {
      sum += area_of(piece.polygon);
      Vec3 middle = Vec3::Zero();
      for (const Vec3& corner : piece.polygon.vertices) {
        middle += corner / static_cast<double>(piece.polygon.vertices.size());
      }
      EXPECT_EQ(bsp::leaf_at(rooms.compiled.tree, middle + 1e-3 * polygon.plane.normal), piece.leaf);
    }
    EXPECT_NEAR(sum, area_of(face), 1e-9 * (1.0 + area_of(face)));
  }
}

TEST(MapLayers, MeasuresAreMillimetresWhereTheyAreSmall) {
  EXPECT_EQ(measure_text(12.345), "12.35 m");
  EXPECT_EQ(measure_text(0.1), "0.10 m");
  EXPECT_EQ(measure_text(0.0123), "12.3 mm");
  EXPECT_EQ(measure_text(0.001), "1.0 mm");
}

}  // namespace
}  // namespace hallway::render
