// SPDX-License-Identifier: MIT
// Compiles maps and says what each stage takes: medians of several runs on one thread, visibility on one and on two. Where the same map compiled by
// another program is given, compares how much of it each calls visible, over random pairs of points.
//
//   bench_compile [--runs N] [--pairs N] MAP[=FILE.bsp]...
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "base/text.hpp"
#include "bsp/point_location.hpp"
#include "map/reader.hpp"
#include "pvs/compute.hpp"
#include "quake_bsp.hpp"
#include "world/compiled_world.hpp"

namespace hallway::bench {
namespace {

double seconds_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Shares of pairs of empty points that the two call visible.
void compare_visibility(const world::CompiledWorld& world, const std::string& bsp_file, std::size_t pairs) {
  const QuakeBsp reference(bsp_file);
  const std::size_t leaves = reference.leaves();
  const bsp::Tree& tree = world.partition.tree;
  const Random random(1, stream_id("bench.compile"));
  struct Place {
    std::uint32_t cluster;
    std::int32_t leaf;
  };
  std::vector<Place> places;
  for (std::uint32_t step = 0; places.size() < 2 * pairs; ++step) {
    Vec3 point;
    for (int axis = 0; axis < 3; ++axis) {
      point[axis] = random.uniform(step, static_cast<std::uint64_t>(axis), tree.bounds.min()[axis],
                                   tree.bounds.max()[axis]);
    }
    const std::int32_t cluster = bsp::cluster_at(tree, point);
    if (cluster < 0) continue;
    const std::int32_t leaf = reference.leaf_at(point / world.brushes.metres_per_unit);
    if (reference.is_empty(leaf)) places.push_back({static_cast<std::uint32_t>(cluster), leaf});
  }
  std::map<std::int32_t, std::vector<bool>> rows;
  std::vector<std::vector<bool>> own(tree.clusters);
  std::size_t ours = 0, theirs = 0, only_ours = 0, only_theirs = 0;
  for (std::size_t i = 0; i < pairs; ++i) {
    const Place& a = places[2 * i];
    const Place& b = places[2 * i + 1];
    std::vector<bool>& row = rows[a.leaf];
    if (row.empty()) row = reference.visible_from(a.leaf, leaves);
    std::vector<bool>& own_row = own[a.cluster];
    if (own_row.empty()) {
      own_row.assign(tree.clusters, false);
      for (const std::uint32_t c : world.visible->visible_from(a.cluster)) own_row[c] = true;
    }
    const bool we = own_row[b.cluster];
    const bool they = a.leaf == b.leaf || row[static_cast<std::size_t>(b.leaf)];
    ours += we;
    theirs += they;
    only_ours += we && !they;
    only_theirs += they && !we;
  }
  const auto percent = [&](std::size_t n) {
    return 100.0 * static_cast<double>(n) / static_cast<double>(pairs);
  };
  std::printf(
      "  visible of %zu random pairs: %.2f %%, in %s %.2f %%, ratio %.3f (only here %.2f %%, only there %.2f "
      "%%)\n",
      pairs, percent(ours), bsp_file.c_str(), percent(theirs),
      static_cast<double>(ours) / static_cast<double>(theirs), percent(only_ours), percent(only_theirs));
}

void run(const std::string& map_file, const std::string& bsp_file, std::size_t runs, std::size_t pairs) {
  std::vector<double> load, partition, one, two;
  std::optional<world::CompiledWorld> world;
  for (std::size_t i = 0; i < runs; ++i) {
    std::optional<map::Document> document;
    load.push_back(seconds_of([&] { document = map::load(map_file); }));
    world::Settings settings;
    settings.level = std::nullopt;
    partition.push_back(seconds_of([&] { world = world::compile(*document, settings); }));
    if (!world->sealed()) continue;
    one.push_back(seconds_of([&] {
      world->visible = pvs::compute(world->partition.portals, {pvs::Level::kFull, 1, {}});
    }));
    two.push_back(seconds_of([&] { pvs::compute(world->partition.portals, {pvs::Level::kFull, 2, {}}); }));
  }
  const bsp::Compiled& result = world->partition;
  std::printf("%s\n  brushes %zu, polygons %zu, leaves %zu, clusters %u, portals %zu\n", map_file.c_str(),
              world->brushes.solids.size(), result.surface.polygons.size(), result.tree.leaves.size(),
              result.tree.clusters, result.portals.portals.size());
  std::printf("  load %.3f s, brushes to portals %.3f s", median(load), median(partition));
  if (one.empty()) {
    std::printf("; it leaks\n");
    return;
  }
  std::printf("; visibility %.3f s on one thread, %.3f s on two, ratio %.2f; mean visible share %.3f\n",
              median(one), median(two), median(one) / median(two), world->visible->mean_share());
  if (!bsp_file.empty()) compare_visibility(*world, bsp_file, pairs);
}

}  // namespace
}  // namespace hallway::bench

int main(int argc, char** argv) {
  std::size_t runs = 3;
  std::size_t pairs = 1'000'000;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--runs" && i + 1 < argc) {
      runs = hallway::parse_uint(argv[++i]).value_or(runs);
    } else if (argument == "--pairs" && i + 1 < argc) {
      pairs = hallway::parse_uint(argv[++i]).value_or(pairs);
    } else {
      const std::size_t split = argument.find('=');
      const std::string bsp = split == std::string::npos ? "" : argument.substr(split + 1);
      try {
        hallway::bench::run(argument.substr(0, split), bsp, runs, pairs);
      } catch (const std::exception& failure) {
        std::fprintf(stderr, "%s\n", failure.what());
        return 3;
      }
    }
  }
  return 0;
}
