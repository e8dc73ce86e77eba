// SPDX-License-Identifier: MIT
// What a roll back of slam_plane's thesis mode takes, by how many iterations it goes back: going back and doing them again, all at once, beside what the same iterations took the first time. On a
// road that never returns, with noise. Times are of the thread's CPU, the least of five runs.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "growth.hpp"
#include "plane_road.hpp"
#include "slam_plane/thesis/thesis_mapper.hpp"

namespace {

using namespace hallway;
using namespace hallway::slam_plane;
using hallway::bench::cpu_us;
using hallway::bench::Road;

constexpr int kRuns = 5;
constexpr std::uint32_t kSteps = 700;
constexpr double kInView = 10.0;
constexpr thesis::TrackId kNobody = 1000;  // of whom the hint speaks

struct RollBack {
  double us = 0.0;        // going back, and all iterations again
  double first_us = 0.0;  // those iterations the first time
};

RollBack drive(std::size_t back) {
  thesis::Options options;
  options.roll_back_limit = 500;
  thesis::ThesisMapper mapper(options);
  Road road(kInView, 0.0);
  RollBack result;
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    const std::vector<WallObservation>& observations = road.see(i);
    const double start = cpu_us();
    mapper.process(observations, View{});
    if (i + back >= kSteps) result.first_us += cpu_us() - start;
  }
  mapper.refined_map();
  const double start = cpu_us();
  mapper.roll_back({static_cast<thesis::Iteration>(kSteps - back), kNobody, 0});
  mapper.refined_map();
  result.us = cpu_us() - start;
  return result;
}

}  // namespace

int main() {
  std::printf("%10s %8s %10s %14s\n", "back over", "ms", "first ms", "again / first");
  for (const std::size_t back : std::array<std::size_t, 4>{50, 125, 250, 500}) {
    RollBack least = drive(back);
    for (int run = 1; run < kRuns; ++run) {
      const RollBack again = drive(back);
      least.us = std::min(least.us, again.us);
      least.first_us = std::min(least.first_us, again.first_us);
    }
    std::printf("%10zu %8.1f %10.1f %14.2f\n", back, 1e-3 * least.us, 1e-3 * least.first_us,
                least.us / least.first_us);
  }
}
