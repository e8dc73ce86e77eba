// SPDX-License-Identifier: MIT
// What the point mapper's iterations cost beside the least that any such algorithm must do, by points in view, by stage and by the structure that finds
// points near a place. Times are the least of several identical runs, iteration by iteration; references are measured in the same run.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <string>
#include <vector>

#include "../tests/unit/slam_point/scenes.hpp"
#include "slam_point/core/index/point_index.hpp"
#include "slam_point/core/mapper.hpp"

namespace {

using namespace hallway::slam_point;
using hallway::Mat3;
using hallway::Pose;
using hallway::Vec3;

constexpr int kRuns = 5;
constexpr int kFrames = 200;
constexpr int kSettled = 20;  // iterations left out: the map begins

struct Scene {
  scenes::Log log;
  double visible = 0.0;
};

Scene scene_of(double per_100m) {
  Scene scene;
  // The noise is small so that the densest scene still has its points farther apart than they err.
  scenes::Sensor sensor;
  sensor.noise_m = 0.02;
  scenes::Random random(1);
  scene.log.poses =
      scenes::follow(kFrames, [](double s) { return Vec3(0.3 * s, 30.0 * std::sin(s / 400.0), 0.0); });
  const double length_100m = (0.3 * kFrames + 120.0) / 100.0;  // with what lies beyond either end
  scenes::scatter(scene.log, static_cast<int>(length_100m * per_100m), random);
  scenes::observe(scene.log, sensor, random);
  for (const auto& frame : scene.log.frames) scene.visible += static_cast<double>(frame.size()) / kFrames;
  return scene;
}

Options options_for(IndexKind index) {
  Options options;
  options.noise_m = 0.02;
  options.match_bound_m = 0.6;  // the sensor moves 0.3 m an iteration
  options.map_bound_m = 0.8;
  options.index = static_cast<int>(index);
  return options;
}

std::vector<std::vector<Vec3>> points_of(const scenes::Log& log) {
  std::vector<std::vector<Vec3>> frames;
  for (const auto& seen : log.frames) {
    frames.emplace_back();
    for (const auto& s : seen) frames.back().push_back(s.point);
  }
  return frames;
}

double now_us() {
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin() + kSettled, values.end(), 0.0) /
         static_cast<double>(values.size() - kSettled);
}

/// Lowers each iteration's time in `least` to that of this run, which calls frame(i) for each.
template <typename Frame>
void time_frames(std::vector<double>& least, Frame&& frame) {
  least.resize(kFrames, 1e300);
  for (std::size_t i = 0; i < kFrames; ++i) {
    const double start = now_us();
    frame(i);
    least[i] = std::min(least[i], now_us() - start);
  }
}

/// Poses given and all landmarks known: each point is transformed, its nearest landmark is looked for within the bound, and averaged in [us an iteration].
double floor_us(const Scene& scene, IndexKind kind) {
  const auto frames = points_of(scene.log);
  const double bound = options_for(kind).match_bound();
  std::vector<double> least;
  for (int run = 0; run < kRuns; ++run) {
    PointIndex index(kind, bound);
    std::vector<Vec3> means = scene.log.landmarks;
    std::vector<double> counts(means.size(), 1.0);
    for (const Vec3& mean : means) index.add(mean);
    time_frames(least, [&](std::size_t i) {
      const Mat3 rotation = scene.log.poses[i].q.toRotationMatrix();
      for (const Vec3& point : frames[i]) {
        const Vec3 p = rotation * point + scene.log.poses[i].t;
        double nearest2 = bound * bound;
        std::uint32_t nearest = 0xffffffffu;
        index.visit_near(p, [&](std::uint32_t l) {
          const double d2 = (means[l] - p).squaredNorm();
          if (d2 < nearest2) {
            nearest2 = d2;
            nearest = l;
          }
        });
        if (nearest == 0xffffffffu) continue;
        counts[nearest] += 1.0;
        means[nearest] += (p - means[nearest]) / counts[nearest];
        index.move(nearest, means[nearest]);
      }
    });
  }
  return mean_of(least);
}

struct Cost {
  double mean_us = 0.0;
  double p99_us = 0.0;
  double worst_us = 0.0;
  std::uint64_t lost = 0;
  StageTimes stages{};  // means
};

