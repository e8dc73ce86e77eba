// SPDX-License-Identifier: MIT
// What the point mapper takes as its life and its map grow: time and memory on a circle driven round and round, which it knows after the first lap;
// then on a road that never returns, until the map has as many landmarks as asked for. Times are of the thread's CPU, as ratios to the first row.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "../tests/unit/slam_point/scenes.hpp"
#include "growth.hpp"
#include "slam_point/core/mapper.hpp"

namespace {

using namespace hallway::slam_point;
using hallway::Mat3;
using hallway::Pose;
using hallway::Vec3;
using hallway::bench::cpu_us;
using hallway::bench::GrowthTable;
using hallway::bench::resident_mb;

constexpr double kStep_m = 0.3;    // of an iteration
constexpr double kPer100m = 25.0;  // landmarks along the path
constexpr double kReach_m =
    130.0;  // farthest from the sensor, along the path, that a landmark in view stands
constexpr std::size_t kWindow = 3000;  // iterations that a row's figures are of

/// A wavy road in blocks of landmarks made when they are needed, so that any length takes no memory; or a circle of it.
class Road {
 public:
  /// `lap_m`: after which it returns to its beginning; 0: never.
  explicit Road(double lap_m) : lap_(lap_m), noise_(1) {}

  Pose pose(std::uint64_t step) const {
    const double s = kStep_m * static_cast<double>(step);
    const Vec3 ahead = place(s + 0.5) - place(s - 0.5);
    return scenes::heading(place(s), std::atan2(ahead.y(), ahead.x()));
  }

  const std::vector<Vec3>& see(std::uint64_t step) {
    const double s = kStep_m * static_cast<double>(step);
    const Pose T = pose(step);
    const Pose inverse = T.inverse();
    points_.clear();
    const auto first = static_cast<std::int64_t>(std::floor((s - kReach_m) / kBlock_m));
    const auto last = static_cast<std::int64_t>(std::floor((s + kReach_m) / kBlock_m));
    for (std::int64_t block = first; block <= last; ++block) {
      scenes::Random random(1 + 2 * static_cast<std::uint64_t>(named(block)));
      for (int i = 0; i < static_cast<int>(kPer100m * kBlock_m / 100.0); ++i) {
        const double at = kBlock_m * (static_cast<double>(block) + random.uniform(0.0, 1.0));
        const Vec3 beside(0.0, random.uniform(-15.0, 15.0), random.uniform(-5.0, 5.0));
        const Vec3 p = inverse * (place(at) + beside);
        if (p.norm() > 100.0 || std::abs(std::atan2(p.y(), p.x())) > std::numbers::pi / 4.0 ||
            std::abs(std::atan2(p.z(), std::hypot(p.x(), p.y()))) > std::numbers::pi / 6.0)
          continue;
        points_.push_back(p + 0.05 * Vec3(noise_.normal(), noise_.normal(), noise_.normal()));
      }
    }
    return points_;
  }

 private:
  static constexpr double kBlock_m = 20.0;

  Vec3 place(double s) const {
    if (lap_ <= 0.0) return {s, 30.0 * std::sin(s / 120.0), 0.0};
    const double angle = 2.0 * std::numbers::pi * s / lap_;
    const double radius = lap_ / (2.0 * std::numbers::pi);
    return {radius * std::sin(angle), radius * (1.0 - std::cos(angle)), 0.0};
  }

  std::int64_t named(std::int64_t block) const {
    if (lap_ <= 0.0) return block + 1000;
    const auto blocks = static_cast<std::int64_t>(std::lround(lap_ / kBlock_m));
    return ((block % blocks) + blocks) % blocks;
  }

  double lap_;
  scenes::Random noise_;
  std::vector<Vec3> points_;
};

/// Drives, and prints a row after each of `rows`, of its last iterations: whenever `size`, of the mapper's counters, reaches it.
template <typename Size>
void drive(const char* what, double lap_m, const std::vector<double>& rows, Size&& size) {
  const double before_mb = resident_mb();
  GrowthTable table(what, {"iterations", "landmarks"}, {"MB", "B/landm."});
  Road road(lap_m);
  Mapper mapper{Options()};
  std::vector<double> times(kWindow, 0.0);
  std::vector<double> visible(kWindow, 0.0);
  std::uint64_t step = 0;
  for (const double row : rows) {
    Counters counters;
    do {
      const std::vector<Vec3>& points = road.see(step);
      const double start = cpu_us();
      counters = mapper.process(points).counters;
      times[step % kWindow] = cpu_us() - start;
      visible[step % kWindow] = static_cast<double>(points.size());
      ++step;
    } while (size(counters) < row || step < kWindow);
    const double mb = resident_mb() - before_mb;
    const auto landmarks = static_cast<double>(counters.landmarks);
    table.row(std::array{static_cast<double>(step), landmarks},
              {times, visible, static_cast<double>(counters.lost)}, std::array{mb, 1e6 * mb / landmarks});
  }
}

}  // namespace

/// The most landmarks and the most iterations, or 1e6 of each.
int main(int argc, char** argv) {
  const double most_landmarks = argc > 1 ? std::strtod(argv[1], nullptr) : 1e6;
  const double most_iterations = argc > 2 ? std::strtod(argv[2], nullptr) : 1e6;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const auto up_to = [](double most) {
    std::vector<double> rows;
    for (double row = 1e3; row < 1.0001 * most; row *= 10.0) rows.push_back(row);
    return rows;
  };
  std::vector<double> rows = up_to(most_iterations);
  rows.erase(rows.begin());
  drive("round a circle of 1200 m, last 3000 iterations of a row", 1200.0, rows,
        [](const Counters& c) { return static_cast<double>(c.iterations); });
  drive("new ground, last 3000 iterations of a row", 0.0, up_to(most_landmarks),
        [](const Counters& c) { return static_cast<double>(c.landmarks); });
}
