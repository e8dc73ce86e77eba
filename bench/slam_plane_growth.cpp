// SPDX-License-Identifier: MIT
// What a plane mapper takes as more walls are in view, as its map grows and as its life grows, in mode=relative or mode=thesis. Times are of the thread's CPU, iteration by iteration the
// least of several identical runs.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "growth.hpp"
#include "plane_road.hpp"
#include "slam_plane/core/mapper.hpp"
#include "slam_plane/thesis/thesis_mapper.hpp"

namespace {

using namespace hallway;
using namespace hallway::slam_plane;
using hallway::bench::cpu_us;
using hallway::bench::GrowthTable;
using hallway::bench::kRange_m;
using hallway::bench::kStep_m;
using hallway::bench::mean_of;
using hallway::bench::resident_mb;
using hallway::bench::Road;

constexpr int kRuns = 5;

struct Drive {
  std::vector<double> us;       // by iteration, the least of all runs
  std::vector<double> visible;  // likewise
  Counters counters;
};

/// The mapper of a mode, with the options that it has by default.
template <typename AnyMapper>
AnyMapper made();
template <>
Mapper made() {
  return Mapper(Options{});
}
template <>
thesis::ThesisMapper made() {
  return thesis::ThesisMapper(thesis::Options{});
}

/// `stretch_m`: see Road.
template <typename AnyMapper>
Drive drive(double visible, double stretch_m, std::size_t steps) {
  Drive result;
  result.us.assign(steps, 1e300);
  result.visible.assign(steps, 0.0);
  for (int run = 0; run < kRuns; ++run) {
    Road road(visible, 0.0, stretch_m);
    auto mapper = made<AnyMapper>();
    for (std::size_t i = 0; i < steps; ++i) {
      const std::vector<WallObservation>& observations = road.see(static_cast<std::uint32_t>(i));
      const double start = cpu_us();
      result.counters = mapper.process(observations, View{}).counters;
      result.us[i] = std::min(result.us[i], cpu_us() - start);
      result.visible[i] = static_cast<double>(observations.size());
    }
  }
  return result;
}

/// The iterations of a drive from one on.
std::span<const double> from(const std::vector<double>& values, std::size_t first) {
  return std::span(values).subspan(first);
}

void print_row(GrowthTable& table, double asked, const Drive& drive, std::size_t first) {
  const Counters& counters = drive.counters;
  table.row(std::array{asked, static_cast<double>(counters.landmarks), static_cast<double>(counters.submaps)},
            {from(drive.us, first), from(drive.visible, first), static_cast<double>(counters.lost)});
}

const GrowthTable::Names kSizes{"asked", "walls", "submaps"};

template <typename AnyMapper>
void by_walls_in_view() {
  GrowthTable table("walls in view, on a road that never returns", kSizes);
  std::vector<std::pair<double, double>> cost;  // in view, mean
  for (const double visible : {5.0, 10.0, 20.0, 50.0, 100.0, 200.0}) {
    const Drive d = drive<AnyMapper>(visible, 0.0, 1500);
    print_row(table, visible, d, 500);
    cost.emplace_back(mean_of(from(d.visible, 500)), mean_of(from(d.us, 500)));
  }
  const auto [n0, t0] = cost.front();
  const auto [n1, t1] = cost.back();
  std::printf("growth from %.0f to %.0f in view: exponent %.2f; n log n over that range: %.2f\n", n0, n1,
              std::log(t1 / t0) / std::log(n1 / n0),
              std::log(n1 * std::log(n1) / (n0 * std::log(n0))) / std::log(n1 / n0));
}

/// Walls that are mapped for each metre of road with 10 in view: of each the side that is seen.
double walls_per_m() {
  const Road road(10.0, 1000.0);
  return 0.5 * road.walls() / road.lap_m();
}

template <typename AnyMapper>
void by_map_size(double most) {
  GrowthTable table("map size, a stretch for the third time", kSizes);
  for (const double walls : {50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 5000.0}) {
    if (walls > most) break;
    const double stretch = std::max(1.0, walls / walls_per_m() - kRange_m);
    const auto steps = static_cast<std::size_t>(stretch / kStep_m);
    print_row(table, walls, drive<AnyMapper>(10.0, stretch, 3 * steps), 2 * steps);
  }
}

template <typename AnyMapper>
void new_ground(double most) {
  GrowthTable table("new ground, a run and its tenths", kSizes);
  const auto steps = static_cast<std::size_t>(most / walls_per_m() / kStep_m);
  const Drive d = drive<AnyMapper>(10.0, 0.0, steps);
  print_row(table, most, d, 0);
  std::vector<double> tenths;
  for (std::size_t k = 0; k < 10; ++k) {
    tenths.push_back(mean_of(std::span(d.us).subspan(k * steps / 10, (k + 1) * steps / 10 - k * steps / 10)));
    std::printf(" %7.1f", tenths.back());
  }
  std::printf("\nlast tenth / second tenth: %.3f\n", tenths[9] / tenths[1]);
}

template <typename AnyMapper>
void known_ground(std::uint64_t iterations) {
  constexpr std::uint64_t kMostInRow = 100000;
  std::vector<double> us(kMostInRow, 0.0), visible(kMostInRow, 0.0);
  Road road(10.0, 60.0);
  auto mapper = made<AnyMapper>();
  const double before_mb = resident_mb();
  GrowthTable table("known ground, round a circle of about 60 m", {"iterations", "walls", "submaps"}, {"MB"});
  std::uint64_t next = 1000;
  std::size_t since = 0;
  for (std::uint64_t i = 1; i <= iterations; ++i) {
    const std::vector<WallObservation>& observations = road.see(static_cast<std::uint32_t>(i));
    const double start = cpu_us();
    const Counters& counters = mapper.process(observations, View{}).counters;
    us[since] = cpu_us() - start;
    visible[since++] = static_cast<double>(observations.size());
    if (i != next && i != iterations) continue;
    table.row(
        std::array{static_cast<double>(i), static_cast<double>(counters.landmarks),
                   static_cast<double>(counters.submaps)},
        {std::span(us).first(since), std::span(visible).first(since), static_cast<double>(counters.lost)},
        std::array{resident_mb() - before_mb});
    since = 0;
    next = next < 10000 ? 10000 : next < kMostInRow ? kMostInRow : next + kMostInRow;
  }
}

template <typename AnyMapper>
void all_tables(double most_walls, std::uint64_t iterations) {
  by_walls_in_view<AnyMapper>();
  by_map_size<AnyMapper>(most_walls);
  new_ground<AnyMapper>(most_walls);
  known_ground<AnyMapper>(iterations);
}

}  // namespace

/// The most walls of a map and the iterations on known ground, or 5000 and 1e6; then the mode, or relative.
int main(int argc, char** argv) {
  const double most_walls = argc > 1 ? std::strtod(argv[1], nullptr) : 5000.0;
  const double iterations = argc > 2 ? std::strtod(argv[2], nullptr) : 1e6;
  const std::string_view mode = argc > 3 ? argv[3] : "relative";
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  if (mode == "relative") {
    all_tables<Mapper>(most_walls, static_cast<std::uint64_t>(iterations));
  } else if (mode == "thesis") {
    all_tables<thesis::ThesisMapper>(most_walls, static_cast<std::uint64_t>(iterations));
  } else {
    std::fprintf(stderr, "usage: bench_slam_plane_growth [WALLS [ITERATIONS [relative|thesis]]]\n");
    return 2;
  }
  return 0;
}
