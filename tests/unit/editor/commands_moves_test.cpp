// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "editor/item_text.hpp"
#include "editor/transform.hpp"
#include "map/check.hpp"
#include "map/path.hpp"
#include "mesh/placement.hpp"
#include "solidity.hpp"
#include "support/brushes.hpp"
#include "support/errors.hpp"
#include "support/long_mode.hpp"
#include "unit/editor/editing.hpp"

namespace hallway {
namespace {

using editor::Edit;
using editor::Id;
using editor::State;
using editor::Thing;
using editor::Transform;
using test::Editing;
using test::mentions;
using test::refusal;

constexpr std::array kAxes{"x", "y", "z"};

const std::string kFurniture =
    "new\n"
    "box from 0,0 to 2,3,1 material=brick\n"
    "wedge from 3,0 to 5,1,0.5\n"
    "wall from 0,5 to 4,5 name=north\n"
    "door in north at 2\n"
    "box from 7,7 to 8,8,1 name=crate\n"
    "prism 10,0;14,0;14,1;11,1;11,3;10,3 height 0.9 name=counter\n"
    "light 1,1,2 name=lamp\n"
    "start 1,4 heading=30\n"
    "path way 0,-1;5,-1;5,-4\n"
    "mesh chair.obj at 3,3 heading=15 name=chair\n"
    "group lamp+crate corner\n";

/// A map with something of everything.
struct Furnished : Editing {
  Furnished() {
    folder.write("chair.obj", "v 0 0 0\n");
    session->run_script(editor::script_lines(kFurniture, folder / "made"), "made");
  }
  map::Document document() const {
    return editor::document_of(session->state(), (folder / "map.map").string());
  }
  const std::string* key(const std::string& name, const char* which) const {
    return test::named(*this, name).head->find(which);
  }
  Box bounds(const std::string& what) const {
    const State& state = session->state();
    Box box;
    for (const Thing& thing : editor::with_members(state, editor::resolve(state, what))) {
      if (const Box part = editor::bounds_of(state, thing); !part.isEmpty()) box.extend(part);
    }
    return box;
  }
};

std::string decimal(std::mt19937_64& random, double reach) {
  std::uniform_real_distribution<double> uniform(-reach, reach);
  return format_double(std::round(uniform(random) * 1000.0) / 1000.0);
}

std::string place(std::mt19937_64& random, double reach = 20.0) {
  const std::string x = decimal(random, reach), y = decimal(random, reach);
  return x + ',' + y + ',' + decimal(random, reach);
}

std::string opposite(const std::string& way) {
  std::string result;
  for (const std::string_view part : split(way, ','))
    result += (result.empty() ? "" : ",") + format_double(-*parse_double(part) + 0.0);
  return result;
}

// ---- Properties -------------------------------------------------------------------------------------------------------

/// Nothing is wrong but that the robot start is not where a path begins, which is so from the beginning.
bool is_sound(const map::Document& document) {
  const auto findings = map::check(document);
  return std::all_of(findings.begin(), findings.end(),
                     [](const map::Finding& finding) { return finding.id == "start-off-path"; });
}

TEST(MovesCommands, ThereAndBackIsTheSameToTheByte) {
  std::mt19937_64 random(1);
  Furnished map;
  const std::string before = map.text();
  ASSERT_TRUE(mentions(before, "_hw_made"));
  for (std::uint64_t i = 0; i < test::sized(10u, 200u); ++i) {
    const std::string way = place(random);
    map.run("move all by " + way);
    EXPECT_NE(map.text(), before);
    map.run("move all by " + opposite(way));
    ASSERT_EQ(map.text(), before) << way;
  }
}

TEST(MovesCommands, FourQuarterTurnsAndAWholeOneAreNone) {
  std::mt19937_64 random(2);
  Furnished map;
  const std::string before = map.text();
  map.run("rotate all by 360 about 3,4");
  EXPECT_EQ(map.text(), before);
  for (std::uint64_t i = 0; i < test::sized(5u, 50u); ++i) {
    const std::string line =
        "rotate all by " + std::string(i % 2 == 0 ? "90" : "-90") + " about " + place(random);
    for (int quarter = 0; quarter < 4; ++quarter) map.run(line);
    ASSERT_EQ(map.text(), before) << line;
  }
  for (const char* axis : kAxes) {  // brushes about every axis
    for (int quarter = 0; quarter < 4; ++quarter)
      map.run("rotate 2+3 by 90 about 1.5,2.25,0.125 axis=" + std::string(axis));
    ASSERT_EQ(map.text(), before) << axis;
  }
}

TEST(MovesCommands, AMirrorTwiceIsNone) {
  std::mt19937_64 random(3);
  Furnished map;
  map.run("delete north+counter");  // a mirrored outline runs the other way round: no line says so
  const std::string before = map.text();
  for (std::uint64_t i = 0; i < test::sized(6u, 60u); ++i) {
    const std::string line = std::string("mirror all ") + kAxes[i % 3] + " at " + decimal(random, 10.0);
    map.run(line);
    EXPECT_NE(map.text(), before);
    map.run(line);
    ASSERT_EQ(map.text(), before) << line;
  }
}

/// Volumes of all brushes, in the order of the file; 0 where one is no body.
std::vector<double> volumes(const State& state) {
  std::vector<double> found;
  for (const auto& entity : state.entities) {
    for (const auto& brush : entity->brushes) found.push_back(editor::volume_of(*brush.brush));
  }
  return found;
}

Edit with_polyhedra(std::mt19937_64& random) {
  test::MapMaker maker;
  for (int i = 0; i < 6; ++i) {
    map::Brush brush = test::random_polyhedron(random, Vec3(100.0 * i, 50.0, -20.0), 40.0);
    for (map::Face& face : brush.faces) {
      face.u_axis = face.u_axis + 0.3 * Vec3::UnitZ();
      face.u_offset = 7.25;
      face.v_scale = 0.5;
    }
    maker.add(std::move(brush));
  }
  Edit edit;
  edit.state = editor::state_of(maker.document());
  return edit;
}

std::vector<Transform> some_transforms(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-100.0, 100.0), angle(0.0, 360.0), factor(0.3, 3.0);
  const auto vector = [&](auto& from) {
    const double x = from(random), y = from(random);
    return Vec3(x, y, from(random));
  };
  std::vector<Transform> all{editor::move_by(vector(uniform)),
                             editor::scale_about(vector(uniform), vector(factor)),
                             editor::scale_about(vector(uniform), Vec3::Constant(factor(random))),
                             editor::change_units(0.01, 0.03125)};
  for (int axis = 0; axis < 3; ++axis) {
    all.push_back(editor::turn_about(vector(uniform), axis, angle(random)));
    all.push_back(editor::turn_about(vector(uniform), axis, 90.0 * axis + 90.0));
    all.push_back(editor::mirror_at(axis, uniform(random)));
  }
  return all;
}

TEST(Transforms, VolumesFollowTheDeterminantAndBodiesStayBodies) {
  std::mt19937_64 random(4);
  for (std::uint64_t round = 0; round < test::sized(10u, 200u); ++round) {
    Edit edit = with_polyhedra(random);
    const auto before = volumes(edit.state);
    for (const Transform& transform : some_transforms(random)) {
      Edit changed = edit;
      editor::transform_things(changed, {{0, {}}}, transform);
      const auto after = volumes(changed.state);
      const double factor = std::abs(transform.linear.determinant());
      for (std::size_t i = 0; i < before.size(); ++i)
        ASSERT_NEAR(after[i], factor * before[i], 1e-7 * factor * before[i]);
    }
  }
}

TEST(Transforms, PointsInsideAreInsideAfterwards) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-60.0, 60.0);
  Edit edit = with_polyhedra(random);
  const map::Brush& brush = *edit.state.entities[0]->brushes[0].brush;
  const auto inside = [](const map::Brush& one, const Vec3& point) {
    return std::all_of(one.faces.begin(), one.faces.end(),
                       [&](const map::Face& face) { return editor::plane_of(face)->distance(point) <= 0.0; });
  };
  int in = 0;
  for (const Transform& transform : some_transforms(random)) {
    const map::Brush after = editor::transformed(brush, transform);
    for (int i = 0; i < 100; ++i) {
      const Vec3 point = Vec3(uniform(random), uniform(random), uniform(random)) + Vec3(0.0, 50.0, -20.0);
      const bool expected = inside(brush, point);
      in += expected;
      EXPECT_EQ(inside(after, transform.linear * point + transform.shift), expected);
    }
  }
  EXPECT_GT(in, 100);
}

