// SPDX-License-Identifier: MIT
//
// What the exact answers of trace::Scene cost: occlusion queries in a hall of boxes by our two backends, one by one and many
// from one point, and by Embree alone with its own triangles in single precision (which decides rays near edges
// differently).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "trace/embree_library.hpp"
#include "trace/scene.hpp"

namespace hallway {
namespace {

constexpr double kHallSize_m = 50.0;

/// The six sides of a box.
void add_box(trace::TriangleMesh& mesh, const Vec3& low, const Vec3& high) {
  const auto corner = [&](int i) {
    return Vec3((i & 1) ? high.x() : low.x(), (i & 2) ? high.y() : low.y(), (i & 4) ? high.z() : low.z());
  };
  constexpr int kSides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& side : kSides) {
    Polygon polygon;
    for (const int i : side) polygon.vertices.push_back(corner(i));
    mesh.add_polygon(polygon);
  }
}

/// A hall with `boxes` boxes on its floor.
trace::TriangleMesh hall(std::int64_t boxes) {
  const Random random(1, stream_id("hall"));
  trace::TriangleMesh mesh;
  add_box(mesh, {-kHallSize_m, -kHallSize_m, -0.1}, {kHallSize_m, kHallSize_m, 0.0});
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(boxes); ++i) {
    const Vec3 low(random.uniform(0, 5 * i, -kHallSize_m, kHallSize_m),
                   random.uniform(0, 5 * i + 1, -kHallSize_m, kHallSize_m), 0);
    const Vec3 size(random.uniform(0, 5 * i + 2, 0.1, 2.0), random.uniform(0, 5 * i + 3, 0.1, 2.0),
                    random.uniform(0, 5 * i + 4, 0.5, 3.0));
    add_box(mesh, low, low + size);
  }
  return mesh;
}

/// Pairs of points in the hall, up to 20 m apart: a landmark and a viewpoint.
std::vector<std::pair<Vec3, Vec3>> segments() {
  constexpr std::uint64_t kCount = 4096;
  const Random random(2, stream_id("segments"));
  std::vector<std::pair<Vec3, Vec3>> all;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const auto draw = [&](std::uint64_t n, double low, double high) {
      return random.uniform(0, 6 * i + n, low, high);
    };
    const Vec3 from(draw(0, -kHallSize_m, kHallSize_m), draw(1, -kHallSize_m, kHallSize_m),
                    draw(2, 0.1, 3.0));
    const Vec3 to = from + Vec3(draw(3, -12.0, 12.0), draw(4, -12.0, 12.0), 0.0);
    all.emplace_back(from, Vec3(to.x(), to.y(), draw(5, 0.1, 3.0)));
  }
  return all;
}

void occluded(benchmark::State& state, trace::Backend backend) {
  const trace::Scene scene(hall(state.range(0)), backend);
  const auto pairs = segments();
  std::size_t next = 0;
  for (auto _ : state) {
    const auto& [from, to] = pairs[next++ % pairs.size()];
    benchmark::DoNotOptimize(scene.occluded(from, to));
  }
}

/// Points within 12 m of one eye after the other; neighbours follow each other, or they come as drawn.
void occluded_from(benchmark::State& state, bool neighbours_follow) {
  constexpr std::size_t kPoints = 1024;
  const trace::Scene scene(hall(state.range(0)), trace::Backend::kEmbree);
  const Random random(3, stream_id("views"));
  std::vector<Vec3> eyes;
  std::vector<std::vector<Vec3>> views;
  for (std::uint32_t i = 0; i < 32; ++i) {
    eyes.push_back({random.uniform(i, 0, -40.0, 40.0), random.uniform(i, 1, -40.0, 40.0), 1.2});
    auto& points = views.emplace_back();
    for (std::uint64_t k = 1; k <= kPoints; ++k) {
      points.push_back(eyes.back() + Vec3(random.uniform(i, 3 * k, -12.0, 12.0),
                                          random.uniform(i, 3 * k + 1, -12.0, 12.0),
                                          random.uniform(i, 3 * k + 2, -1.1, 1.5)));
    }
    if (!neighbours_follow) continue;
    std::sort(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
      const auto cell = [&](const Vec3& p) {
        return std::pair(std::floor((p.x() - eyes.back().x()) / 3.0), p.y());
      };
      return cell(a) < cell(b);
    });
  }
  std::vector<std::uint8_t> hidden(kPoints);
  std::size_t next = 0;
  for (auto _ : state) {
    const std::size_t i = next++ % eyes.size();
    scene.occluded_from(eyes[i], views[i], hidden);
    benchmark::DoNotOptimize(hidden.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kPoints));
}

void first_hit(benchmark::State& state, trace::Backend backend) {
  const trace::Scene scene(hall(state.range(0)), backend);
  const auto pairs = segments();
  std::size_t next = 0;
  for (auto _ : state) {
    const auto& [from, to] = pairs[next++ % pairs.size()];
    benchmark::DoNotOptimize(scene.first_hit({from, to - from, (to - from).norm()}));
  }
}

void embree_alone(benchmark::State& state) {
  const trace::TriangleMesh mesh = hall(state.range(0));
  const RTCDevice device = rtcNewDevice("threads=1");
  const RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  std::vector<float> vertices;
  for (const Vec3& v : mesh.vertices) {
    for (const double coordinate : v) vertices.push_back(static_cast<float>(coordinate));
  }
  void* vertex_buffer = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                3 * sizeof(float), mesh.vertices.size());
  std::memcpy(vertex_buffer, vertices.data(), vertices.size() * sizeof(float));
  void* index_buffer = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                               3 * sizeof(std::uint32_t), mesh.triangles.size());
  std::memcpy(index_buffer, mesh.triangles.data(), mesh.triangles.size() * 3 * sizeof(std::uint32_t));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);

  const auto pairs = segments();
  std::size_t next = 0;
  for (auto _ : state) {
    const auto& [from, to] = pairs[next++ % pairs.size()];
    const Eigen::Vector3f origin = from.cast<float>();
    const Eigen::Vector3f direction = (to - from).cast<float>();
    RTCRay ray{};
    ray.org_x = origin.x(), ray.org_y = origin.y(), ray.org_z = origin.z();
    ray.dir_x = direction.x(), ray.dir_y = direction.y(), ray.dir_z = direction.z();
    ray.tfar = 1.0f;
    ray.mask = ~0u;
    trace::EmbreeQuery query;
    trace::embree_occluded(scene, query, ray);
    benchmark::DoNotOptimize(ray.tfar);
  }
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
}

BENCHMARK_CAPTURE(occluded, embree_tree, trace::Backend::kEmbree)->Arg(100)->Arg(2000)->Arg(20000);
BENCHMARK(embree_alone)->Name("occluded/embree_alone")->Arg(100)->Arg(2000)->Arg(20000);
BENCHMARK_CAPTURE(occluded_from, neighbours, true)->Arg(100)->Arg(2000)->Arg(20000);
BENCHMARK_CAPTURE(occluded_from, as_drawn, false)->Arg(100)->Arg(2000)->Arg(20000);
BENCHMARK_CAPTURE(occluded, brute_force, trace::Backend::kBruteForce)->Arg(100)->Arg(2000);
BENCHMARK_CAPTURE(first_hit, embree_tree, trace::Backend::kEmbree)->Arg(100)->Arg(2000)->Arg(20000);

}  // namespace
}  // namespace hallway

BENCHMARK_MAIN();
