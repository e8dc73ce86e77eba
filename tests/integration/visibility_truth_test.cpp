// SPDX-License-Identifier: MIT
// What the potentially visible sets promise: two points that a free ray joins are never said to be hidden from each other. Truth is the ray
// tracer on the surface; it knows nothing of trees, clusters or portals.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/random.hpp"
#include "bsp/point_location.hpp"
#include "csg/surface.hpp"
#include "map/reader.hpp"
#include "support/data.hpp"
#include "support/long_mode.hpp"
#include "trace/scene.hpp"
#include "world/compiled_world.hpp"

namespace hallway {
namespace {

namespace fs = std::filesystem;

trace::Scene scene_of(const csg::Surface& surface) {
  trace::TriangleMesh mesh;
  mesh.vertices = surface.vertices;
  for (const csg::SurfacePolygon& polygon : surface.polygons) {
    for (const auto& triangle : csg::triangulate(surface, polygon)) mesh.triangles.push_back(triangle);
  }
  return trace::Scene(mesh, trace::Backend::kEmbree);
}

Vec3 direction_of(const Random& random, std::uint32_t step) {
  const double z = random.uniform(step, 3, -1.0, 1.0);
  const double turn = random.uniform(step, 4, 0.0, 6.283185307179586);
  const double level = std::sqrt(1.0 - z * z);
  return {level * std::cos(turn), level * std::sin(turn), z};
}

struct Counts {
  std::size_t pairs = 0;
  std::size_t other_cluster = 0;  ///< pairs in different clusters: those that can fail
  std::size_t hidden = 0;
};

/// Random points in empty space, each with a random point before the first thing in a random direction.
Counts test_pairs(const world::CompiledWorld& world, std::size_t wanted) {
  const bsp::Tree& tree = world.partition.tree;
  const trace::Scene scene = scene_of(world.partition.surface);
  const Random random(7, stream_id("visibility_truth"));
  Counts counts;
  for (std::uint32_t step = 0; counts.pairs < wanted && step < 60 * wanted; ++step) {
    Vec3 from;
    for (int axis = 0; axis < 3; ++axis) {
      from[axis] = random.uniform(step, static_cast<std::uint64_t>(axis), tree.bounds.min()[axis],
                                  tree.bounds.max()[axis]);
    }
    const std::int32_t cluster = bsp::cluster_at(tree, from);
    if (cluster < 0) continue;
    const Vec3 direction = direction_of(random, step);
    const auto hit = scene.first_hit({from, direction, 1e6});
    if (!hit) continue;
    // Half of the points are just in front of what is hit, where sight is longest.
    const double part = random.uniform(step, 5) < 0.5 ? 1.0 - 1e-6 : random.uniform(step, 6);
    const Vec3 to = from + part * hit->distance * direction;
    if (scene.occluded(from, to)) continue;
    const std::int32_t other = bsp::cluster_at(tree, to);
    if (other < 0) continue;  // rounding has put it into the wall
    ++counts.pairs;
    if (other == cluster) continue;
    ++counts.other_cluster;
    const bool seen =
        world.visible->visible(static_cast<std::uint32_t>(cluster), static_cast<std::uint32_t>(other));
    counts.hidden += seen ? 0 : 1;
    EXPECT_TRUE(seen) << "from " << from.transpose() << " to " << to.transpose();
    if (counts.hidden > 5) break;
  }
  return counts;
}

void check_map(const fs::path& file, std::size_t pairs) {
  const map::Document document = map::load(file);
  for (const pvs::Level level : {pvs::Level::kFast, pvs::Level::kFull}) {
    world::Settings settings;
    settings.level = level;
    settings.threads = hardware_threads();
    const world::CompiledWorld world = world::compile(document, settings);
    if (!world.visible || world.partition.tree.clusters < 2) return;
    const Counts counts = test_pairs(world, pairs);
    EXPECT_EQ(counts.hidden, 0u) << file;
    testing::Test::RecordProperty(file.stem().string(), static_cast<int>(counts.other_cluster));
  }
}

TEST(VisibilityTruth, OurOwnMaps) {
  std::size_t maps = 0;
  for (const auto& entry : fs::recursive_directory_iterator(test::source_folder() / "maps")) {
    if (entry.path().extension() != ".map") continue;
    SCOPED_TRACE(entry.path().string());
    try {
      check_map(entry.path(), test::sized<std::size_t>(2'000, 1'000'000));
      ++maps;
    } catch (const Error&) {
      continue;  // maps that are meant to be refused
    }
  }
  EXPECT_GT(maps, 0u);
}

TEST(VisibilityTruth, RealMaps) {
  HALLWAY_DATA_OR_SKIP(folder, "maps");
  for (const char* name : {"id1/dm5.map", "id1/end.map", "librequake/start.map", "librequake/lqdm2.map"}) {
    check_map(folder / name, test::sized<std::size_t>(20'000, 1'000'000));
  }
  if (!test::long_mode()) return;
  for (const char* name : {"id1/e1m1.map", "id1/e1m7.map", "id1/dm2.map", "librequake/slope.map"}) {
    check_map(folder / name, 1'000'000);
  }
}

}  // namespace
}  // namespace hallway
