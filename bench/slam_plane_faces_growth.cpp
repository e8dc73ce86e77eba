// SPDX-License-Identifier: MIT
// What the mapper of faces (slam_plane with dof=6) takes as more faces are in view and as its map grows. Times are of the thread's CPU, iteration by iteration
// the least of several identical runs.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <span>
#include <vector>

#include "base/random.hpp"
#include "growth.hpp"
#include "slam_plane/spatial/mapper.hpp"

namespace {

using namespace hallway::slam_plane::spatial;
using hallway::Pose;
using hallway::Quat;
using hallway::rotation_by;
using hallway::Vec3;
using hallway::bench::cpu_us;
using hallway::bench::GrowthTable;
using hallway::bench::mean_of;
using hallway::slam_plane::Noise;
using hallway::slam_plane::Options;

constexpr int kRuns = 3;
constexpr double kStep_m = 0.1;
constexpr double kRange_m = 10.0;       // depth
constexpr double kRoad_m = 3.0;         // half of the width and height of where panels hang
constexpr double kLeastArea_m2 = 0.02;  // smaller parts are not told

/// A way through panels that hang about it, at equal steps, turned as chance will have it, made when they are needed. Nothing hides anything, so that the
/// number in view is what the steps say.
class Way {
 public:
  /// `visible`: faces in view, about.
  explicit Way(double visible)
      // Of the panels within range half turn their face to the robot, and the nearest ones are beside the view.
      : random_(1, hallway::stream_id("bench.slam_plane_faces_growth")), per_m_(2.5 * visible / kRange_m) {}

  double faces_per_m() const { return per_m_; }

  const std::vector<PlaneObservation>& see(std::uint32_t step) {
    const double s = kStep_m * static_cast<double>(step);
    const double sway = 0.2 * std::sin(0.3 * s);
    const Pose T{rotation_by(Vec3(0.5 * sway, 0.3 * sway, sway)), Vec3(s, sway, 0.5 * sway)};
    faces_.clear();
    const auto first = static_cast<std::int64_t>(std::ceil(s * per_m_));
    const auto last = static_cast<std::int64_t>(std::floor((s + kRange_m) * per_m_));
    for (std::int64_t i = first; i <= last; ++i) tell(static_cast<std::uint32_t>(i), T.inverse(), step);
    return faces_;
  }

 private:
  struct Panel {
    Vec3 normal;
    std::vector<Vec3> corners;
  };

  Panel panel(std::uint32_t key) const {
    const double x = static_cast<double>(key) / per_m_;
    const double round = random_.uniform(key, 0, 0.0, 2.0 * std::numbers::pi);
    const double away = random_.uniform(key, 1, 0.4, 1.0) * kRoad_m;
    const Vec3 middle(x, away * std::cos(round), away * std::sin(round));
    const Vec3 normal = Vec3(random_.uniform(key, 2, -1.0, 1.0), random_.uniform(key, 3, -1.0, 1.0),
                             random_.uniform(key, 4, -1.0, 1.0))
                            .normalized();
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    const double a = random_.uniform(key, 5, 0.3, 0.7), b = random_.uniform(key, 6, 0.3, 0.7);
    return {normal,
            {middle - a * u - b * v, middle + a * u - b * v, middle + a * u + b * v, middle - a * u + b * v}};
  }

