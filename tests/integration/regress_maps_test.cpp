// SPDX-License-Identifier: MIT
// Asks every map of maps/regress what is solid, closed, seen and reported.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "bsp/compile.hpp"
#include "bsp/point_location.hpp"
#include "map/check.hpp"
#include "map/occupants.hpp"
#include "map/reader.hpp"
#include "pvs/compute.hpp"
#include "support/brushes.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/python.hpp"

namespace hallway {
namespace {

std::filesystem::path folder() {
  return test::source_folder() / "maps" / "regress";
}

/// A map, compiled; its places are asked for in map units.
class Asked {
 public:
  explicit Asked(const std::string& name)
      : document_(map::load(folder() / (name + ".map"))), world_(map::build_world(document_)) {
    std::vector<Vec3> places;
    for (const map::Occupant& occupant : map::occupants(document_)) {
      occupants_.push_back(occupant);
      places.push_back(occupant.position_m);
    }
    compiled_ = bsp::compile(world_, places, {});
    visible_ = pvs::compute(compiled_.portals, {});
  }

  /// Inside a brush that counts.
  void solid(const Vec3& at) const {
    EXPECT_TRUE(test::brushes_solid(world_, metres(at))) << at.transpose();
    EXPECT_EQ(leaf_at(at).content, bsp::Content::kSolid) << at.transpose();
  }
  /// Where robots drive.
  void empty(const Vec3& at) const {
    EXPECT_FALSE(test::brushes_solid(world_, metres(at))) << at.transpose();
    EXPECT_EQ(leaf_at(at).content, bsp::Content::kEmpty) << at.transpose();
  }
  /// In no brush, but beyond the walls of a sealed world.
  void beyond(const Vec3& at) const {
    EXPECT_FALSE(test::brushes_solid(world_, metres(at))) << at.transpose();
    EXPECT_EQ(leaf_at(at).content, bsp::Content::kSolid) << at.transpose();
  }
  void sealed() const {
    EXPECT_TRUE(compiled_.enclosure.sealed);
    EXPECT_TRUE(compiled_.enclosure.leaking.empty());
    EXPECT_FALSE(compiled_.enclosure.leak.has_value());
  }
  /// That occupant has a way out through empty space.
  void leaks(const std::string& occupant) const {
    EXPECT_FALSE(compiled_.enclosure.sealed);
    ASSERT_TRUE(compiled_.enclosure.leak.has_value());
    const bsp::Leak& leak = *compiled_.enclosure.leak;
    EXPECT_EQ(occupants_[leak.occupant].classname, occupant);
    EXPECT_EQ(leak.way.front(), occupants_[leak.occupant].position_m);
    EXPECT_FALSE(world_.bounds.contains(leak.way.back()));
    for (std::size_t i = 0; i + 1 < leak.way.size(); ++i) {
      for (int k = 0; k <= 1000; ++k) {
        const Vec3 at = leak.way[i] + 0.001 * k * (leak.way[i + 1] - leak.way[i]);
        EXPECT_FALSE(test::brushes_solid(world_, at, test::Counting::kStructure) &&
                     !test::near_a_face(world_, at, 1e-6))
            << "the way out runs through solid at " << at.transpose();
      }
    }
  }
  /// The same, through an opening of this size.
  void leaks(const std::string& occupant, double width_cm, double height_cm) const {
    leaks(occupant);
    if (!compiled_.enclosure.leak) return;
    const bsp::Opening& opening = compiled_.enclosure.leak->narrowest;
    EXPECT_NEAR(100.0 * opening.width_m / width_cm, 1.0, 0.01);
    EXPECT_NEAR(100.0 * opening.height_m / height_cm, 1.0, 0.01);
  }
  void clusters(std::uint32_t count) const { EXPECT_EQ(compiled_.tree.clusters, count); }
  void clusters_at_least(std::uint32_t count) const { EXPECT_GE(compiled_.tree.clusters, count); }
  void polygons(std::size_t count) const {
    EXPECT_EQ(static_cast<std::size_t>(std::count_if(compiled_.surface.polygons.begin(),
                                                     compiled_.surface.polygons.end(),
                                                     [](const auto& p) { return !p.vertices.empty(); })),
              count);
  }
  /// The polygon around a point of a face is of this material; "" for no polygon. Gives its number of vertices.
  std::size_t owner(const Vec3& at, const std::string& material) const {
    std::string found;
    std::size_t vertices = 0;
    for (const csg::SurfacePolygon& polygon : compiled_.surface.polygons) {
      if (!holds(polygon, metres(at))) continue;
      EXPECT_EQ(found, "") << "two polygons at " << at.transpose();
      found = world_.solids[polygon.solid].faces[polygon.face].material;
      vertices = polygon.vertices.size();
    }
    EXPECT_EQ(found, material) << at.transpose();
    return vertices;
  }
  void volume_m3(double wanted) const {
    double sum = 0.0;
    for (const csg::SurfacePolygon& polygon : compiled_.surface.polygons) {
      for (const auto& corners : csg::triangulate(compiled_.surface, polygon)) {
        const auto& v = compiled_.surface.vertices;
        sum += v[corners[0]].dot(v[corners[1]].cross(v[corners[2]])) / 6.0;
      }
    }
    EXPECT_NEAR(sum / wanted, 1.0, 1e-9);
  }
  void no_problems() const { EXPECT_TRUE(world_.problems.empty()) << world_.problems.front().message; }
  /// One brush is left out, for this line and cause.
  void problem(int line, const std::string& cause) const {
    ASSERT_EQ(world_.problems.size(), 1u);
    EXPECT_EQ(world_.problems[0].line, line);
    EXPECT_NE(world_.problems[0].message.find(cause), std::string::npos) << world_.problems[0].message;
    EXPECT_TRUE(finds("bad-brush"));
  }
  void left_out(map::LeftOut reason) const {
    ASSERT_EQ(world_.left_out.size(), 1u);
    EXPECT_EQ(world_.left_out[0].reason, reason);
    EXPECT_EQ(world_.left_out[0].brushes, 1u);
  }
  bool finds(const std::string& id) const {
    const auto findings = map::check(document_);
    return std::any_of(findings.begin(), findings.end(),
                       [&](const auto& finding) { return finding.id == id; });
  }
  void finds_nothing() const {
    for (const map::Finding& finding : map::check(document_))
      ADD_FAILURE() << finding.id << ": " << finding.message;
  }
  void one_in_solid() const {
    EXPECT_EQ(compiled_.enclosure.in_solid, (std::vector<std::size_t>{0}));
    EXPECT_FALSE(compiled_.enclosure.sealed);
  }
  /// The straight line is free, and the visible sets do not deny it.
  void sees(const Vec3& from, const Vec3& to) const {
    for (int k = 0; k <= 10000; ++k) {
      EXPECT_FALSE(test::brushes_solid(world_, metres(from + 0.0001 * k * (to - from))))
          << "the question is wrong";
    }
    EXPECT_TRUE(may_see(from, to)) << from.transpose() << " -> " << to.transpose();
  }
  bool may_see(const Vec3& from, const Vec3& to) const {
    const std::int32_t a = leaf_at(from).cluster, b = leaf_at(to).cluster;
    EXPECT_TRUE(a >= 0 && b >= 0) << "the question is wrong";
    if (a < 0 || b < 0) return false;
    return visible_.visible(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
  }
  std::int32_t cluster(const Vec3& at) const { return leaf_at(at).cluster; }
  const map::World& world() const { return world_; }

 private:
  Vec3 metres(const Vec3& at) const { return at * world_.metres_per_unit; }
  const bsp::Leaf& leaf_at(const Vec3& at) const {
    return compiled_.tree.leaves[bsp::leaf_at(compiled_.tree, metres(at))];
  }
  bool holds(const csg::SurfacePolygon& polygon, const Vec3& point) const {
    if (polygon.vertices.empty() || std::abs(polygon.plane.distance(point)) > 1e-7) return false;
    for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
      const Vec3& a = compiled_.surface.vertices[polygon.vertices[i]];
      const Vec3& b = compiled_.surface.vertices[polygon.vertices[(i + 1) % polygon.vertices.size()]];
      if ((b - a).cross(point - a).dot(polygon.plane.normal) < 0.0) return false;
    }
    return true;
  }

