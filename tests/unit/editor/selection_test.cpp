// SPDX-License-Identifier: MIT
#include "editor/selection.hpp"

#include <gtest/gtest.h>

#include <string>

#include "base/random.hpp"
#include "editor/shapes.hpp"
#include "solidity.hpp"
#include "support/brushes.hpp"
#include "support/errors.hpp"
#include "unit/editor/editing.hpp"

namespace hallway {
namespace {

using editor::Id;
using editor::State;
using editor::Thing;

/// worldspawn 1 with brushes 2, 3; group 4 "inner" with brush 5; its cut 6 with brush 7; group 8 "outer" that holds inner; light 9 "lamp"; path 10
/// with waypoints 11, 12.
State sample() {
  test::MapMaker maker;
  maker.add(test::box({0, 0, 0}, {100, 100, 100}, "brick"))
      .add(test::box({200, 0, 0}, {300, 100, 100}, "wood"))
      .entity("func_group", {test::box({0, 200, 0}, {100, 300, 100})},
              {{"_tb_type", "_tb_group"}, {"_tb_name", "inner"}, {"_tb_id", "1"}, {"_tb_group", "2"}})
      .entity("hw_subtract", {test::box({20, 220, 20}, {80, 280, 80})}, {{"order", "1"}, {"_tb_group", "1"}})
      .entity("func_group", {}, {{"_tb_type", "_tb_group"}, {"_tb_name", "outer"}, {"_tb_id", "2"}})
      .entity("light", {}, {{"origin", "10 20 30"}, {"targetname", "lamp"}})
      .entity("hw_path", {}, {{"name", "way"}})
      .entity("hw_waypoint", {}, {{"path", "way"}, {"index", "0"}, {"origin", "0 0 0"}})
      .entity("hw_waypoint", {}, {{"path", "way"}, {"index", "1"}, {"origin", "100 0 0"}});
  return editor::state_of(maker.document());
}

std::vector<Id> ids(const State& state, const std::vector<Thing>& things) {
  std::vector<Id> result;
  for (const Thing& thing : things) result.push_back(editor::id_of(state, thing));
  return result;
}

std::vector<Id> meant(const std::string& what) {
  const State state = sample();
  return ids(state, editor::resolve(state, what));
}

std::string refusal(const std::string& what, const State& state = sample()) {
  const auto error = test::error_of([&] { editor::resolve(state, what); });
  if (!error) return {};
  EXPECT_EQ(error->code(), ErrorCode::kUsage);
  return error->what();
}

using Ids = std::vector<Id>;

TEST(Selection, EveryKindOfTerm) {
  EXPECT_EQ(meant("3"), Ids{3});
  EXPECT_EQ(meant("#9"), Ids{9});
  EXPECT_EQ(meant("2..3"), (Ids{2, 3}));
  EXPECT_EQ(meant("#2..#3"), (Ids{2, 3}));
  EXPECT_EQ(meant("lamp"), Ids{9});
  EXPECT_EQ(meant("la*p"), Ids{9});
  EXPECT_EQ(meant("?ay"), Ids{10});
  EXPECT_EQ(meant("class=hw_way*"), (Ids{11, 12}));
  EXPECT_EQ(meant("material=bri*"), Ids{2});
  EXPECT_EQ(meant("group=inner"), (Ids{5, 6}));
  EXPECT_EQ(meant("box=-1,-1,-1,1.5,1.5,1.5"), (Ids{2, 9, 11, 12}));
  EXPECT_EQ(meant("all"), (Ids{2, 3, 4, 6, 8, 9, 10, 11, 12}));
}

TEST(Selection, TermsAreJoinedAndABrushGoesWithItsEntity) {
  EXPECT_EQ(meant("lamp+3+lamp"), (Ids{3, 9}));
  EXPECT_EQ(meant("inner + 5"), Ids{4});
  State state = sample();
  state.desk.selection = {3, 9, 77};
  EXPECT_EQ(ids(state, editor::resolve(state, "selected")), (Ids{3, 9}));
}

TEST(Selection, Refusals) {
  EXPECT_TRUE(test::mentions(refusal("lmap"), "did you mean \"lamp\"")) << refusal("lmap");
  EXPECT_TRUE(test::mentions(refusal("99"), "99"));
  EXPECT_TRUE(test::mentions(refusal("lamp+"), "missing"));
  EXPECT_TRUE(test::mentions(refusal("selected"), "select"));
  EXPECT_TRUE(test::mentions(refusal("2..x"), "2..x"));
  EXPECT_TRUE(test::mentions(refusal("class=lihgt"), "lihgt"));
  EXPECT_TRUE(test::mentions(refusal("clas=light"), "did you mean \"class\""));
  EXPECT_TRUE(test::mentions(refusal("box=1,2,3"), "six"));
  EXPECT_TRUE(test::mentions(refusal("all", editor::state_of(test::MapMaker().document())), "empty"));
  EXPECT_TRUE(test::error_of([] { editor::resolve_one(sample(), "2+3"); }));
}

TEST(Selection, MembersOfGroupsInGroupsAndWaypointsOfPaths) {
  const State state = sample();
  EXPECT_EQ(ids(state, editor::with_members(state, editor::resolve(state, "outer"))), (Ids{4, 6, 8}));
  EXPECT_EQ(ids(state, editor::with_members(state, editor::resolve(state, "inner+5"))), (Ids{4, 6}));
  EXPECT_EQ(ids(state, editor::with_members(state, editor::resolve(state, "way"))), (Ids{10, 11, 12}));
  EXPECT_EQ(ids(state, editor::with_members(state, editor::resolve(state, "11+2"))), (Ids{2, 11}));
}

TEST(Selection, GroupsFromTheInsideOut) {
  const State state = sample();
  const auto groups = [&](Id id) {
    Ids result;
    for (const std::size_t e : editor::groups_of(state, *editor::find(state, id)))
      result.push_back(state.entities[e]->id);
    return result;
  };
  EXPECT_EQ(groups(7), (Ids{4, 8}));
  EXPECT_EQ(groups(5), (Ids{4, 8}));
  EXPECT_EQ(groups(8), Ids{8});
  EXPECT_TRUE(groups(2).empty());
}

TEST(Selection, GroupsInACircleEnd) {
  State state = sample();
  editor::set_key(state, editor::find(state, 8)->entity, "_tb_group", "1");
  EXPECT_EQ(editor::groups_of(state, *editor::find(state, 4)).size(), 2u);
  EXPECT_EQ(editor::with_members(state, editor::resolve(state, "inner")).size(), 3u);
}

TEST(Selection, VolumesAndBounds) {
  const State state = sample();
  EXPECT_NEAR(editor::volume_of(*state.entities[0]->brushes[0].brush), 1e6, 1e-3);
  EXPECT_EQ(editor::volume_of(map::Brush{}), 0.0);
  std::mt19937_64 random(5);
  for (int i = 0; i < 20; ++i) {
    const map::Brush body = test::random_polyhedron(random, {1, 2, 3}, 10.0);
    const double volume = editor::volume_of(body);
    EXPECT_GT(volume, 4.0 / 3.0 * 3.14159 * 1000.0) << "the ball inside";
    EXPECT_LT(volume, 26.0 * 26.0 * 26.0 + 1e-6) << "the cube around";
  }
  EXPECT_EQ(editor::bounds_of(state, *editor::find(state, 9)).min(), Vec3(10, 20, 30));
  EXPECT_TRUE(editor::bounds_of(state, *editor::find(state, 8)).isEmpty());
}

/// Upright boxes have a short cut; every brush has the bounds of its corners.
TEST(BoundsOf, AreThoseOfTheCorners) {
  const Random random(3, stream_id("test.editor.bounds"));
  for (std::uint32_t i = 0; i < 200; ++i) {
    const auto number = [&](std::uint64_t index) { return random.uniform(i, index, 1.0, 50.0); };
    const Vec3 low(number(0), -number(1), number(2));
    const Vec3 high = low + Vec3(number(3), number(4), number(5));
    const map::Brush box = editor::box_brush(low, high, "wall");
    const Box bounds = editor::bounds_of(box);
    constexpr double kRounding = 1e-6;  // of the box's own corners, map units
    EXPECT_LT((bounds.min() - low).norm(), kRounding);
    EXPECT_LT((bounds.max() - high).norm(), kRounding);
    EXPECT_NEAR(editor::volume_of(box), editor::volume_of(*editor::body_of(box)),
                1e-9 * editor::volume_of(box));
    // Five planes of a box and a slanted sixth one: no upright box, and a sixth plane that is missing leaves no body.
    map::Brush slanted = box;
    slanted.faces[0].points[0].z() -= 0.25;
    const auto body = editor::body_of(slanted);
    ASSERT_TRUE(body);
    Box corners;
    for (const Vec3& corner : body->vertices) corners.extend(corner);
    EXPECT_EQ(editor::bounds_of(slanted).min(), corners.min());
    EXPECT_EQ(editor::bounds_of(slanted).max(), corners.max());
    map::Brush open = box;
    open.faces[1] = open.faces[0];
    EXPECT_TRUE(editor::bounds_of(open).isEmpty());
    map::Brush inside_out = box;
    for (map::Face& face : inside_out.faces) std::swap(face.points[1], face.points[2]);
    EXPECT_TRUE(editor::bounds_of(inside_out).isEmpty());
  }
}

}  // namespace
}  // namespace hallway
