// SPDX-License-Identifier: MIT
//
// bench_visibility [MAP.map] [LANDMARKS]: what point visibility costs (clusters, field of view, rays) against Embree's bare
// rtcOccluded1 on the same rays, and with the visible sets against without them, on one thread. Without a map: a house of 144
// rooms. Every figure is a median over rounds in which all contestants take turns.
#include <embree3/rtcore.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "bsp/compile.hpp"
#include "bsp/point_location.hpp"
#include "map/occupants.hpp"
#include "map/reader.hpp"
#include "pvs/compute.hpp"
#include "sense/landmarks.hpp"
#include "sense/occluders.hpp"
#include "sense/point_visibility.hpp"

namespace hallway {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kRounds = 15;
constexpr std::size_t kPoses = 100;
constexpr double kLandmarks = 100'000.0;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::string box_brush(const Vec3& low, const Vec3& high) {
  std::string text = "{\n";
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool outer : {false, true}) {
      std::array<Vec3, 3> points;
      points.fill(outer ? high : low);
      points[outer ? 2 : 1][(axis + 1) % 3] += outer ? -1.0 : 1.0;
      points[outer ? 1 : 2][(axis + 2) % 3] += outer ? -1.0 : 1.0;
      for (const Vec3& p : points) {
        text +=
            "( " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + " ) ";
      }
      text += "wall [ 1 0 0 0 ] [ 0 -1 0 0 ] 0 1 1\n";
    }
  }
  return text + "}\n";
}

/// Rooms of 8 by 8 by 3 m in a square, cut out of a block, with doors and two boxes in each.
std::string house() {
  constexpr int kSide = 12;
  constexpr double kPitch = 8.3;
  const Random random(7, stream_id("house"));
  std::string cuts;
  std::string boxes;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const Vec3 low(kPitch * i, kPitch * j, 0.0);
      const auto draw = [&](std::uint64_t n, double a, double b) {
        return random.uniform(static_cast<std::uint32_t>(i * kSide + j), n, a, b);
      };
      cuts += box_brush(low, low + Vec3(8, 8, 3));
      const Vec3 door = low + Vec3(draw(0, 1, 6), draw(1, 1, 6), 0.0);
      if (i + 1 < kSide) cuts += box_brush({low.x() + 8, door.y(), 0}, {low.x() + kPitch, door.y() + 1, 2});
      if (j + 1 < kSide) cuts += box_brush({door.x(), low.y() + 8, 0}, {door.x() + 1, low.y() + kPitch, 2});
      for (std::uint64_t k = 0; k < 2; ++k) {
        const Vec3 at = low + Vec3(draw(10 * k + 2, 1, 5), draw(10 * k + 3, 1, 5), 0.0);
        boxes += box_brush(
            at, at + Vec3(draw(10 * k + 4, 0.3, 2), draw(10 * k + 5, 0.3, 2), draw(10 * k + 6, 0.5, 2)));
      }
    }
  }
  const double size = kPitch * kSide + 1.0;
  return "{\n\"classname\" \"worldspawn\"\n\"_hallway\" \"1\"\n\"_scale\" \"1\"\n" +
         box_brush({-1, -1, -1}, {size, size, 4}) + "}\n{\n\"classname\" \"hw_subtract\"\n\"order\" \"1\"\n" +
         cuts + "}\n{\n\"classname\" \"hw_add\"\n\"order\" \"2\"\n" + boxes +
         "}\n{\n\"classname\" \"hw_robot_start\"\n\"origin\" \"0.5 0.5 0.5\"\n\"angle\" \"0\"\n}\n";
}

double inside_area(const bsp::Compiled& compiled) {
  double area = 0.0;
  for (std::size_t i = 0; i < compiled.surface.polygons.size(); ++i) {
    if (!compiled.inside[i]) continue;
    for (const auto& corner : csg::triangulate(compiled.surface, compiled.surface.polygons[i])) {
      const auto at = [&](std::size_t k) { return compiled.surface.vertices[corner[k]]; };
      area += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
    }
  }
  return area;
}

/// A map, compiled, with landmarks on all that can be seen from inside.
struct Place {
  Place(map::Document source, double landmark_count)
      : document(std::move(source)), world(map::build_world(document)) {
    std::vector<Vec3> occupants;
    for (const map::Occupant& occupant : map::occupants(document)) occupants.push_back(occupant.position_m);
    compiled = bsp::compile(world, occupants, {});
    pvs::Options options;
    options.threads = 2;
    visible = pvs::compute(compiled.portals, options);
    for (map::Entity& entity : document.entities) {
      if (entity.classname() != "worldspawn") continue;
      map::KeyValue density;
      density.key = "_points_per_m2";
      density.value = std::to_string(landmark_count / inside_area(compiled));
      entity.keys.push_back(density);
    }
    landmarks = sense::make_landmarks(document, world, compiled.surface,
                                      [&](std::size_t polygon) { return compiled.inside[polygon]; });
  }

  map::Document document;
  map::World world;
  bsp::Compiled compiled{};
  pvs::VisibleSets visible{};
  std::vector<Vec3> landmarks{};
};

/// Poses in empty space, drawn evenly.
std::vector<Pose> poses_in(const Place& place) {
  const Random random(3, stream_id("poses"));
  std::vector<Pose> poses;
  const Box& box = place.world.bounds;
  for (std::uint64_t i = 0; poses.size() < kPoses && i < 10'000'000; ++i) {
    const auto draw = [&](std::uint64_t n, double low, double high) {
      return random.uniform(0, 4 * i + n, low, high);
    };
    const Vec3 at(draw(0, box.min().x(), box.max().x()), draw(1, box.min().y(), box.max().y()),
                  draw(2, box.min().z(), box.max().z()));
    if (bsp::cluster_at(place.compiled.tree, at) < 0) continue;
    poses.push_back({from_yaw_pitch_roll(draw(3, -3.1, 3.1), 0.0, 0.0), at});
  }
  return poses;
}

