// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <numeric>
#include <span>
#include <vector>

namespace hallway::bench {

/// CPU time of the calling thread [us].
inline double cpu_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

/// What the process has in memory [MB].
inline double resident_mb() {
  std::ifstream status("/proc/self/statm");
  double total = 0.0;
  double resident = 0.0;
  status >> total >> resident;
  return resident * 4096.0 / 1e6;
}

/// 0 for nothing.
inline double mean_of(std::span<const double> values) {
  const auto n = static_cast<double>(std::max<std::size_t>(1, values.size()));
  return std::accumulate(values.begin(), values.end(), 0.0) / n;
}

/// A table of what iterations take as something grows: sizes, then the iterations' times, then whatever else is told. Ratios are to the first row.
class GrowthTable {
 public:
  using Names = std::vector<const char*>;

  /// Prints the header: a line that says what is shown, and the names of the columns.
  GrowthTable(const char* what, const Names& sizes, const Names& more = {}) {
    std::printf("\n%s, us of CPU an iteration\n", what);
    for (const char* name : sizes) std::printf("%10s ", name);
    std::printf("%8s %8s %8s %8s %8s %6s", "in view", "mean", "p99", "worst", "ratio", "lost");
    for (const char* name : more) std::printf(" %9s", name);
    std::printf("\n");
  }

  /// Of one row's iterations: their times, and what was in view in them. Neither may be empty.
  struct Iterations {
    std::span<const double> us;
    std::span<const double> visible;
    double lost = 0.0;
  };
  void row(std::span<const double> sizes, const Iterations& iterations, std::span<const double> more = {}) {
    std::vector<double> sorted(iterations.us.begin(), iterations.us.end());
    std::sort(sorted.begin(), sorted.end());
    const double mean = mean_of(sorted);
    if (first_mean_ == 0.0) first_mean_ = mean;
    for (const double size : sizes) std::printf("%10.0f ", size);
    std::printf("%8.1f %8.1f %8.1f %8.1f %8.2f %6.0f", mean_of(iterations.visible), mean,
                sorted[sorted.size() * 99 / 100], sorted.back(), mean / first_mean_, iterations.lost);
    for (const double value : more) std::printf(" %9.1f", value);
    std::printf("\n");
  }

 private:
  double first_mean_ = 0.0;
};

}  // namespace hallway::bench
