// SPDX-License-Identifier: MIT
// What the sets promise, against lines stepped through the portals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "pvs/compute.hpp"
#include "sight_lines.hpp"
#include "split_world.hpp"
#include "support/long_mode.hpp"

namespace hallway::pvs {
namespace {

using hallway::test::sized;
using test::Dice;
using test::SightLines;
using test::split_world;
using test::SplitWorld;
using test::WorldSettings;

/// Worlds of every kind, by number.
WorldSettings settings_of(std::size_t kind) {
  WorldSettings settings;
  switch (kind % 6) {
    case 1:
      settings.oblique = 0.0;  // every portal on the grid, many on the same plane
      break;
    case 2:
      settings.oblique = 1.0;
      break;
    case 3:
      settings.sliver = 0.5;
      settings.door = 0.3;
      break;
    case 4:
      settings.origin = Vec3(10'000.0, -9'000.5, 8'000.25);
      settings.sliver = 0.15;
      break;
    case 5:
      settings.door = 0.05;  // a hall full of pillars
      settings.wall = 0.0;
      settings.pillar = 0.3;
      settings.cells = 80;
      break;
    default:
      break;
  }
  return settings;
}

Vec3 point_of(const Polygon& polygon, Dice& dice) {
  Vec3 sum = Vec3::Zero();
  double total = 0.0;
  for (const Vec3& vertex : polygon.vertices) {
    const double weight = dice.uniform(0.001, 1.0);
    sum += weight * vertex;
    total += weight;
  }
  return sum / total;
}

/// A vertex or a point of an edge, moved inward by `inward` of the way to the middle.
Vec3 rim_point_of(const Polygon& polygon, double inward, Dice& dice) {
  const std::size_t i = dice.below(polygon.vertices.size());
  const Vec3& start = polygon.vertices[i];
  const Vec3& end = polygon.vertices[(i + 1) % polygon.vertices.size()];
  const Vec3 point = dice.chance(0.5) ? start : Vec3(start + dice.uniform() * (end - start));
  Vec3 middle = Vec3::Zero();
  for (const Vec3& vertex : polygon.vertices) middle += vertex;
  middle /= static_cast<double>(polygon.vertices.size());
  return point + inward * (middle - point);
}

/// Calls `visit(clusters)` for lines through the world: each cluster of one sees all others of it.
template <typename Visit>
void for_each_line(const SplitWorld& world, std::size_t lines, std::uint64_t seed, Visit visit) {
  const SightLines sight(world.graph);
  const auto& portals = world.graph.portals;
  Dice dice(seed);
  for (std::size_t i = 0; i < lines; ++i) {
    const auto cluster = static_cast<std::uint32_t>(dice.below(world.graph.clusters));
    visit(sight.pass(cluster, world.point_in(cluster, dice), dice.direction(), 0.0));
    if (portals.size() < 2) continue;
    const std::size_t first = dice.below(portals.size());
    const Polygon& from = portals[first].polygon;
    const Polygon& to = portals[dice.below(portals.size())].polygon;
    const Vec3 start = point_of(from, dice);
    visit(sight.pass_through(first, start, point_of(to, dice) - start, 0.0));
    for (const double inward : {0.0, 1e-9, 1e-4}) {
      const Vec3 rim = rim_point_of(from, inward, dice);
      const Vec3 way = rim_point_of(to, inward, dice) - rim;
      if (way.norm() > 1e-3) visit(sight.pass_through(first, rim, way, 0.0));
    }
  }
}

/// Pairs of clusters on a common line that the sets call hidden from each other.
std::string first_hidden(const SplitWorld& world, const VisibleSets& sets, std::size_t lines,
                         std::uint64_t seed) {
  std::vector<std::vector<bool>> visible(sets.clusters(), std::vector<bool>(sets.clusters()));
  for (std::uint32_t a = 0; a < sets.clusters(); ++a) {
    for (const std::uint32_t b : sets.visible_from(a)) visible[a][b] = true;
  }
  std::string found;
  for_each_line(world, lines, seed, [&](const std::vector<std::uint32_t>& clusters) {
    for (const std::uint32_t a : clusters) {
      for (const std::uint32_t b : clusters) {
        if (!visible[a][b]) found = std::to_string(a) + " and " + std::to_string(b);
      }
    }
  });
  return found;
}

bool is_subset(const VisibleSets& inner, const VisibleSets& outer) {
  for (std::uint32_t cluster = 0; cluster < inner.clusters(); ++cluster) {
    const auto small = inner.visible_from(cluster);
    const auto large = outer.visible_from(cluster);
    if (!std::includes(large.begin(), large.end(), small.begin(), small.end())) return false;
  }
  return true;
}

TEST(Sight, NeverHidesWhatALineReaches) {
  const std::size_t worlds = sized<std::size_t>(18, 120);
  const std::size_t lines = sized<std::size_t>(2'000, 20'000);
  std::size_t longest = 0;
  for (std::size_t kind = 0; kind < worlds; ++kind) {
    const SplitWorld world = split_world(kind, settings_of(kind));
    for (const Level level : {Level::kFast, Level::kFull}) {
      const VisibleSets sets = compute(world.graph, {.level = level});
      EXPECT_EQ(first_hidden(world, sets, lines, kind), "") << "world " << kind;
    }
    for_each_line(world, 100, kind,
                  [&](const auto& clusters) { longest = std::max(longest, clusters.size()); });
  }
  EXPECT_GE(longest, 6u) << "the lines pass hardly any portal";
}

TEST(Sight, NeverHidesWhatALineReachesWhenTheSearchIsCutShort) {
  std::size_t cut_short = 0;
  for (std::size_t kind = 0; kind < sized<std::size_t>(12, 60); ++kind) {
    const SplitWorld world = split_world(kind, settings_of(kind));
    const VisibleSets full = compute(world.graph, {});
    const VisibleSets fast = compute(world.graph, {.level = Level::kFast});
    for (const std::uint64_t work : {0u, 200u, 2'000u}) {
      Statistics statistics;
      const VisibleSets sets =
          compute(world.graph, {.work_limit = work * 2 * world.graph.portals.size()}, &statistics);
      cut_short += statistics.cut_short;
      EXPECT_EQ(first_hidden(world, sets, sized<std::size_t>(1'000, 10'000), kind), "") << "world " << kind;
      EXPECT_TRUE(is_subset(sets, fast));
      if (statistics.cut_short == 0) {
        EXPECT_EQ(sets.mean_share(), full.mean_share());
      }
    }
  }
  EXPECT_GT(cut_short, 0u);
}

TEST(Sight, FullIsPartOfFastAndBothAreSymmetric) {
  for (std::size_t kind = 0; kind < sized<std::size_t>(12, 60); ++kind) {
    const SplitWorld world = split_world(kind, settings_of(kind));
    const VisibleSets fast = compute(world.graph, {.level = Level::kFast});
    const VisibleSets full = compute(world.graph, {});
    EXPECT_TRUE(is_subset(full, fast)) << "world " << kind;
    for (const VisibleSets* sets : {&fast, &full}) {
      for (std::uint32_t a = 0; a < sets->clusters(); ++a) {
        EXPECT_TRUE(sets->visible(a, a));
        for (const std::uint32_t b : sets->visible_from(a)) EXPECT_TRUE(sets->visible(b, a)) << a << " " << b;
      }
    }
  }
}

TEST(Sight, CallsLittleVisibleThatNoLineReaches) {
  for (std::size_t kind = 0; kind < 6; ++kind) {
    WorldSettings settings = settings_of(kind);
    settings.cells = std::min<std::size_t>(settings.cells, 40);
    const SplitWorld world = split_world(1000 + kind, settings);
    std::set<std::pair<std::uint32_t, std::uint32_t>> reached;
    for (std::uint32_t cluster = 0; cluster < world.graph.clusters; ++cluster)
      reached.emplace(cluster, cluster);
    for_each_line(world, sized<std::size_t>(30'000, 300'000), kind, [&](const auto& clusters) {
      for (const std::uint32_t a : clusters) {
        for (const std::uint32_t b : clusters) reached.emplace(a, b);
      }
    });
    const double lower =
        static_cast<double>(reached.size()) / std::pow(static_cast<double>(world.graph.clusters), 2);
    const double fast = compute(world.graph, {.level = Level::kFast}).mean_share();
    const double full = compute(world.graph, {}).mean_share();
    RecordProperty("shares_" + std::to_string(kind),
                   std::to_string(lower) + " " + std::to_string(full) + " " + std::to_string(fast));
    EXPECT_LE(full, lower + 0.1) << "world " << kind;
    EXPECT_GE(full, lower) << "world " << kind;
  }
}

}  // namespace
}  // namespace hallway::pvs
