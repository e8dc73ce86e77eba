// SPDX-License-Identifier: MIT
//
// What queries of the BSP cost on a hall of 10 000 brushes: segments beside trace::Scene::occluded() on the same segments, and bodies
// that are moved. Everything is measured in turns within one run; the figures are medians over the rounds.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "bsp/compile.hpp"
#include "bsp/point_location.hpp"
#include "bsp/segment.hpp"
#include "bsp/slide.hpp"
#include "bsp/sweep.hpp"
#include "map/document.hpp"
#include "map/world.hpp"
#include "trace/scene.hpp"

namespace hallway {
namespace {

constexpr double kHalfSize_m = 100.0;
constexpr double kHeight_m = 12.0;
constexpr double kUnitsPerMetre = 32.0;
constexpr int kRounds = 7;

using Segment = std::pair<Vec3, Vec3>;

/// A brush between a quadrilateral and the same one displaced by `up`; counter-clockwise as seen from the end of `up`.
map::Brush slab(const std::vector<Vec3>& low, const Vec3& up) {
  const auto face = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    map::Face result;
    result.material = "wall";
    result.points = {c * kUnitsPerMetre, b * kUnitsPerMetre, a * kUnitsPerMetre};
    return result;
  };
  map::Brush brush;
  const std::size_t n = low.size();
  brush.faces.push_back(face(low[2], low[1], low[0]));
  brush.faces.push_back(face(low[0] + up, low[1] + up, low[2] + up));
  for (std::size_t i = 0; i < n; ++i) brush.faces.push_back(face(low[i], low[(i + 1) % n], low[i] + up));
  return brush;
}

map::Brush box(const Vec3& a, const Vec3& b) {
  return slab({a, {b.x(), a.y(), a.z()}, {b.x(), b.y(), a.z()}, {a.x(), b.y(), a.z()}},
              {0.0, 0.0, b.z() - a.z()});
}

void add_shell(std::vector<map::Brush>& brushes) {
  constexpr double s = kHalfSize_m, t = 1.0, h = kHeight_m;
  brushes.push_back(box({-s, -s, -t}, {s, s, 0}));
  brushes.push_back(box({-s, -s, h}, {s, s, h + t}));
  brushes.push_back(box({-s - t, -s, 0}, {-s, s, h}));
  brushes.push_back(box({s, -s, 0}, {s + t, s, h}));
  brushes.push_back(box({-s, -s - t, 0}, {s, -s, h}));
  brushes.push_back(box({-s, s, 0}, {s, s + t, h}));
}

/// 500 pillars, 500 slanting roof slabs, the rest crates, on a grid of 1/32 m.
std::vector<map::Brush> hall(std::uint32_t count) {
  std::vector<map::Brush> brushes;
  add_shell(brushes);
  const Random random(1, stream_id("bsp hall"));
  for (std::uint32_t i = 0; brushes.size() < count; ++i) {
    const auto draw = [&](std::uint64_t n, double low, double high) {
      return std::round(random.uniform(i, n, low, high) * kUnitsPerMetre) / kUnitsPerMetre;
    };
    const Vec3 at(draw(0, 1 - kHalfSize_m, kHalfSize_m - 6), draw(1, 1 - kHalfSize_m, kHalfSize_m - 6), 0.0);
    if (i % 20 == 0) {
      brushes.push_back(box(at, at + Vec3(0.5, 0.5, kHeight_m)));
    } else if (i % 20 == 1) {
      const double low = draw(2, 7, 9), high = low + draw(3, 0.5, 2);
      const double length = draw(4, 2, 5), width = draw(5, 2, 5);
      brushes.push_back(slab({{at.x(), at.y(), low},
                              {at.x() + length, at.y(), high},
                              {at.x() + length, at.y() + width, high},
                              {at.x(), at.y() + width, low}},
                             {0.0, 0.0, 0.25}));
    } else {
      brushes.push_back(box(at, at + Vec3(draw(2, 0.25, 1.5), draw(3, 0.25, 1.5), draw(4, 0.25, 2.5))));
    }
  }
  return brushes;
}

map::World make_world(std::uint32_t count) {
  map::Document document;
  document.entities.emplace_back();
  document.entities[0].add("classname", "worldspawn");
  document.entities[0].brushes = hall(count);
  return map::build_world(document);
}

/// From empty places; a third of them up to 3 m long, a third up to 20 m, a third across the hall.
std::vector<Segment> segments(const bsp::Tree& tree, std::size_t count) {
  const Random random(2, stream_id("bsp segments"));
  std::vector<Segment> all;
  for (std::uint32_t i = 0; all.size() < count; ++i) {
    const auto place = [&](std::uint64_t n) {
      return Vec3(random.uniform(i, n, -kHalfSize_m, kHalfSize_m),
                  random.uniform(i, n + 1, -kHalfSize_m, kHalfSize_m),
                  random.uniform(i, n + 2, 0.05, kHeight_m));
    };
    const Vec3 from = place(0);
    if (tree.leaves[bsp::leaf_at(tree, from)].content == bsp::Content::kSolid) continue;
    Vec3 to = place(3);
    const double longest = i % 3 == 0 ? 3.0 : i % 3 == 1 ? 20.0 : 1e9;
    const double length = (to - from).norm();
    to = from + (to - from) * (std::min(longest, length) / length);
    all.emplace_back(from, to);
  }
  return all;
}

trace::TriangleMesh mesh_of(const csg::Surface& surface) {
  trace::TriangleMesh mesh;
  mesh.vertices = surface.vertices;
  for (const csg::SurfacePolygon& polygon : surface.polygons) {
    for (const auto& triangle : csg::triangulate(surface, polygon)) mesh.triangles.push_back(triangle);
  }
  return mesh;
}

/// One thing that is measured: what it does with a segment, as a count.
struct Case {
  std::string name;
  std::size_t segments;  ///< how many of them it gets
  std::function<std::size_t(const Segment&)> ask;
  std::vector<double> ns{};
  std::size_t answer = 0;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Processor time, which other programs on the machine disturb less than they do the time of day.
double seconds_of(const std::function<void()>& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

void measure(std::vector<Case>& cases, const std::vector<Segment>& all) {
  for (int round = 0; round < kRounds; ++round) {
    for (Case& one : cases) {
      std::size_t sum = 0;
      const double seconds = seconds_of([&] {
        for (std::size_t i = 0; i < one.segments; ++i) sum += one.ask(all[i]);
      });
      one.ns.push_back(1e9 * seconds / static_cast<double>(one.segments));
      one.answer = sum;
    }
  }
}

void run() {
  const map::World world = make_world(10000);
  bsp::Compiled compiled;
  const double seconds = seconds_of([&] { compiled = bsp::compile(world, {{0.0, 0.0, 6.0}}, {}); });
  const bsp::Tree& tree = compiled.tree;
  const csg::Surface& surface = compiled.surface;
  std::printf("%zu brushes (%zu problems), %s; compiled in %.2f s: %zu polygons, %zu nodes, %zu leaves\n",
              world.solids.size(), world.problems.size(), compiled.enclosure.sealed ? "sealed" : "open",
              seconds, surface.polygons.size(), tree.nodes.size(), tree.leaves.size());
  const trace::Scene scene(mesh_of(surface), trace::Backend::kEmbree);
  const auto all = segments(tree, 100000);
  const bsp::Body cylinder = bsp::Cylinder{0.3, 0.0, 1.0};
  const bsp::Body carton = bsp::UprightBox{0.4, 0.3, 0.5, 0.0, 1.0};
  std::vector<Case> cases{
      {"trace::Scene::occluded", all.size(),
       [&](const Segment& s) { return std::size_t{scene.occluded(s.first, s.second)}; }},
      {"bsp::blocked", all.size(),
       [&](const Segment& s) { return std::size_t{bsp::blocked(tree, s.first, s.second)}; }},
      {"bsp::first_solid", all.size(),
       [&](const Segment& s) { return std::size_t{bsp::first_solid(tree, s.first, s.second).has_value()}; }},
      {"bsp::sweep_sphere 0.2 m", 10000,
       [&](const Segment& s) {
         return std::size_t{bsp::sweep_sphere(tree, surface, s.first, s.second, 0.2).contact.has_value()};
       }},
      {"bsp::sweep_body box", 10000,
       [&](const Segment& s) {
         return std::size_t{bsp::sweep_body(tree, surface, s.first, s.second, carton).contact.has_value()};
       }},
      {"bsp::sweep_body cylinder", 10000,
       [&](const Segment& s) {
         return std::size_t{bsp::sweep_body(tree, surface, s.first, s.second, cylinder).contact.has_value()};
       }},
      {"bsp::slide cylinder", 2000,
       [&](const Segment& s) {
         return bsp::slide(tree, surface, s.first, s.second, cylinder).contacts.size();
       }},
  };
  measure(cases, all);
  const double reference = median(cases[0].ns);
  std::printf("%-26s %10s %10s %10s\n", "median of rounds", "ns each", "speed of occluded", "blocked");
  for (const Case& one : cases) {
    std::printf("%-26s %10.0f %16.2fx %10.3f\n", one.name.c_str(), median(one.ns), reference / median(one.ns),
                static_cast<double>(one.answer) / static_cast<double>(one.segments));
  }
}

}  // namespace
}  // namespace hallway

int main() {
  hallway::run();
}
