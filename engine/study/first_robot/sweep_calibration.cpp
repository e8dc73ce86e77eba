// SPDX-License-Identifier: MIT
#include "study/first_robot/sweep_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "geometry/se3.hpp"

namespace hallway::study {
namespace {

/// Whole millimetres.
std::vector<double> steps(double low, double high, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i)
    values.push_back(std::round(1e3 * (low + (high - low) * i / (count - 1))) / 1e3);
  return values;
}

/// Places of a grid point on its three axes.
struct GridPlace {
  std::size_t cover, depth, window;

  GridPlace(std::size_t index, const SweepRuleGrid& grid)
      : cover(index % grid.cover_m.size()),
        depth(index / grid.cover_m.size() % grid.room_depth_m.size()),
        window(index / grid.cover_m.size() / grid.room_depth_m.size()) {}

  SweepRuleParameters of(const SweepRuleGrid& grid) const {
    return {.cover_m = grid.cover_m[cover],
            .room_depth_m = grid.room_depth_m[depth],
            .window_deg = grid.window_deg[window]};
  }
  Vec3 vector() const {
    return {static_cast<double>(cover), static_cast<double>(depth), static_cast<double>(window)};
  }
};

void widen(const SweepRuleParameters& by, Calibration& calibration) {
  for (double SweepRuleParameters::*member :
       {&SweepRuleParameters::cover_m, &SweepRuleParameters::room_depth_m,
        &SweepRuleParameters::window_deg}) {
    calibration.low.*member = std::min(calibration.low.*member, by.*member);
    calibration.high.*member = std::max(calibration.high.*member, by.*member);
  }
}

}  // namespace

std::uint64_t Confusion::of(OpeningKind truth) const {
  std::uint64_t sum = 0;
  for (const OpeningKind said : kOpeningKinds) sum += of(truth, said);
  return sum;
}

std::uint64_t Confusion::total() const {
  std::uint64_t sum = 0;
  for (const OpeningKind truth : kOpeningKinds) sum += of(truth);
  return sum;
}

std::uint64_t Confusion::errors() const {
  std::uint64_t sum = 0;
  for (const OpeningKind truth : kOpeningKinds) sum += wrong(truth);
  return sum;
}

Confusion confusion_of(std::span<const LabelledSweep> sweeps, const SweepRule& rule,
                       const SweepRuleParameters& parameters) {
  Confusion confusion;
  for (const LabelledSweep& sweep : sweeps)
    ++confusion.count[static_cast<std::size_t>(sweep.opening.kind)]
                     [static_cast<std::size_t>(rule(sweep, parameters))];
  return confusion;
}

SweepRuleGrid default_sweep_rule_grid() {
  return {.cover_m = steps(0.1, 1.2, 23),
          .room_depth_m = steps(2.0, 8.0, 61),
          .window_deg = {8, 12, 16, 20, 24, 28, 32, 38, 44}};
}

Calibration calibrate(std::span<const LabelledSweep> sweeps, const SweepRule& rule, const SweepRuleGrid& grid,
                      unsigned threads) {
  if (grid.size() == 0) throw Error(ErrorCode::kInternal, "a calibration has nothing to try");
  std::vector<std::uint64_t> errors(grid.size());
  parallel_for(grid.size(), 64, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      errors[i] = confusion_of(sweeps, rule, GridPlace(i, grid).of(grid)).errors();
  });
  Calibration found;
  found.errors = *std::ranges::min_element(errors);
  std::vector<std::size_t> best;
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (errors[i] != found.errors) continue;
    const GridPlace place(i, grid);
    if (best.empty()) found.low = found.high = place.of(grid);
    best.push_back(i);
    sum += place.vector();
    widen(place.of(grid), found);
  }
  found.equally = best.size();
  const Vec3 middle = sum / static_cast<double>(best.size());
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : best) {
    const double distance = (GridPlace(i, grid).vector() - middle).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    found.best = GridPlace(i, grid).of(grid);
  }
  return found;
}

}  // namespace hallway::study