/// Where in a texture a point of a face is, pixels.
Vec2 texture_place(const map::Face& face, const Vec3& point) {
  return {point.dot(face.u_axis) / face.u_scale + face.u_offset,
          point.dot(face.v_axis) / face.v_scale + face.v_offset};
}

TEST(Transforms, TexturesStayWhereTheyAreOnTheFaces) {
  std::mt19937_64 random(6);
  Edit edit = with_polyhedra(random);
  for (const Transform& transform : some_transforms(random)) {
    for (const auto& item : edit.state.entities[0]->brushes) {
      const map::Brush after = editor::transformed(*item.brush, transform);
      for (std::size_t f = 0; f < after.faces.size(); ++f) {
        const map::Face& face = item.brush->faces[f];
        for (const Vec3& point : face.points) {
          const Vec3 there = transform.linear * point + transform.shift;
          EXPECT_LT((texture_place(face, point) - texture_place(after.faces[f], there)).norm(), 1e-8);
        }
        EXPECT_NEAR(after.faces[f].u_axis.norm(), face.u_axis.norm(), 1e-9)
            << "scales, not axes, take up a scaling";
      }
    }
  }
}

TEST(Transforms, AFixedTextureMatrixStaysAndIsMentioned) {
  test::MapMaker maker;
  map::Brush brush = test::box({0, 0, 0}, {10, 10, 10});
  for (map::Face& face : brush.faces) face.texture_matrix = {1, 0, 0, 0, 1, 0};
  maker.add(brush);
  Edit edit;
  edit.state = editor::state_of(maker.document());
  editor::transform_things(edit, {{0, 0}}, editor::move_by({5, 0, 0}));
  EXPECT_EQ(edit.report.data["notes"].size(), 1u);
  const map::Brush& moved = *edit.state.entities[0]->brushes[0].brush;
  EXPECT_EQ(moved.faces[0].texture_matrix, brush.faces[0].texture_matrix);
  EXPECT_EQ(moved.faces[0].points[0], Vec3(brush.faces[0].points[0] + Vec3(5, 0, 0)));
}