  map::Document document_;
  map::World world_;
  std::vector<map::Occupant> occupants_;
  bsp::Compiled compiled_;
  pvs::VisibleSets visible_;
};

/// The usual room, closed, its middle free.
void closed_room(const Asked& map) {
  map.sealed();
  map.empty({200, 150, 80});
  map.empty({1, 1, 1});
  map.solid({-8, 150, 80});
  map.solid({408, 150, 80});
  map.beyond({450, 150, 80});
}

void closed_room_without_a_brush_in_it(const Asked& map) {
  closed_room(map);
  map.empty({150, 150, 60});
  map.clusters(1);
}

/// A map's name and what it is asked.
struct Row {
  const char* name;
  std::function<void(const Asked&)> ask;
};

const std::vector<Row>& rows() {
  static const std::vector<Row> kRows{
      {"leak_missing_wall",
       [](const Asked& map) {
         map.leaks("hw_robot_start", 250, 300);
         map.empty({500, 150, 80});
       }},
      {"leak_gap_1mm", [](const Asked& map) { map.leaks("hw_robot_start", 0.1, 250); }},
      {"leak_diagonal_corner",
       [](const Asked& map) { map.leaks("hw_robot_start", std::hypot(0.1, 0.1), 250); }},
      {"leak_open_door", [](const Asked& map) { map.leaks("hw_robot_start", 90, 200); }},
      {"leak_ceiling_hole", [](const Asked& map) { map.leaks("hw_robot_start", 40, 60); }},
      {"leak_pinhole", [](const Asked& map) { map.leaks("hw_robot_start", 0.1, 0.1); }},
      {"leak_under_a_door", [](const Asked& map) { map.leaks("hw_robot_start", 0.5, 90); }},
      {"leak_behind_detail",
       [](const Asked& map) {
         map.leaks("hw_robot_start", 250, 300);
         map.solid({408, 150, 80});
       }},
      {"leak_subtracted_hole", [](const Asked& map) { map.leaks("hw_robot_start", 20, 50); }},
      {"leak_func_door",
       [](const Asked& map) {
         map.leaks("hw_robot_start", 90, 200);
         map.left_out(map::LeftOut::kMoving);
       }},
      {"leak_light_outside",
       [](const Asked& map) {
         map.leaks("light");
         map.solid({408, 150, 80});
         map.empty({450, 150, 80});  // an open world is divided whole
         map.empty({200, 150, 80});
       }},
      {"leak_one_room_of_two", [](const Asked& map) { map.leaks("light", 90, 200); }},
      {"sealed_room",
       [](const Asked& map) {
         closed_room_without_a_brush_in_it(map);
         map.finds_nothing();
         map.volume_m3(4.32 * 3.32 * 2.82 - 4.0 * 3.0 * 2.5);
         EXPECT_EQ(map.owner({200, 150, 0}, "floor"), 4u);
         map.owner({400, 150, 80}, "east");
       }},
      {"sealed_touching_edges", closed_room_without_a_brush_in_it},
      {"sealed_crack_tenth_mm",
       [](const Asked& map) {
         map.sealed();
         map.empty({200, 150, 80});
         map.solid({408, 149.9, 80});
         map.solid({408, 150.1, 80});
         map.beyond({450, 100, 80});
       }},
      {"sealed_by_sky",
       [](const Asked& map) {
         closed_room_without_a_brush_in_it(map);
         map.owner({200, 150, 250}, "sky1");
       }},
      {"sealed_empty_room_open",
       [](const Asked& map) {
         map.sealed();
         map.empty({100, 150, 80});
         map.beyond({300, 150, 80});
       }},
      {"sealed_by_func_group", closed_room_without_a_brush_in_it},
      {"coplanar_later_owns",
       [](const Asked& map) {
         map.owner({50, 50, 50}, "first");
         map.owner({150, 50, 50}, "second");
         map.owner({250, 50, 50}, "second");
         map.owner({150, 50, 0}, "second");
         map.owner({100, 50, 25}, "");
         map.polygons(10);
         map.volume_m3(3.0 * 1.0 * 0.5);
       }},
      {"coplanar_same_material",
       [](const Asked& map) {
         map.owner({100, 50, 25}, "");
         map.volume_m3(1.0);
         map.polygons(10);
       }},
      {"duplicate_brush",
       [](const Asked& map) {
         map.polygons(6);
         map.owner({50, 50, 100}, "second");
         map.volume_m3(1.0);
       }},
      {"overlapping_brushes",
       [](const Asked& map) {
         map.volume_m3(3.0 * 1.0 * 1.0 + 2.0 * 1.0 * 0.6);
         map.owner({150, 150, 100}, "along");
         map.owner({150, 250, 80}, "across");
         map.owner({150, 150, 80}, "");
       }},
      {"brush_inside_brush",
       [](const Asked& map) {
         map.polygons(6);
         map.owner({45, 45, 60}, "");
         map.solid({45, 45, 45});
       }},
      {"touching_corner",
       [](const Asked& map) {
         map.polygons(12);
         map.volume_m3(0.25);
         map.empty({25, 75, 25});
       }},
      {"touching_edge",
       [](const Asked& map) {
         map.polygons(12);
         map.volume_m3(0.25);
         map.empty({75, 25, 25});
       }},
      {"subtract_through",
       [](const Asked& map) {
         map.volume_m3(0.729 - 0.081);
         map.empty({45, 45, 45});
         map.solid({45, 45, 15});
         map.owner({45, 45, 30}, "bore");
         map.owner({0, 45, 15}, "rock");
         map.owner({0, 45, 45}, "");
       }},
      {"subtract_crossing",
       [](const Asked& map) {
         map.volume_m3(0.729 - 3 * 0.081 + 2 * 0.027);
         map.owner({45, 45, 30}, "");
         map.owner({45, 15, 30}, "bore");
       }},
      {"subtract_order",
       [](const Asked& map) {
         map.solid({70, 70, 150});
         map.empty({30, 30, 60});
         map.solid({30, 30, 25});
         map.owner({70, 70, 200}, "late");
         map.owner({30, 30, 50}, "cut");
         map.volume_m3(0.5 + 0.2 * 0.2 * 1.5);
       }},
      {"subtract_ties",
       [](const Asked& map) {
         map.empty({25, 25, 25});
         map.solid({75, 25, 25});
         map.volume_m3(0.3 * 0.5 * 0.5);
         EXPECT_TRUE(map.finds("tied-order"));
       }},
      {"subtract_misses",
       [](const Asked& map) {
         map.polygons(6);
         map.owner({50, 25, 25}, "cut");
         map.owner({0, 25, 25}, "rock");
         map.solid({25, 25, 25});
         map.volume_m3(0.125);
       }},
      {"nested_rooms",
       [](const Asked& map) {
         map.sealed();
         map.empty({0, 0, 0});
         map.solid({120, 0, 0});
         map.empty({200, 0, 0});  // closed too, though nobody stands there
         map.solid({270, 0, 0});
         map.beyond({320, 0, 0});
         map.volume_m3(216.0 - 125.0 + 27.0 - 8.0);
         map.polygons(24);
         EXPECT_FALSE(map.may_see({0, 0, 0}, {200, 0, 0}));
       }},
      {"room_in_a_block",
       [](const Asked& map) {
         closed_room_without_a_brush_in_it(map);
         map.owner({200, 150, 0}, "plaster");
         map.owner({200, 150, 266}, "rock");
       }},
      {"t_junction_floor",
       [](const Asked& map) {
         EXPECT_EQ(map.owner({200, 50, 0}, "large"), 7u) << "three corners of the tiles lie on its edge";
         EXPECT_EQ(map.owner({50, 125, 0}, "small"), 4u);
         map.owner({150, 100, -5}, "");
       }},
      {"sliver_1e6",
       [](const Asked& map) {
         map.problem(18, "leave no room between them");
         map.solid({250, 50, 0.0005});
         map.empty({250, 50, 0.0015});
         map.owner({250, 50, 0.001}, "foil");
         map.owner({50, 50, 50}, "left");
       }},
      {"slanted_columns",
       [](const Asked& map) {
         map.sealed();
         map.no_problems();
         map.solid({100, 60, 15});
         map.empty({100, 60, 65});
         map.sees({50, 50, 120}, {350, 250, 120});
         map.sees({200, 150, 120}, {390, 10, 20});
       }},
      {"thin_wall_1mm",
       [](const Asked& map) {
         map.sealed();
         map.solid({200.05, 150, 80});
         map.empty({199.95, 150, 80});
         map.empty({200.15, 150, 80});
         map.clusters(2);
         EXPECT_FALSE(map.may_see({100, 150, 80}, {300, 150, 80}));
       }},
      {"stairs",
       [](const Asked& map) {
         map.sealed();
         for (int step = 0; step < 10; ++step) {
           map.solid({100.0 + 20.0 * step + 10.0, 150, 15.0 * step + 14.0});
           map.empty({100.0 + 20.0 * step + 10.0, 150, 15.0 * step + 16.0});
           map.owner({100.0 + 20.0 * step + 7.0, 141, 15.0 * step + 15.0}, "step");
         }
         map.sees({50, 150, 200}, {390, 150, 160});
       }},
      {"arch",
       [](const Asked& map) {
         map.sealed();
         map.no_problems();
         map.empty({200, 150, 98});
         map.solid({200, 150, 101});
         map.empty({200, 51.5, 5});
         map.solid({200, 55, 60});
         map.empty({200, 75, 60});
         map.sees({100, 150, 80}, {300, 150, 80});
         map.sees({10, 150, 90}, {390, 150, 90});
         map.solid({200, 20, 20});
       }},
      {"doorway",
       [](const Asked& map) {
         map.sealed();
         map.no_problems();
         map.empty({200, 150, 100});
         map.solid({200, 150, 210});
         map.solid({200, 100, 100});
         map.clusters_at_least(3);
         map.sees({100, 150, 80}, {300, 150, 80});
         map.sees({10, 10, 10}, {360, 250, 10});
         EXPECT_NE(map.cluster({100, 150, 80}), map.cluster({300, 150, 80}));
       }},
      {"cylinder_362_sides",
       [](const Asked& map) {
         map.no_problems();
         map.polygons(364);
         map.solid({149.9, 0, 100});
         map.empty({150.1, 0, 100});
         map.solid({0, -149.9, 1});
         map.owner({0, 0, 200}, "column");
       }},
      {"pyramid",
       [](const Asked& map) {
         map.no_problems();
         map.polygons(5);
         map.volume_m3(0.8 / 3.0);
         map.solid({50, 50, 79});
         map.empty({10, 10, 20});
       }},
      {"rotated_room",
       [](const Asked& map) {
         map.sealed();
         map.empty({0, 0, 80});
         map.solid({0.8 * 208, 0.6 * 208, 80});
         map.empty({0.8 * 190, 0.6 * 190, 80});
         map.sees({-150, -30, 10}, {150, 30, 240});
       }},
      {"decimal_coordinates",
       [](const Asked& map) {
         map.sealed();
         map.clusters(1);
         map.volume_m3(4.324 * 3.324 * 2.826 - 4.002 * 3.002 * 2.504);
         map.empty({0.1001, 150, 80});
         map.solid({0.0999, 150, 80});
       }},
      {"far_from_origin",
       [](const Asked& map) {
         map.sealed();
         map.clusters(1);
         map.empty({1000200, -999850, 1000080});
         map.solid({1000408, -999850, 1000080});
       }},
      {"huge_coordinates",
       [](const Asked& map) {
         map.no_problems();
         map.sealed();
         map.clusters(1);
         map.empty({16776215, 0, 0});
         map.solid({16776217, 0, 0});
         map.polygons(6 + 2 * 5 + 2 * 3 + 2);
       }},
      {"bad_brush_left_out",
       [](const Asked& map) {
         map.problem(56, "not closed");
         closed_room_without_a_brush_in_it(map);
       }},
      {"inverted_brush",
       [](const Asked& map) {
         map.problem(56, "inside out");
         closed_room_without_a_brush_in_it(map);
       }},
      {"parallel_planes",
       [](const Asked& map) {
         map.problem(58, "lines 57 and 58 are parallel and leave no room between them (-50 units)");
         closed_room_without_a_brush_in_it(map);
       }},
      {"duplicate_plane",
       [](const Asked& map) {
         ASSERT_EQ(map.world().problems.size(), 1u);
         EXPECT_EQ(map.world().problems[0].line, 58);
         EXPECT_NE(map.world().problems[0].message.find("lines 57 and 58 lie on the same plane"),
                   std::string::npos);
         map.sealed();
         map.solid({150, 150, 50});
         map.owner({150, 151, 100}, "twice");
       }},
      {"collinear_points",
       [](const Asked& map) {
         map.problem(57, "lie on one line");
         closed_room_without_a_brush_in_it(map);
       }},
      {"beyond_coordinates",
       [](const Asked& map) {
         map.problem(57, "lies beyond 16777216 units");
         closed_room_without_a_brush_in_it(map);
       }},
      {"redundant_plane",
       [](const Asked& map) {
         map.no_problems();
         map.polygons(6);
         map.volume_m3(1.0);
       }},
      {"standard_format", closed_room_without_a_brush_in_it},
      {"mixed_formats", closed_room_without_a_brush_in_it},
      {"crlf_bom", closed_room_without_a_brush_in_it},
      {"empty",
       [](const Asked& map) {
         map.polygons(0);
         map.clusters(1);
         map.empty({0, 0, 0});
         EXPECT_TRUE(map.finds("no-worldspawn"));
       }},
      {"no_worldspawn",
       [](const Asked& map) {
         map.volume_m3(8.0);
         map.solid({32, 32, 32});
         EXPECT_TRUE(map.finds("no-worldspawn"));
       }},
      {"no_brushes",
       [](const Asked& map) {
         map.polygons(0);
         map.empty({200, 150, 80});
       }},
      {"liquid",
       [](const Asked& map) {
         map.left_out(map::LeftOut::kLiquid);
         closed_room_without_a_brush_in_it(map);
       }},
      {"clip",
       [](const Asked& map) {
         map.left_out(map::LeftOut::kClip);
         closed_room_without_a_brush_in_it(map);
       }},
      {"trigger",
       [](const Asked& map) {
         map.left_out(map::LeftOut::kTrigger);
         closed_room_without_a_brush_in_it(map);
       }},
      {"skip_faces",
       [](const Asked& map) {
         closed_room_without_a_brush_in_it(map);
         map.owner({400, 150, 80}, "skip");
         for (const map::SolidFace& face : map.world().solids.back().faces) EXPECT_FALSE(face.drawn);
         for (const map::SolidFace& face : map.world().solids.front().faces) EXPECT_TRUE(face.drawn);
       }},
      {"func_detail",
       [](const Asked& map) {
         closed_room(map);
         map.solid({125, 125, 50});
         map.clusters(1);
       }},
      {"detail_pillar",
       [](const Asked& map) {
         map.sealed();
         map.solid({200, 150, 80});
         map.clusters(1);
         map.owner({180, 150, 80}, "pillar");
         EXPECT_TRUE(map.may_see({100, 150, 80}, {300, 150, 80})) << "detail hides nothing";
       }},
      {"structure_pillar",
       [](const Asked& map) {
         map.sealed();
         map.solid({200, 150, 80});
         map.clusters_at_least(2);
         map.sees({100, 250, 80}, {300, 250, 80});
         map.sees({100, 50, 80}, {100, 250, 80});
       }},
      {"hint_split",
       [](const Asked& map) {
         closed_room(map);
         map.clusters(2);
         map.owner({200, 150, 80}, "");
         EXPECT_NE(map.cluster({100, 150, 80}), map.cluster({300, 150, 80}));
         map.sees({10, 10, 10}, {390, 290, 240});
       }},
      {"tb_layers_reordered", closed_room_without_a_brush_in_it},
      {"two_rooms_one_window",
       [](const Asked& map) {
         map.sealed();
         map.solid({200, 100, 80});
         map.empty({200, 150, 120});
         map.sees({100, 150, 120}, {300, 150, 120});
         map.sees({10, 150, 20}, {390, 150, 220});
         EXPECT_NE(map.cluster({100, 150, 80}), map.cluster({300, 150, 80}));
       }},
      {"dead_straight_corridor",
       [](const Asked& map) {
         map.sealed();
         map.sees({1, 0, 80}, {9999, 0, 80});
         map.sees({1, -99, 1}, {9999, 99, 249});
         map.sees({500, 500, 80}, {500, -99, 80});
         EXPECT_FALSE(map.may_see({350, 500, 80}, {9650, 500, 80})) << "the first and the last room";
       }},
      {"labyrinth_corner",
       [](const Asked& map) {
         map.sealed();
         map.sees({50, 50, 80}, {990, 50, 80});
         map.sees({950, 10, 80}, {950, 590, 80});
         map.sees({10, 550, 80}, {990, 550, 80});
         map.sees({50, 510, 80}, {50, 990, 80});
         EXPECT_FALSE(map.may_see({50, 50, 80}, {50, 950, 80}));
       }},
      {"start_in_solid",
       [](const Asked& map) {
         map.one_in_solid();
         map.empty({200, 150, 80});
       }},
      {"start_on_the_floor", closed_room_without_a_brush_in_it},
      {"two_robot_starts",
       [](const Asked& map) {
         closed_room_without_a_brush_in_it(map);
         EXPECT_TRUE(map.finds("two-robot-starts"));
       }},
  };
  return kRows;
}

class RegressMap : public testing::TestWithParam<Row> {};
INSTANTIATE_TEST_SUITE_P(Maps, RegressMap, testing::ValuesIn(rows()),
                         [](const auto& row) { return std::string(row.param.name); });

TEST_P(RegressMap, IsWhatItIsFor) {
  const Asked map(GetParam().name);
  GetParam().ask(map);
}

/// Maps that are refused as a whole: name, line, cause.
struct Refused {
  const char* name;
  int line;
  const char* cause;
};

constexpr std::array kRefused{Refused{"cut_short", 20, "brush"},
                              Refused{"start_without_origin", 57, "`origin` is missing"}};

TEST(RegressMaps, SomeAreRefusedWithLineAndCause) {
  for (const Refused& refused : kRefused) {
    const auto error = test::error_of([&] { Asked map(refused.name); });
    ASSERT_TRUE(error) << refused.name;
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
    EXPECT_EQ(error->where().line, refused.line) << refused.name;
    EXPECT_NE(std::string(error->what()).find(refused.cause), std::string::npos) << error->what();
  }
}

TEST(RegressMaps, EveryMapIsAskedAndListed) {
  std::set<std::string> asked;
  for (const Row& row : rows()) EXPECT_TRUE(asked.insert(row.name).second) << row.name;
  for (const Refused& refused : kRefused) asked.insert(refused.name);
  const std::string readme = read_file(folder() / "README.md");
  std::set<std::string> there;
  for (const auto& entry : std::filesystem::directory_iterator(folder())) {
    if (entry.path().extension() != ".map") continue;
    there.insert(entry.path().stem());
    EXPECT_NE(readme.find("`" + entry.path().filename().string() + "`"), std::string::npos) << entry.path();
  }
  EXPECT_EQ(there, asked);
  EXPECT_GE(there.size(), 45u);
}

TEST(RegressMaps, AreWhatTheirScriptWrites) {
  EXPECT_EQ(test::run_python("python3", {folder() / "make_regress_maps.py", "--check"}), 0);
}

}  // namespace
}  // namespace hallway