/// Embree alone: its own triangles in single precision, one ray at a time.
class BareEmbree {
 public:
  explicit BareEmbree(const trace::TriangleMesh& mesh)
      : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
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
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~BareEmbree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  BareEmbree(const BareEmbree&) = delete;
  BareEmbree& operator=(const BareEmbree&) = delete;

  std::size_t count_free(const std::vector<std::pair<Vec3, Vec3>>& lines) const {
    std::size_t free = 0;
    for (const auto& [from, to] : lines) {
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      RTCRay ray{};
      const Vec3 delta = to - from;
      ray.org_x = static_cast<float>(from.x());
      ray.org_y = static_cast<float>(from.y());
      ray.org_z = static_cast<float>(from.z());
      ray.dir_x = static_cast<float>(delta.x());
      ray.dir_y = static_cast<float>(delta.y());
      ray.dir_z = static_cast<float>(delta.z());
      ray.tfar = 1.0f;
      ray.mask = ~0u;
      rtcOccluded1(scene_, &context, &ray);
      free += ray.tfar >= 0.0f ? 1 : 0;
    }
    return free;
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

/// Lines to the landmarks in view and, with an index that has visible sets, in clusters that may be seen.
std::vector<std::pair<Vec3, Vec3>> lines_of(const sense::LandmarkIndex& index, const sense::FieldOfView& view,
                                            const std::vector<Pose>& poses) {
  std::vector<std::pair<Vec3, Vec3>> lines;
  std::vector<std::uint32_t> blocks;
  for (const Pose& pose : poses) {
    const Eigen::Matrix3d to_sensor = pose.q.conjugate().toRotationMatrix();
    index.blocks_from(pose.t, blocks);
    for (const std::uint32_t b : blocks) {
      const auto& block = index.blocks()[b];
      for (const Vec3& point : index.points().subspan(block.first, block.count)) {
        if (view.contains(to_sensor * (point - pose.t))) lines.emplace_back(pose.t, point);
      }
    }
  }
  return lines;
}

void compare(const Place& place) {
  const std::vector<Pose> poses = poses_in(place);
  const sense::FieldOfView view(1.57, 1.05, 0.0, 1000.0);
  const trace::TriangleMesh mesh = sense::make_occluders(place.compiled.surface);
  const trace::Scene scene(mesh, trace::Backend::kEmbree);
  const BareEmbree bare(mesh);
  const sense::LandmarkIndex plain(place.landmarks);
  const sense::LandmarkIndex with_sets(place.landmarks, place.compiled.tree, place.visible);
  const auto few = lines_of(with_sets, view, poses);
  const auto all = lines_of(plain, view, poses);
  std::printf("%zu triangles, %zu landmarks, %u clusters, mean visible share %.3f, %zu poses\n",
              mesh.triangles.size(), place.landmarks.size(), place.visible.clusters(),
              place.visible.mean_share(), poses.size());

  std::size_t found = 0;
  const auto find = [&](const sense::LandmarkIndex& index) {
    const sense::PointVisibility visibility(view, index, scene);
    std::vector<sense::VisiblePoint> visible;
    found = 0;
    for (const Pose& pose : poses) {
      visibility.find(pose, 1, visible);
      found += visible.size();
    }
  };
  const std::vector<std::function<void()>> contestants = {
      [&] { found = bare.count_free(few); }, [&] { find(with_sets); }, [&] { found = bare.count_free(all); },
      [&] { find(plain); }};
  std::vector<std::vector<double>> times(contestants.size());
  std::vector<std::size_t> counts(contestants.size());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < contestants.size(); ++i) {
      const auto start = Clock::now();
      contestants[i]();
      times[i].push_back(seconds_since(start));
      counts[i] = found;
    }
  }
  const auto ratio = [&](std::size_t over, std::size_t under) {
    std::vector<double> ratios;
    for (int k = 0; k < kRounds; ++k) {
      ratios.push_back(times[over][static_cast<std::size_t>(k)] / times[under][static_cast<std::size_t>(k)]);
    }
    return median(ratios);
  };
  const auto line = [&](const char* name, std::size_t i, std::size_t lines) {
    std::printf("  %-44s %8.3f ms  %6.2f M rays/s  %zu seen\n", name, 1e3 * median(times[i]) / kPoses,
                1e-6 * static_cast<double>(lines) / median(times[i]), counts[i]);
  };
  std::printf("per pose, on one thread:\n");
  line("rtcOccluded1, lines that the sets leave", 0, few.size());
  line("point visibility with visible sets", 1, few.size());
  line("rtcOccluded1, all lines in view", 2, all.size());
  line("point visibility without visible sets", 3, all.size());
  std::printf("throughput against rtcOccluded1 on the same rays: %.2f with the sets, %.2f without\n",
              ratio(0, 1), ratio(2, 3));
  std::printf("with the visible sets %.1f times as fast as without\n", ratio(3, 1));
}

}  // namespace
}  // namespace hallway

int main(int argc, char** argv) {
  try {
    const double landmarks = argc > 2 ? std::stod(argv[2]) : hallway::kLandmarks;
    hallway::compare(hallway::Place(
        argc > 1 ? hallway::map::load(argv[1]) : hallway::map::parse(hallway::house(), "house.map"),
        landmarks));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
  return 0;
}