TEST(Transforms, ShapesKeptAsTextAndPlacesTooFarAreRefused) {
  map::Brush patch;
  patch.unread = "patchDef2 { }";
  EXPECT_TRUE(test::error_of([&] { editor::transformed(patch, editor::move_by({1, 0, 0})); }));
  test::MapMaker maker;
  maker.add(test::box({0, 0, 0}, {10, 10, 10})).add(patch);
  Edit edit;
  edit.state = editor::state_of(maker.document());
  const auto kept = test::error_of([&] {
    editor::transform_things(edit, {{0, {}}}, editor::move_by({1, 0, 0}));
  });
  ASSERT_TRUE(kept);
  EXPECT_TRUE(mentions(kept->what(), "#3 ")) << kept->what();
  const map::Brush box = test::box({0, 0, 0}, {10, 10, 10});
  const auto far = test::error_of([&] { editor::transformed(box, editor::move_by({1e9, 0, 0})); });
  ASSERT_TRUE(far);
  EXPECT_TRUE(mentions(far->what(), "beyond"));
}

// ---- Entities -----------------------------------------------------------------------------------------------------------

/// model_to_world() of the one model of a map, metres.
Eigen::Matrix3d linear_of(const Furnished& map) {
  const auto placements = mesh::placements(map.document());
  EXPECT_EQ(placements.size(), 1u);
  return placements[0].rotation.toRotationMatrix() * placements[0].scale.asDiagonal();
}

/// The linear part of what a line does to a model.
Eigen::Matrix3d meant_by(const std::string& line) {
  const int axis = mentions(line, "axis=x") ? 0 : mentions(line, "axis=y") ? 1 : 2;
  if (mentions(line, "mirror")) return editor::mirror_at(axis, 0.0).linear;
  if (mentions(line, "scale")) return 2.0 * Eigen::Matrix3d::Identity();
  const double angle = mentions(line, "33") ? 33.0 : mentions(line, "-100") ? -100.0 : 90.0;
  return editor::turn_about(Vec3::Zero(), axis, angle).linear;
}

TEST(MovesCommands, ModelsTurnMirrorAndGrow) {
  Furnished map;
  for (const char* first :
       {"grid off", "rotate chair by 25 axis=y", "mirror chair axis=x", "key chair scale=\"1 2 3\""}) {
    map.run(first);
    const Eigen::Matrix3d before = linear_of(map);
    for (const char* line : {"rotate chair by 33", "rotate chair by 33 axis=x", "rotate chair by -100 axis=y",
                             "rotate chair by 90 axis=y", "mirror chair axis=x", "mirror chair axis=y",
                             "mirror chair axis=z", "scale chair by 2"}) {
      map.run(line);
      EXPECT_LT((linear_of(map) - meant_by(line) * before).norm(), 1e-8) << first << ", then " << line;
      map.session->undo(1);
    }
  }
}

