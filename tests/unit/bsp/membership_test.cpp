// SPDX-License-Identifier: MIT
// Random worlds, compiled: membership, the void, clusters and portals against definitions that need no tree.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>

#include "bsp/compile.hpp"
#include "compiled_checks.hpp"
#include "map/occupants.hpp"
#include "map/reader.hpp"
#include "support/data.hpp"
#include "support/long_mode.hpp"
#include "support/random_brushes.hpp"
#include "voxels.hpp"

namespace hallway::bsp {
namespace {

using test::Act;
using test::Compared;
using test::Counting;
using test::kWorldKinds;
using test::RandomActs;
using test::Voxels;
using test::WorldKind;

/// Every rule, and parameters at their extremes.
CompileOptions options_for(std::uint64_t seed) {
  CompileOptions options;
  options.build.rule = std::array{SplitRule::kBalanced, SplitRule::kAxialFirst, SplitRule::kNaive}[seed % 3];
  if (seed % 4 == 1) options.build.candidates = 1;
  if (seed % 5 == 1) options.build.split_cost = 0.0;
  if (seed % 5 == 2) options.build.balance_cost = 10.0;
  if (seed % 7 == 3) options.build.oblique_cost = -5.0;
  if (seed % 7 == 4) options.build.on_gain = -1.0;
  options.narrowest_m = 1e-7;  // these worlds have cracks on purpose
  return options;
}

std::vector<Act> random_acts(WorldKind kind, std::uint64_t seed) {
  std::vector<Act> acts = RandomActs(kind, seed).make();
  std::mt19937_64 random(seed);
  for (Act& act : acts) {
    const bool detail = random() % 4 == 0 && act.role == map::BrushRole::kAdd;
    if (detail) act.role = map::BrushRole::kDetail;
    if (random() % 12 == 0) {
      act.role = map::BrushRole::kAdd;
      for (map::Face& face : act.brush.faces) face.material = "hint";
    }
  }
  return acts;
}

class EveryKind : public testing::TestWithParam<WorldKind> {
 protected:
  std::string fault_of(const std::vector<Act>& acts, std::uint64_t seed) {
    const map::World world = map::build_world(test::document_of(acts));
    std::vector<Vec3> occupants;
    std::mt19937_64 random(seed);
    if (seed % 2 == 0 && !world.bounds.isEmpty())
      occupants.push_back(test::random_point(random, world.bounds));
    const Compiled compiled = compile(world, occupants, options_for(seed));
    sealed_ += compiled.enclosure.sealed ? 1 : 0;
    std::string fault = test::wrong_content(world, compiled, seed, 400, compared_);
    if (fault.empty()) fault = test::wrong_portal(world, compiled);
    if (fault.empty()) fault = test::missing_portal(world, compiled, seed, 150, 2.0, passed_);
    if (fault.empty()) fault = test::wrong_inside_flag(world, compiled);
    return fault;
  }