  /// What of a panel is within 45 degrees of the way ahead, with noise.
  void tell(std::uint32_t key, const Pose& T_robot_world, std::uint32_t step) {
    Panel of = panel(key);
    const Vec3 normal = T_robot_world.q * of.normal;
    for (Vec3& p : of.corners) p = T_robot_world * p;
    if (normal.dot(of.corners.front()) > -0.05) return;
    for (const Vec3& inward : {Vec3(1, 1, 0), Vec3(1, -1, 0), Vec3(1, 0, 1), Vec3(1, 0, -1)})
      clip(of.corners, inward);
    if (of.corners.size() < 3) return;
    Vec3 middle = Vec3::Zero(), area = Vec3::Zero();
    for (const Vec3& p : of.corners) middle += p / static_cast<double>(of.corners.size());
    for (std::size_t i = 0; i < of.corners.size(); ++i)
      area += 0.5 * (of.corners[i] - middle).cross(of.corners[(i + 1) % of.corners.size()] - middle);
    if (area.norm() < kLeastArea_m2) return;
    const Noise noise = Options{}.noise();
    const std::uint64_t stream = 64 * static_cast<std::uint64_t>(key);
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    const Quat tilt = rotation_by(
        noise.angle * (random_.normal(step, stream + 8) * u + random_.normal(step, stream + 9) * v));
    const Vec3 shift = noise.normal * random_.normal(step, stream + 10) * normal;
    PlaneObservation& face = faces_.emplace_back();
    face.normal = tilt * normal;
    face.centre = middle + shift;
    for (std::size_t i = 0; i < of.corners.size(); ++i) {
      const std::uint64_t at = stream + 12 + 2 * i;
      const Vec3 moved = noise.end * (random_.normal(step, at) * u + random_.normal(step, at + 1) * v);
      face.outline.push_back(face.centre + tilt * (of.corners[i] + moved - middle));
    }
  }

  /// Keeps what of a polygon lies where inward . p >= 0.
  static void clip(std::vector<Vec3>& polygon, const Vec3& inward) {
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double fa = inward.dot(a), fb = inward.dot(b);
      if (fa >= 0.0) kept.push_back(a);
      if ((fa < 0.0) != (fb < 0.0)) kept.push_back(a + fa / (fa - fb) * (b - a));
    }
    polygon = std::move(kept);
  }

  hallway::Random random_;
  double per_m_;
  std::vector<PlaneObservation> faces_;
};

struct Drive {
  std::vector<double> us;       // by iteration, the least of all runs
  std::vector<double> visible;  // likewise
  std::vector<double> faces;    // in the map
  Counters counters;
};

Drive drive(double visible, std::size_t steps) {
  Drive result;
  result.us.assign(steps, 1e300);
  result.visible.assign(steps, 0.0);
  result.faces.assign(steps, 0.0);
  const View view{0.5 * std::numbers::pi, 0.5 * std::numbers::pi, 0.0, kRange_m, false};
  for (int run = 0; run < kRuns; ++run) {
    Way way(visible);
    Mapper mapper{Options()};
    for (std::size_t i = 0; i < steps; ++i) {
      const std::vector<PlaneObservation>& faces = way.see(static_cast<std::uint32_t>(i));
      const double start = cpu_us();
      result.counters = mapper.process(faces, view).counters;
      result.us[i] = std::min(result.us[i], cpu_us() - start);
      result.visible[i] = static_cast<double>(faces.size());
      result.faces[i] = static_cast<double>(result.counters.landmarks);
    }
  }
  return result;
}

void print_row(GrowthTable& table, double asked, const Drive& drive, std::size_t first, std::size_t last) {
  const auto part = [&](const std::vector<double>& values) {
    return std::span(values).subspan(first, last - first);
  };
  table.row(std::array{asked, drive.faces[last - 1], static_cast<double>(drive.counters.submaps)},
            {part(drive.us), part(drive.visible), static_cast<double>(drive.counters.lost)});
}

const GrowthTable::Names kSizes{"asked", "faces", "submaps"};

void by_faces_in_view() {
  GrowthTable table("faces in view, on a way that never returns", kSizes);
  for (const double visible : {5.0, 10.0, 20.0, 40.0})
    print_row(table, visible, drive(visible, 600), 200, 600);
}

/// On new ground, where nothing but what is looked for in the map grows with it.
void by_map_size(double most) {
  GrowthTable table("map size, on new ground: 300 iterations with so many faces mapped", kSizes);
  const auto steps = static_cast<std::size_t>(1.2 * most / Way(10.0).faces_per_m() / kStep_m);
  const Drive d = drive(10.0, steps);
  for (const double faces : {50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 5000.0}) {
    const auto at =
        static_cast<std::size_t>(std::lower_bound(d.faces.begin(), d.faces.end(), faces) - d.faces.begin());
    if (faces > most || at + 300 > steps) break;
    print_row(table, faces, d, at, at + 300);
  }
}

}  // namespace

/// The most faces of a map, or 5000.
int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  by_faces_in_view();
  by_map_size(argc > 1 ? std::strtod(argv[1], nullptr) : 5000.0);
}