TEST(MovesCommands, HeadingsAndPathsFollow) {
  Furnished map;
  map.run("rotate class=hw_robot_start+way by 90 about 0,0");
  const auto at = [&](const char* classname) { return "class=" + std::string(classname); };
  EXPECT_EQ(*map.session->state()
                 .entities[editor::resolve(map.session->state(), at("hw_robot_start"))[0].entity]
                 ->head->find("angle"),
            "120");
  const map::Path path = map::find_path(map.document(), "way");
  EXPECT_LT((path.at(0.0).t - Vec3(1, 0, 0)).norm(), 1e-9);
  const double length = path.length_m();
  map.run("scale way by 2");
  EXPECT_NEAR(map::find_path(map.document(), "way").length_m(), 2.0 * length, 1e-9);
  EXPECT_EQ(*map.key("way", "corner_radius_m"), "1");
  EXPECT_TRUE(mentions(map.run("scale way by 2,1,1").lines[0], "corner_radius_m"));
  map.run("mirror class=hw_robot_start x at 0");
  EXPECT_TRUE(mentions(map.text(), "\"angle\" \"60\""));
  EXPECT_TRUE(mentions(map.run("rotate class=hw_robot_start by 20 axis=x").lines[0], "tilted"));
  EXPECT_TRUE(is_sound(map.document()));
}

TEST(MovesCommands, ALinkedGroupIsLinkedNoLonger) {
  Furnished map;
  map.run_all({"key crate _tb_linked_group_id=abc _tb_transformation=\"1 0 0 0\"", "move crate by 1,0"});
  EXPECT_EQ(map.key("crate", "_tb_linked_group_id"), nullptr);
  EXPECT_EQ(map.key("crate", "_tb_transformation"), nullptr);
}

// ---- What made it -----------------------------------------------------------------------------------------------------

/// What a map looks like, as its brushes' volumes and bounds.
std::string looks(const Editing& map) {
  std::string text;
  const State& state = map.session->state();
  for (std::size_t e = 0; e < state.entities.size(); ++e) {
    for (std::size_t b = 0; b < state.entities[e]->brushes.size(); ++b) {
      const Box box = editor::bounds_of(state, {e, b});
      for (const Vec3& corner : {box.min(), box.max()}) {
        for (const double x : corner) text += std::to_string(std::lround(x * 100.0)) + ' ';
      }
      text += std::to_string(std::lround(editor::volume_of(*state.entities[e]->brushes[b].brush))) + '\n';
    }
  }
  return text;
}

TEST(MovesCommands, TheLineThatMadeAThingMakesItWhereItIsNow) {
  for (const char* line : {"move north+counter by 1.5,-2,0.25", "rotate north+counter by 90 about 1,1",
                           "rotate north+counter by 180", "rotate north+counter by 30 about 1,1"}) {
    SCOPED_TRACE(line);
    Furnished map;
    map.run(line);
    ASSERT_NE(map.key("north", "_hw_made"), nullptr);
    ASSERT_NE(map.key("counter", "_hw_made"), nullptr);
    const std::string before = looks(map);
    map.run_all({"remake north height=2.7", "remake counter height=0.9"});
    EXPECT_EQ(looks(map), before);
  }
}

TEST(MovesCommands, ALineThatNoLongerSaysWhatIsThereGoes) {
  for (const char* line : {"scale north by 2", "rotate north by 20 axis=x",
                           "mirror crate z at 3\nmove crate by 0,0,0.1\nscale crate by 1,2,1"}) {
    Furnished map;
    map.run_all({"grid off"});
    for (const std::string_view one : split(line, '\n')) map.run(std::string(one));
    EXPECT_EQ(map.key(mentions(line, "crate") ? "crate" : "north", "_hw_made"), nullptr) << line;
  }
}

TEST(MovesCommands, AGridDoesNotSpoilWhatALineSays) {
  Furnished map;
  map.run_all({"grid 0.5", "move north by 0.1,0.2,0"});
  ASSERT_NE(map.key("north", "_hw_made"), nullptr);
  EXPECT_EQ(map.bounds("north").min().x(), 10.0);
}