  Compared compared_;
  int passed_ = 0;
  int sealed_ = 0;
};
INSTANTIATE_TEST_SUITE_P(Worlds, EveryKind, testing::ValuesIn(kWorldKinds));

TEST_P(EveryKind, TheTreeIsWhatTheBrushesSay) {
  const auto worlds = static_cast<std::uint64_t>(test::sized(45, 1500));
  for (std::uint64_t seed = 1; seed <= worlds; ++seed) {
    const std::vector<Act> acts = random_acts(GetParam(), seed);
    const std::string fault = fault_of(acts, seed);
    if (fault.empty()) continue;
    const auto smallest =
        test::shrunk(acts, [&](const std::vector<Act>& fewer) { return fault_of(fewer, seed); });
    FAIL() << "seed " << seed << ": " << fault << "\nsmallest: " << fault_of(smallest, seed) << '\n'
           << test::to_text(smallest);
  }
  EXPECT_GT(compared_.all, 200 * worlds);
  EXPECT_LT(static_cast<double>(compared_.near), 1e-3 * static_cast<double>(compared_.all));
  EXPECT_GT(passed_, 100);
}

/// Kinds on a grid, where flooding cubes tells everything.
class OnGrid : public testing::TestWithParam<WorldKind> {
 protected:
  map::World hollow_world(std::uint64_t seed) const {
    std::vector<Act> acts = random_acts(GetParam(), seed);
    if (seed % 3 != 0) {  // a block with a hole, so that there is an inside more often
      map::Brush block = test::box({0, 0, 0}, {6, 6, 6}), hole = test::box({1, 1, 1}, {5, 5, 5});
      for (map::Brush* brush : {&block, &hole}) {
        for (map::Face& face : brush->faces) {
          for (Vec3& point : face.points) point = RandomActs::placed(GetParam(), point);
        }
      }
      acts.insert(acts.begin(), {{map::BrushRole::kAdd, block}, {map::BrushRole::kSubtract, hole}});
    }
    return map::build_world(test::document_of(acts));
  }
  Vec3 place(const Vec3& grid) const { return RandomActs::placed(GetParam(), grid); }
};
INSTANTIATE_TEST_SUITE_P(Worlds, OnGrid,
                         testing::Values(WorldKind::kGrid, WorldKind::kDecimals, WorldKind::kTurned));

TEST_P(OnGrid, TheVoidReachesWhatItReaches) {
  int sealed = 0, leaking = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(test::sized(60, 2000)); ++seed) {
    const map::World world = hollow_world(seed);
    const auto solid = [&](const Vec3& at) { return test::brushes_solid(world, place(at)); };
    const Voxels structure(
        [&](const Vec3& at) { return test::brushes_solid(world, place(at), Counting::kStructure); });
    std::mt19937_64 random(seed);
    std::array<int, 3> stands{};
    for (int tries = 0; tries < 10; ++tries) {
      for (int& k : stands) k = 2 + static_cast<int>(random() % 6);
      if (!structure.solid(stands[0], stands[1], stands[2])) break;
    }
    const auto [sx, sy, sz] = stands;
    const std::vector<Vec3> occupants{place(Voxels::middle(sx, sy, sz))};
    const Compiled compiled = compile(world, occupants, options_for(seed));
    const Enclosure& enclosure = compiled.enclosure;
    EXPECT_EQ(enclosure.in_solid.size(), structure.solid(sx, sy, sz) ? 1u : 0u) << "seed " << seed;
    EXPECT_EQ(enclosure.leaking.size(), structure.outside(sx, sy, sz) ? 1u : 0u) << "seed " << seed;
    ASSERT_EQ(enclosure.sealed, !structure.solid(sx, sy, sz) && !structure.outside(sx, sy, sz))
        << "seed " << seed;
    ASSERT_EQ(enclosure.leak.has_value(), structure.outside(sx, sy, sz));
    sealed += enclosure.sealed ? 1 : 0;
    leaking += enclosure.leak ? 1 : 0;
    Voxels::for_each([&](int x, int y, int z) {
      const Vec3 at = Voxels::middle(x, y, z);
      const bool empty = !solid(at) && !(enclosure.sealed && structure.outside(x, y, z));
      const Leaf& leaf = compiled.tree.leaves[leaf_at(compiled.tree, place(at))];
      ASSERT_EQ(leaf.content == Content::kEmpty, empty)
          << "seed " << seed << " at " << place(at).transpose() << (enclosure.sealed ? ", sealed" : "");
    });
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(sealed, 10);
  EXPECT_GT(leaking, 10);
}

/// Groups of clusters that portals join: cubes are in one exactly if one can be reached from the other.
TEST_P(OnGrid, PortalsJoinWhatHangsTogether) {
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(test::sized(40, 1000)); ++seed) {
    const map::World world = hollow_world(seed);
    const Vec3 middle = place(Vec3(3.5, 3.5, 3.5));
    const Compiled compiled = compile(world, {middle}, options_for(seed));
    std::vector<std::uint32_t> group(compiled.portals.clusters);
    for (std::uint32_t i = 0; i < group.size(); ++i) group[i] = i;
    const std::function<std::uint32_t(std::uint32_t)> root = [&](std::uint32_t i) {
      return group[i] == i ? i : group[i] = root(group[i]);
    };
    for (const Portal& portal : compiled.portals.portals)
      group[root(portal.cluster[0])] = root(portal.cluster[1]);
    // Each part of the empty structure, flooded by itself.
    std::map<std::uint32_t, int> part_of_group;
    std::vector<int> part(static_cast<std::size_t>(Voxels::kSize * Voxels::kSize * Voxels::kSize), -1);
    const Voxels structure(
        [&](const Vec3& at) { return test::brushes_solid(world, place(at), Counting::kStructure); });
    const auto index = [](int x, int y, int z) {
      return static_cast<std::size_t>((z * Voxels::kSize + y) * Voxels::kSize + x);
    };
    int parts = 0;
    const std::function<void(int, int, int)> flood = [&](int x, int y, int z) {
      if (x < 0 || y < 0 || z < 0 || x >= Voxels::kSize || y >= Voxels::kSize || z >= Voxels::kSize) return;
      if (structure.solid(x, y, z) || part[index(x, y, z)] >= 0) return;
      part[index(x, y, z)] = parts;
      for (const int step : {-1, 1}) {
        flood(x + step, y, z);
        flood(x, y + step, z);
        flood(x, y, z + step);
      }
    };
    Voxels::for_each([&](int x, int y, int z) {
      if (structure.solid(x, y, z)) return;
      if (part[index(x, y, z)] < 0) {
        flood(x, y, z);
        ++parts;
      }
      const std::int32_t cluster = cluster_at(compiled.tree, place(Voxels::middle(x, y, z)));
      if (cluster < 0) return;  // detail, or the void around a sealed world
      const auto [known, added] =
          part_of_group.emplace(root(static_cast<std::uint32_t>(cluster)), part[index(x, y, z)]);
      ASSERT_EQ(known->second, part[index(x, y, z)]) << "seed " << seed << ": portals join what is apart";
    });
    if (HasFatalFailure()) return;
    std::set<int> distinct;
    for (const auto& [name, number] : part_of_group)
      ASSERT_TRUE(distinct.insert(number).second) << "seed " << seed << ": a portal is missing";
  }
}

/// Detail within the structure's bounds divides no visibility: clusters and portals are those of the world without it.
TEST_P(OnGrid, DetailMovesNoPortal) {
  int with_detail = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(test::sized(40, 1000)); ++seed) {
    if (seed % 3 == 0) continue;  // there the detail may be the outermost
    const map::World world = hollow_world(seed);
    map::World plain = world;
    std::erase_if(plain.solids,
                  [](const map::Solid& solid) { return solid.role == map::BrushRole::kDetail; });
    with_detail += plain.solids.size() < world.solids.size() ? 1 : 0;
    const std::vector<Vec3> occupants{place(Vec3(3.5, 3.5, 3.5))};
    const PortalGraph a = compile(world, occupants, options_for(seed)).portals;
    const PortalGraph b = compile(plain, occupants, options_for(seed)).portals;
    ASSERT_EQ(a.clusters, b.clusters) << "seed " << seed;
    ASSERT_EQ(a.portals.size(), b.portals.size()) << "seed " << seed;
    for (std::size_t p = 0; p < a.portals.size(); ++p) {
      ASSERT_EQ(a.portals[p].cluster, b.portals[p].cluster) << "seed " << seed;
      ASSERT_EQ(a.portals[p].polygon.vertices, b.portals[p].polygon.vertices) << "seed " << seed;
    }
  }
  EXPECT_GT(with_detail, 10);
}