Cost mapper_cost(const Scene& scene, IndexKind kind) {
  const auto frames = points_of(scene.log);
  std::vector<double> least;
  std::vector<StageTimes> least_stages;
  Cost cost;
  for (int run = 0; run < kRuns; ++run) {
    Mapper mapper(options_for(kind));
    time_frames(least, [&](std::size_t i) { cost.lost = mapper.process(frames[i]).counters.lost; });
    // Reading the clock between stages costs some tenths of a microsecond, so that the whole is timed without.
    Mapper staged(options_for(kind));
    StageTimes times{};
    staged.time_stages(&times);
    StageTimes none;
    none.fill(1e300);
    least_stages.resize(frames.size(), none);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      times.fill(0.0);
      staged.process(frames[i]);
      for (std::size_t s = 0; s < kStages; ++s) least_stages[i][s] = std::min(least_stages[i][s], times[s]);
    }
  }
  for (std::size_t i = kSettled; i < frames.size(); ++i) {
    for (std::size_t s = 0; s < kStages; ++s)
      cost.stages[s] += least_stages[i][s] / static_cast<double>(frames.size() - kSettled);
  }
  cost.mean_us = mean_of(least);
  std::sort(least.begin(), least.end());
  cost.p99_us = least[least.size() * 99 / 100];
  cost.worst_us = least.back();
  return cost;
}

double total(const StageTimes& times) {
  return std::accumulate(times.begin(), times.end(), 0.0);
}

}  // namespace

/// Densities (landmarks along 100 m of path, of which about four fifths are in view) as arguments, or those with 25 to 5000 points in view.
int main(int argc, char** argv) {
  std::vector<double> densities{32, 134, 310, 670, 1900, 6250};
  if (argc > 1) {
    densities.clear();
    for (int i = 1; i < argc; ++i) densities.push_back(std::strtod(argv[i], nullptr));
  }
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  std::vector<Scene> scenes;
  for (const double density : densities) scenes.push_back(scene_of(density));

  std::printf("slam_point, us an iteration; floor: transform, match and average alone\n");
  std::printf("%8s %8s %8s %8s %8s %8s %6s |", "visible", "mean", "p99", "worst", "floor", "/floor", "lost");
  for (const char* name : kStageNames) std::printf(" %9s", name);
  std::printf("\n");
  std::vector<double> means;
  for (const Scene& scene : scenes) {
    const Cost cost = mapper_cost(scene, IndexKind::grid);
    const double floor = floor_us(scene, IndexKind::grid);
    means.push_back(cost.mean_us);
    std::printf("%8.0f %8.1f %8.1f %8.1f %8.2f %8.2f %6d |", scene.visible, cost.mean_us, cost.p99_us,
                cost.worst_us, floor, cost.mean_us / floor, static_cast<int>(cost.lost));
    for (const double stage : cost.stages) std::printf(" %8.1f%%", 100.0 * stage / total(cost.stages));
    std::printf("\n");
  }
  if (scenes.size() > 1) {
    std::printf(
        "growth from %.0f to %.0f in view: exponent %.2f\n", scenes.front().visible, scenes.back().visible,
        std::log(means.back() / means.front()) / std::log(scenes.back().visible / scenes.front().visible));
  }

  std::printf("\nindex: us an iteration as a ratio to grid, of the floor and of the whole\n%8s", "visible");
  for (const char* name : kIndexNames) std::printf(" %9s %9s", name, "whole");
  std::printf("\n");
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    std::printf("%8.0f", scenes[s].visible);
    double grid_floor = 0.0;
    double grid_mean = 0.0;
    for (const IndexKind kind :
         {IndexKind::grid, IndexKind::quadtree, IndexKind::octree, IndexKind::kdtree}) {
      const double floor = floor_us(scenes[s], kind);
      const double mean = mapper_cost(scenes[s], kind).mean_us;
      if (kind == IndexKind::grid) grid_floor = floor, grid_mean = mean;
      std::printf(" %9.2f %9.2f", floor / grid_floor, mean / grid_mean);
    }
    std::printf("\n");
  }
}