TEST(MovesCommands, AMovedPartTakesTheLineOfTheWholeAway) {
  Furnished map;
  map.run("room from 20,0 to 25,4 name=kitchen");
  ASSERT_NE(map.key("kitchen", "_hw_made"), nullptr);
  const Id cut = map.session->state().entities.back()->id;
  map.run("move " + std::to_string(cut) + " by 0,0,0.1");
  EXPECT_EQ(map.key("kitchen", "_hw_made"), nullptr);
}

// ---- Places, aligning, snapping -----------------------------------------------------------------------------------------

TEST(MovesCommands, MoveToAPlace) {
  Furnished map;
  map.run("move corner to 4,5,6");
  EXPECT_EQ(map.bounds("corner").min(), Vec3(400, 500, 600));
  EXPECT_EQ(editor::origin_of(test::named(map, "lamp")), Vec3(400, 500, 800));
  EXPECT_TRUE(mentions(refusal(map, "move corner"), "`by`"));
  EXPECT_TRUE(mentions(refusal(map, "move corner by 1,1 to 2,2"), "not both"));
  EXPECT_TRUE(mentions(refusal(map, "move cornre by 1,1"), "corner"));
  EXPECT_TRUE(mentions(refusal(map, "move corner by 1"), "by"));
  EXPECT_TRUE(mentions(refusal(map, "move corner by 1000000,0"), "beyond"));
  EXPECT_TRUE(mentions(refusal(map, "move class=worldspawn+lamp by 1000000,0"), "beyond"));
  map.run("entity info_note targetname=note");
  EXPECT_TRUE(mentions(refusal(map, "move note by 1,1"), "no place"));
  map.run("entity light targetname=odd origin=\"1 2\"");
  EXPECT_TRUE(mentions(refusal(map, "move odd+lamp by 1,1"), "three numbers"));
}

TEST(MovesCommands, RotateScaleMirrorRefusals) {
  Furnished map;
  EXPECT_TRUE(mentions(refusal(map, "rotate crate by 3m"), "angle"));
  EXPECT_TRUE(mentions(refusal(map, "rotate crate"), "by"));
  EXPECT_TRUE(mentions(refusal(map, "rotate crate by 3 axis=w"), "axis"));
  EXPECT_TRUE(mentions(refusal(map, "rotate carte by 3"), "crate"));
  EXPECT_TRUE(mentions(refusal(map, "scale crate by 0"), "by"));
  EXPECT_TRUE(mentions(refusal(map, "scale crate by -1,1,1"), "by"));
  EXPECT_TRUE(mentions(refusal(map, "scale carte by 2"), "crate"));
  EXPECT_TRUE(mentions(refusal(map, "mirror crate"), "axis"));
  EXPECT_TRUE(mentions(refusal(map, "mirror carte x"), "crate"));
  map.run("box from 30,0,0 to 31,1,0.00001 name=sheet");
  EXPECT_TRUE(mentions(refusal(map, "scale sheet by 1,1,0.001"), "thin"));
}

TEST(MovesCommands, Align) {
  Furnished map;
  const Box brick = map.bounds("2");
  const std::vector<std::pair<std::string, std::function<double(const Box&)>>> sides{
      {"left", [](const Box& b) { return b.min().x(); }},
      {"right", [](const Box& b) { return b.max().x(); }},
      {"front", [](const Box& b) { return b.min().y(); }},
      {"back", [](const Box& b) { return b.max().y(); }},
      {"bottom", [](const Box& b) { return b.min().z(); }},
      {"top", [](const Box& b) { return b.max().z(); }}};
  for (const auto& [side, of] : sides) {
    map.run("align corner " + side + " to 2");
    EXPECT_NEAR(of(map.bounds("corner")), of(brick), 1e-9) << side;
    map.run("align crate " + side + " to 9,8,7");
    EXPECT_NEAR(of(map.bounds("crate")),
                side == "left" || side == "right"   ? 900.0
                : side == "front" || side == "back" ? 800.0
                                                    : 700.0,
                1e-9);
  }
  map.run("align crate centre to 2");
  EXPECT_LT((map.bounds("crate").center() - brick.center()).head<2>().norm(), 1e-9);
  map.run("align crate+lamp bottom to 2 edge=top");  // each by itself
  EXPECT_EQ(map.bounds("crate").min().z(), 100.0);
  EXPECT_EQ(map.bounds("lamp").min().z(), 100.0);
  EXPECT_TRUE(mentions(refusal(map, "align crate left to 2 edge=top"), "same axis"));
  EXPECT_TRUE(mentions(refusal(map, "align crate centre to 2 edge=top"), "centre"));
  EXPECT_TRUE(mentions(refusal(map, "align crate left to nroth"), "north"));
  EXPECT_TRUE(mentions(refusal(map, "align crate left to 1,x"), "place"));
  EXPECT_TRUE(mentions(refusal(map, "align crate lfet to 2"), "left"));
  EXPECT_TRUE(mentions(refusal(map, "align crtae left to 2"), "crate"));
}