/// Maps that people have drawn.
class OfRealMap : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Maps, OfRealMap,
                         testing::Values("id1/dm5.map", "id1/end.map", "id1/e1m1.map", "librequake/slope.map",
                                         "librequake/start.map", "librequake/b_rock1.map",
                                         "small/ericw_tools/testmaps/base1-test.map",
                                         "small/ericw_tools/testmaps/q1_rocks.map",
                                         "small/ericw_tools/testmaps/q1_detail_wall.map",
                                         "small/ericw_tools/testmaps/q1_sealing.map",
                                         "small/ericw_tools/testmaps/base1leak.map"));

TEST_P(OfRealMap, TheTreeIsWhatTheBrushesSay) {
  HALLWAY_DATA_OR_SKIP(file, std::string("maps/") + GetParam());
  const map::Document document = map::load(file);
  const map::World world = map::build_world(document);
  std::vector<Vec3> occupants;
  for (const map::Occupant& occupant : map::occupants(document)) occupants.push_back(occupant.position_m);
  std::vector<SplitRule> rules{SplitRule::kBalanced};
  if (test::long_mode()) rules = {SplitRule::kBalanced, SplitRule::kAxialFirst, SplitRule::kNaive};
  for (const SplitRule rule : rules) {
    CompileOptions options;
    options.build.rule = rule;
    const Compiled compiled = compile(world, occupants, options);
    Compared compared;
    int passed = 0;
    EXPECT_EQ(test::wrong_content(world, compiled, 1, test::sized(3000, 100000), compared), "");
    EXPECT_EQ(test::wrong_portal(world, compiled), "");
    EXPECT_EQ(test::missing_portal(world, compiled, 2, test::sized(4000, 100000), 2.0, passed), "");
    EXPECT_EQ(test::wrong_inside_flag(world, compiled), "");
    EXPECT_LT(static_cast<double>(compared.near), 1e-3 * static_cast<double>(compared.all));
    if (compiled.portals.portals.size() > 100) {
      EXPECT_GT(passed, 50);
    }
  }
}

}  // namespace
}  // namespace hallway::bsp
