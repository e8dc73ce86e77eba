// SPDX-License-Identifier: MIT
#include "slam_plane/core/map_solver.hpp"

#include <algorithm>

namespace hallway::slam_plane {
namespace {

constexpr int kClosesToStep = 10;       // least number of submaps closed between two steps
constexpr int kClosesToStepAgain = 5;   // on old ground
constexpr int kClosesOfLoop = 1 << 20;  // as many as any map asks for
constexpr double kWorkPerFrame = 4000.0;
constexpr double kSettleWork = 1e12;
constexpr double kSettleTolerance = 1e-9;
constexpr int kSettleSteps = 15;
constexpr double kSettled = 1e-6;  // a move that is none [m, rad]

}  // namespace

void MapSolver::note_loop() {
  on_old_ground_ = true;
  closes_ = kClosesOfLoop;
}

void MapSolver::plan(const WallMap& map) {
  if (step_.under_way()) return;
  const int period = on_old_ground_ ? kClosesToStepAgain : kClosesToStep;
  if (closes_ < std::max<int>(period, static_cast<int>(map.submaps.size() / 10))) return;
  closes_ = 0;
  on_old_ground_ = false;
  step_.begin(map);
}

bool MapSolver::advance(WallMap& map) {
  if (!step_.under_way() || !step_.advance(map, kWorkPerFrame) || !step_.apply(map)) return false;
  map.refresh_all();
  return true;
}

WallMap settled(WallMap map) {
  MapStep step;
  step.set_tolerance(kSettleTolerance);
  for (int i = 0; i < kSettleSteps && !map.submaps.empty(); ++i) {
    step.begin(map);
    step.advance(map, kSettleWork);
    if (!step.apply(map)) break;
    map.refresh_all();
    if (step.largest_move() < kSettled) break;
  }
  return map;
}

}  // namespace hallway::slam_plane