TEST(MovesCommands, SnapPutsBoxesAndOriginsOnTheGrid) {
  Furnished map;
  map.run_all({"box from 40.03,0.02 to 41.13,1.07,0.52 name=odd", "light 3.14,1.59,2.65 name=pi",
               "wedge from 50.02,0 to 51,1,1 name=slope"});
  const std::string slope = editor::text_of(*test::named(map, "slope").brushes.at(0).brush);
  const auto report = map.run("snap odd+pi+slope size=0.25");
  EXPECT_EQ(report.data["left"], 1);
  EXPECT_EQ(map.bounds("odd").min(), Vec3(4000, 0, 0));
  EXPECT_EQ(map.bounds("odd").max(), Vec3(4125, 100, 50));
  EXPECT_EQ(editor::origin_of(test::named(map, "pi")), Vec3(325, 150, 275));
  EXPECT_EQ(editor::text_of(*test::named(map, "slope").brushes.at(0).brush), slope);
  const std::string once = map.text();
  map.run("snap odd+pi+slope size=0.25");
  EXPECT_EQ(map.text(), once);
  EXPECT_TRUE(mentions(refusal(map, "snap odd"), "grid"));
  map.run("grid 5");
  EXPECT_TRUE(mentions(refusal(map, "snap odd"), "thin"));
  EXPECT_TRUE(mentions(refusal(map, "snap slope"), "neither"));
  EXPECT_TRUE(mentions(refusal(map, "snap ood"), "odd"));
  EXPECT_TRUE(mentions(refusal(map, "snap odd size=0"), "size"));
}

// ---- Copies -----------------------------------------------------------------------------------------------------------

TEST(MovesCommands, ArraysInARow) {
  Furnished map;
  const auto report = map.run("array crate linear 5 by 0.5,2,0.1");
  EXPECT_EQ(report.data["made"].size(), 4u);
  const Box first = map.bounds("crate");
  for (int i = 1; i < 5; ++i) {
    const Box copy = map.bounds("crate-" + std::to_string(i + 1));
    EXPECT_LT((copy.min() - first.min() - i * Vec3(50, 200, 10)).norm(), 1e-9);
    EXPECT_LT((copy.sizes() - first.sizes()).norm(), 1e-9);
  }
}

TEST(MovesCommands, ArraysInACircle) {
  Furnished map;
  map.run("light 5,0,2 name=bulb");
  map.run("array bulb circular 8 about 0,0");
  for (int i = 1; i < 8; ++i) {
    const double angle = i * std::numbers::pi / 4.0;
    const auto origin = editor::origin_of(test::named(map, "bulb-" + std::to_string(i + 1)));
    EXPECT_LT((*origin - Vec3(500 * std::cos(angle), 500 * std::sin(angle), 200)).norm(), 1e-9);
  }
  map.run("light 5,0,3 name=spot");
  map.run("array spot circular 3 about 0,0 through=90");
  EXPECT_LT((*editor::origin_of(test::named(map, "spot-3")) - Vec3(0, 500, 300)).norm(), 1e-9);
  EXPECT_TRUE(mentions(refusal(map, "array spot linear 3 about 0,0"), "linear"));
  EXPECT_TRUE(mentions(refusal(map, "array spot linear 3 by 1,0 through=30"), "linear"));
  EXPECT_TRUE(mentions(refusal(map, "array spot circular 3 by 1,0"), "circular"));
  EXPECT_TRUE(mentions(refusal(map, "array spot circular 3"), "about"));
  EXPECT_TRUE(mentions(refusal(map, "array spot linear 1 by 1,0"), "count"));
  EXPECT_TRUE(mentions(refusal(map, "array spto linear 2 by 1,0"), "spot"));
  EXPECT_TRUE(mentions(refusal(map, "array spot row 2 by 1,0"), "linear"));
}

