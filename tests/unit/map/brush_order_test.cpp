// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "map/reader.hpp"
#include "map/world.hpp"
#include "map_text.hpp"
#include "support/errors.hpp"
#include "support/long_mode.hpp"

namespace hallway::map {
namespace {

using hallway::test::error_of;

/// A brush that fills an axis-parallel box, in braces.
std::string box_text(const Vec3& low, const Vec3& high, const std::string& material = "wall") {
  const auto point = [](const Vec3& p) {
    return "( " + format_double(p.x()) + " " + format_double(p.y()) + " " + format_double(p.z()) + " ) ";
  };
  const Vec3 x = Vec3::UnitX();
  const Vec3 y = Vec3::UnitY();
  const Vec3 z = Vec3::UnitZ();
  std::string text = "{\n";
  for (const auto& [at, first, second] : std::vector<std::array<Vec3, 3>>{
           {low, y, z}, {low, z, x}, {low, x, y}, {high, z, y}, {high, x, z}, {high, y, x}})
    text += test::face_line(point(at) + point(at + first) + point(at + second), material);
  return text + "}\n";
}

std::string entity(const std::string& classname, const std::string& brushes, const std::string& keys = "") {
  return "{\n\"classname\" \"" + classname + "\"\n" + keys + brushes + "}\n";
}

std::string order(const std::string& value) {
  return "\"order\" \"" + value + "\"\n";
}

const std::string kUnits = "\"_scale\" \"1\"\n";

bool is_solid(const World& world, const Vec3& point) {
  for (auto solid = world.solids.rbegin(); solid != world.solids.rend(); ++solid) {
    if (solid->role != BrushRole::kHint && solid->contains(point)) return solid->role != BrushRole::kSubtract;
  }
  return false;
}

std::vector<int> entities_of(const World& world) {
  std::vector<int> entities;
  for (const Solid& solid : world.solids) entities.push_back(solid.entity);
  return entities;
}

TEST(BrushOrder, OrderedEntitiesApplyAfterAllOthersByTheirKey) {
  const std::string box = box_text({0, 0, 0}, {8, 8, 8});
  const World world =
      build_world(parse(entity("hw_subtract", box, order("3")) + entity("hw_add", box, order("-2")) +
                            entity("hw_add", box) + entity("hw_detail", box) +
                            entity("hw_subtract", box, order("0")) + entity("worldspawn", box, kUnits),
                        "a.map"));
  EXPECT_EQ(entities_of(world), (std::vector<int>{5, 1, 2, 3, 4, 0}));
  EXPECT_EQ(world.solids[0].role, BrushRole::kAdd);
  EXPECT_EQ(world.solids[2].role, BrushRole::kAdd);
  EXPECT_EQ(world.solids[3].role, BrushRole::kDetail);
  EXPECT_EQ(world.solids[4].role, BrushRole::kSubtract);
  EXPECT_EQ(world.metres_per_unit, 1.0);
}

TEST(BrushOrder, ARoomIsABlockAndASmallerOneTakenAway) {
  const World world = build_world(parse(entity("worldspawn", box_text({0, 0, 0}, {10, 10, 10}), kUnits) +
                                            entity("hw_subtract", box_text({1, 1, 1}, {9, 9, 9})) +
                                            entity("hw_add", box_text({4, 4, 0}, {6, 6, 10}), order("1")),
                                        "a.map"));
  EXPECT_TRUE(is_solid(world, {0.5, 5, 5}));
  EXPECT_FALSE(is_solid(world, {2, 2, 2}));
  EXPECT_TRUE(is_solid(world, {5, 5, 5}));
}

TEST(BrushOrder, BoundsAreThoseOfWhatIsAdded) {
  const World world = build_world(parse(entity("worldspawn", box_text({0, 0, 0}, {10, 10, 10}), kUnits) +
                                            entity("hw_subtract", box_text({-50, 1, 1}, {50, 9, 9})) +
                                            entity("func_group", box_text({0, 0, 0}, {99, 1, 1}, "hint")),
                                        "a.map"));
  EXPECT_EQ(world.bounds.min(), Vec3::Zero());
  EXPECT_EQ(world.bounds.max(), Vec3::Constant(10.0));
}

void expect_refused(const std::string& text, int line, const std::string& cause) {
  const auto error = error_of([&] { build_world(parse(text, "a.map")); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_EQ(error->where().file, "a.map");
  EXPECT_EQ(error->where().line, line);
  EXPECT_NE(error->message().find(cause), std::string::npos) << error->what();
}

TEST(BrushOrder, AnOrderThatIsNoWholeNumberIsAnError) {
  for (const char* value : {"1.5", "first", "", "1e3", "99999999999999999999"})
    expect_refused(entity("hw_subtract", "", order(value)), 3, "is no whole number");
}

TEST(BrushOrder, UnknownKeysOfOrderedEntitiesAreErrors) {
  expect_refused(entity("hw_add", "", "\"oder\" \"1\"\n"), 3, "did you mean \"order\"");
  expect_refused(entity("hw_detail", "", "\"ordre\" \"1\"\n"), 3, "did you mean \"order\"");
  EXPECT_NO_THROW(build_world(parse(entity("hw_add", "", "\"_tb_group\" \"4\"\n"), "a.map")));
}

/// A map of random boxes in worldspawn, groups, detail and ordered entities whose orders all differ.
struct Boxes {
  std::vector<std::string> base;  ///< brushes that are added
  std::vector<std::string> detail;
  std::vector<std::string> ordered;  ///< whole entities
};

Boxes random_boxes(std::mt19937_64& random) {
  const auto box = [&] {
    Vec3 low;
    Vec3 size;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = static_cast<double>(random() % 64);
      size[axis] = static_cast<double>(1 + random() % 32);
    }
    return box_text(low, low + size);
  };
  Boxes made;
  for (int i = 0; i < 12; ++i) made.base.push_back(box());
  for (int i = 0; i < 3; ++i) made.detail.push_back(entity("func_detail", box()));
  for (int i = 0; i < 10; ++i)
    made.ordered.push_back(
        entity(i % 2 ? "hw_add" : "hw_subtract", box() + box(), order(std::to_string(i - 5))));
  return made;
}

/// Writes the boxes as an editor does after brushes were put into groups and layers, in any order.
std::string as_an_editor_writes(Boxes boxes, std::mt19937_64& random) {
  std::shuffle(boxes.base.begin(), boxes.base.end(), random);
  std::string world;
  std::array<std::string, 3> groups;
  for (const std::string& brush : boxes.base) {
    const std::size_t where = random() % 4;
    (where == 3 ? world : groups[where]) += brush;
  }
  std::vector<std::string> rest = boxes.detail;
  rest.insert(rest.end(), boxes.ordered.begin(), boxes.ordered.end());
  for (std::string& text : rest) text.insert(text.find("\n\"") + 1, "\"_tb_group\" \"1\"\n");
  rest.push_back(entity("func_group", groups[0], "\"_tb_type\" \"_tb_group\"\n\"_tb_id\" \"1\"\n"));
  rest.push_back(entity("func_group", groups[1],
                        "\"_tb_type\" \"_tb_layer\"\n\"_tb_id\" \"2\"\n\"_tb_layer_sort_index\" \"0\"\n"));
  rest.push_back(
      entity("func_group", groups[2], "\"_tb_type\" \"_tb_group\"\n\"_tb_id\" \"3\"\n\"_tb_layer\" \"2\"\n"));
  std::shuffle(rest.begin(), rest.end(), random);
  std::string text = entity("worldspawn", world, kUnits);
  for (const std::string& next : rest) text += next;
  return text;
}

TEST(BrushOrder, GroupsLayersAndReorderingDoNotChangeWhatIsSolid) {
  std::mt19937_64 random(41);
  std::uniform_real_distribution<double> coordinate(-2.0, 100.0);
  const int maps = hallway::test::sized(20, 1000);
  for (int i = 0; i < maps; ++i) {
    SCOPED_TRACE(i);
    const Boxes boxes = random_boxes(random);
    const World before = build_world(parse(as_an_editor_writes(boxes, random), "before.map"));
    const World after = build_world(parse(as_an_editor_writes(boxes, random), "after.map"));
    ASSERT_EQ(before.solids.size(), 35u);
    ASSERT_EQ(after.solids.size(), 35u);
    int solid = 0;
    for (int j = 0; j < 1000; ++j) {
      const double x = coordinate(random);
      const double y = coordinate(random);
      const Vec3 point(x, y, coordinate(random));
      ASSERT_EQ(is_solid(before, point), is_solid(after, point)) << point.transpose();
      solid += is_solid(before, point) ? 1 : 0;
    }
    EXPECT_GT(solid, 10);
    EXPECT_LT(solid, 990);
  }
}

TEST(BrushOrder, FacesKnowTheirPointsInTheFile) {
  const Document document = parse(entity("worldspawn", box_text({0.1, 0, 0}, {8, 8, 8})), "a.map");
  const World world = build_world(document);
  ASSERT_EQ(world.solids.size(), 1u);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(world.solids[0].faces[i].points, document.entities[0].brushes[0].faces[i].points);
  EXPECT_EQ(world.metres_per_unit, 1.0 / 32.0);
}

}  // namespace
}  // namespace hallway::map
