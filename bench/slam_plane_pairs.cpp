// SPDX-License-Identifier: MIT
// What one more iteration of a pair of planes costs, in slam_plane's thesis mode, by how many shared observations are stored: with the sums that are kept, and from the observations themselves. Both
// see the planes, which grow, stand still and shrink, and compare them; pushing is part of both. Times are of the thread's CPU, the least of five runs; results have to be equal.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <vector>

#include "slam_plane/thesis/pair_comparer.hpp"

namespace {

using namespace hallway;
using namespace hallway::slam_plane;
using namespace hallway::slam_plane::thesis;

constexpr int kRuns = 5;
constexpr Iteration kMeasured = 100;  // iterations
constexpr int kEnds = 1;              // the left end of the one and the right end of the other

double cpu_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

/// A wall ahead and one on the left, of which more and more and then less and less is seen, from a robot on a winding path.
TimedObservation wall(int which, Iteration k) {
  const auto t = static_cast<double>(k);
  const Pose2 T_robot_world =
      Pose2::at(Vec2(0.005 * t, 0.2 * std::sin(0.05 * t)), 0.3 * std::sin(0.03 * t)).inverse();
  const double hidden = 1.5 * (1.0 + std::cos(0.01 * t));
  const Vec2 a = which == 0 ? Vec2(-2 + hidden, 2) : Vec2(15, 3),
             b = which == 0 ? Vec2(6, 2) : Vec2(15, -3 + hidden);
  return *make_observation({T_robot_world * a, T_robot_world * b, 0.0, 2.5}, k);
}

struct Timing {
  double us = 0.0;        // an iteration
  double checksum = 0.0;  // of the offsets
};

Timing run(Iteration stored, bool kept) {
  TrackOptions options;
  options.capacity = static_cast<int>(stored);
  PlaneTrack a(0, options), b(1, options);
  const CompareOptions compare;
  PairComparer comparer(compare);
  std::vector<TimedObservation> seen[2];
  for (Iteration k = 0; k < 2 * stored + kMeasured; ++k) {
    for (int i = 0; i < 2; ++i) seen[i].push_back(wall(i, k));
  }
  Timing timing;
  double begin = 0.0;
  for (std::size_t i = 0; i < seen[0].size(); ++i) {
    if (i + kMeasured == seen[0].size()) begin = cpu_us();
    a.push(seen[0][i]);
    b.push(seen[1][i]);
    if (!kept && i + kMeasured < seen[0].size()) continue;
    const Interval all{a.oldest().iteration, a.newest().iteration};
    const Comparison comparison =
        kept ? comparer.compare_in(a, b, all, kEnds) : compare_uncached_in(a, b, all, kEnds, compare);
    if (i + kMeasured >= seen[0].size()) timing.checksum += comparison.offset.sum();
  }
  timing.us = (cpu_us() - begin) / static_cast<double>(kMeasured);
  return timing;
}

Timing best(Iteration stored, bool kept) {
  Timing least = run(stored, kept);
  for (int i = 1; i < kRuns; ++i) {
    const Timing again = run(stored, kept);
    if (again.us < least.us) least = again;
  }
  return least;
}

}  // namespace

int main() {
  std::printf("stored  kept us  anew us  ratio\n");
  bool equal = true;
  for (const Iteration stored : {50, 125, 250, 500, 1000, 2000, 4000}) {
    const Timing kept = best(stored, true), anew = best(stored, false);
    equal = equal && kept.checksum == anew.checksum;
    std::printf("%6d  %7.2f  %7.2f  %5.1f\n", static_cast<int>(stored), kept.us, anew.us, anew.us / kept.us);
  }
  if (!equal) std::printf("results differ\n");
  return equal ? 0 : 1;
}