TEST(MovesCommands, DuplicateThenDeleteIsAsBefore) {
  Furnished map;
  const std::string before = map.text();
  for (const char* what : {"2", "2+3", "corner", "north", "way", "all", "counter+lamp+2"}) {
    auto made = map.run("duplicate " + std::string(what) + " by 3,3,3").data["made"];
    std::string ids;
    for (const auto& id : made) ids += (ids.empty() ? "" : "+") + id.dump();
    EXPECT_NE(map.text(), before);
    map.run("delete " + ids);
    EXPECT_EQ(map.text(), before) << what;
  }
}

TEST(MovesCommands, CopiesHaveNamesOfTheirOwnAndMeanEachOther) {
  Furnished map;
  map.run_all({"light 2,2,2 name=switched", "key lamp target=switched",
               "landmarks path=way per_100m=1 sideways=1 height=1"});
  map.run("duplicate corner+switched+way+way_cloud by 0,30");
  EXPECT_EQ(*map.key("lamp-2", "target"), "switched-2");
  EXPECT_EQ(*map.key("lamp", "target"), "switched");
  EXPECT_EQ(*map.key("way_cloud-2", "path"), "way-2");
  EXPECT_EQ(*map.key("crate-2", "_tb_group"), *map.key("corner-2", "_tb_id"));
  EXPECT_NE(*map.key("corner-2", "_tb_id"), *map.key("corner", "_tb_id"));
  EXPECT_LT((map::find_path(map.document(), "way-2").at(0.0).t - Vec3(0, 29, 0)).norm(), 1e-9);
  EXPECT_EQ(map.bounds("corner-2").min(), Vec3(map.bounds("corner").min() + Vec3(0, 3000, 0)));
  map.run("duplicate lamp-2 by 1,0");
  EXPECT_EQ(*map.key("lamp-3", "target"), "switched-2");
  EXPECT_EQ(*map.key("lamp-3", "_tb_group"), *map.key("corner-2", "_tb_id"));
  EXPECT_TRUE(is_sound(map.document()));
}

TEST(MovesCommands, ACopiedWallIsAWallWithItsDoor) {
  Furnished map;
  map.run("duplicate north by 0,2");
  ASSERT_NE(map.key("north-2", "_hw_made"), nullptr);
  EXPECT_TRUE(mentions(map.text(), "in=north-2"));
  const std::string before = looks(map);
  map.run("remake north-2 height=2.7");
  EXPECT_EQ(looks(map), before);
  EXPECT_FALSE(test::is_solid(map, {2, 7, 1}));
  EXPECT_TRUE(test::is_solid(map, {0.5, 7, 1}));
}

TEST(MovesCommands, ACopiedLayerHasANumberOfItsOwn) {
  Furnished map;
  map.run_all(
      {"entity func_group _tb_type=_tb_layer _tb_name=upstairs _tb_id=40", "key crate+lamp _tb_layer=40"});
  map.run("duplicate upstairs+2 by 1,1");
  EXPECT_NE(*map.key("upstairs-2", "_tb_id"), "40");
  map.run("duplicate crate by 1,1");
  EXPECT_EQ(*map.key("crate-2", "_tb_layer"), "40");
}

TEST(MovesCommands, ACopiedWaypointIsTheLastOfItsPath) {
  Furnished map;
  const Id first =
      map.session->state().entities[editor::resolve(map.session->state(), "class=hw_waypoint")[0].entity]->id;
  map.run("duplicate " + std::to_string(first) + " by 2,-6");
  EXPECT_TRUE(mentions(map.text(), "\"index\" \"3\"\n"));
  EXPECT_TRUE(is_sound(map.document()));
}

TEST(MovesCommands, ASecondRobotStartIsLeftOut) {
  Furnished map;
  EXPECT_TRUE(mentions(map.run("duplicate class=hw_robot_start+lamp by 1,0").lines[0], "left out"));
  EXPECT_TRUE(mentions(refusal(map, "duplicate class=hw_robot_start by 1,0"), "nothing"));
  EXPECT_TRUE(mentions(refusal(map, "duplicate lamp"), "by"));
  EXPECT_TRUE(mentions(refusal(map, "duplicate lapm by 1,0"), "lamp"));
}

// ---- The clipboard ------------------------------------------------------------------------------------------------------

struct TwoMaps {
  TwoMaps() {
    for (Editing* map : {static_cast<Editing*>(&from), &to})
      map->session->set_clipboard(shared / "clipboard.map");
  }
  test::TempFolder shared;
  Furnished from;
  Editing to;
};

TEST(Clipboard, BrushesAreTheSameInTheOtherMap) {
  TwoMaps maps;
  maps.to.run("new");
  maps.from.run("copy all");
  maps.to.run("paste");
  // Two maps with the same things, but for the folder that one model is in.
  EXPECT_EQ(looks(maps.to), looks(maps.from));
  EXPECT_EQ(maps.to.text(), maps.from.text());
  maps.from.run("cut corner+2");
  EXPECT_EQ(maps.to.run("paste by 0,0,10").data["made"].size(), 2u);
  EXPECT_EQ(test::named(maps.to, "crate-2").head->find("_tb_group") != nullptr, true);
  EXPECT_TRUE(mentions(refusal(maps.from, "info corner"), "corner"));
  maps.from.run("paste");  // it may come back, too
  EXPECT_TRUE(editor::group_number(test::named(maps.from, "corner")));
  EXPECT_EQ(*test::named(maps.from, "crate").head->find("_tb_group"),
            *test::named(maps.from, "corner").head->find("_tb_id"));
}

TEST(Clipboard, AMapOfOtherUnitsGetsTheSameSize) {
  TwoMaps maps;
  maps.to.run("new scale=0.05");
  maps.from.run("copy all");
  maps.to.run("paste");
  EXPECT_NEAR(test::volume(maps.to), test::volume(maps.from), 1e-6 * test::volume(maps.from));
  EXPECT_EQ(editor::origin_of(test::named(maps.to, "lamp")), Vec3(20, 20, 40));
  EXPECT_EQ(*test::named(maps.to, "way").head->find("corner_radius_m"), "0.5");
  EXPECT_NE(test::named(maps.to, "north").head->find("_hw_made"), nullptr);
  EXPECT_FALSE(test::is_solid(maps.to, {2, 5, 1}));
  EXPECT_TRUE(test::is_solid(maps.to, {0.5, 5, 1}));
}

TEST(Clipboard, PasteToAPlace) {
  TwoMaps maps;
  maps.to.run("new");
  maps.from.run("copy crate");
  maps.to.run("paste to 1,2,3");
  const State& state = maps.to.session->state();
  EXPECT_EQ(editor::bounds_of(state, editor::resolve_one(state, "crate")).min(), Vec3(100, 200, 300));
  EXPECT_EQ(test::named(maps.to, "crate").head->find("_tb_group"), nullptr) << "its group was not copied";
}

TEST(Clipboard, BrushesOfEntitiesKeepWhatTheyDo) {
  TwoMaps maps;
  maps.to.run_all({"new", "box from 20,0 to 30,10,5"});
  maps.from.run("room from 20,0 to 25,4 name=kitchen");
  const auto& cut = *maps.from.session->state().entities.back();
  ASSERT_EQ(cut.classname(), "hw_subtract");
  maps.from.run("copy " + std::to_string(cut.brushes[0].id));
  maps.to.run("paste");
  EXPECT_EQ(maps.to.session->state().entities.back()->classname(), "hw_subtract");
  EXPECT_FALSE(test::is_solid(maps.to, {22, 2, 1}));
}

TEST(Clipboard, Refusals) {
  TwoMaps maps;
  maps.to.run("new");
  EXPECT_TRUE(mentions(refusal(maps.to, "paste"), "empty"));
  maps.from.run("copy 2");
  EXPECT_TRUE(mentions(refusal(maps.to, "paste by 1,1 to 2,2"), "not both"));
  EXPECT_TRUE(mentions(refusal(maps.from, "copy lapm"), "lamp"));
  EXPECT_TRUE(mentions(refusal(maps.from, "cut lapm"), "lamp"));
  EXPECT_TRUE(mentions(refusal(maps.from, "cut class=worldspawn"), "worldspawn"));
  Editing unmade;
  unmade.session->set_clipboard(maps.shared / "clipboard.map");
  EXPECT_TRUE(mentions(refusal(unmade, "paste"), "worldspawn"));
  maps.shared.write("clipboard.map", "{ \"classname\" \"worldspawn\" }\n");
  EXPECT_TRUE(mentions(refusal(maps.to, "paste"), "empty"));
  maps.shared.write("clipboard.map", "no map\n");
  const auto bad = test::error_of([&] { maps.to.run("paste"); });
  ASSERT_TRUE(bad);
  EXPECT_EQ(bad->code(), ErrorCode::kBadInput);
  maps.to.session->set_clipboard("");
  for (const char* line : {"paste", "copy all", "cut all"}) {
    maps.from.session->set_clipboard("");
    EXPECT_TRUE(mentions(refusal(maps.from, line), "no clipboard")) << line;
  }
}

}  // namespace
}  // namespace hallway
