// SPDX-License-Identifier: MIT
#include "slam_plane/core/map_solver.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace hallway::slam_plane {
namespace {

constexpr std::size_t kBeside = 4;  // submaps of a step that places the active one
constexpr std::size_t kNear = 16;   // of one about the submap that was closed
constexpr int kLeastPeriod = 5;     // submaps closed between two steps over all
constexpr double kTolerance = 1e-4;
constexpr double kWorkPerFrame = 400.0;  // on a part of the map
constexpr double kWholeWork = 150.0;     // on all of it: it takes as many frames as it takes
constexpr double kUrgentWork = 4000.0;   // of a frame, after a loop
constexpr double kWorkAtOnce = 10000.0;  // of refreshing what is about the robot
constexpr double kWorkOfForm = 4.0;      // that is summed up
constexpr double kSettleWork = 1e12;
constexpr double kSettleTolerance = 1e-9;
constexpr int kSettleSteps = 15;
constexpr double kSettled = 1e-6;  // a move that is none [m, rad]

}  // namespace

void MapSolver::note_loop(WallMap& map) {
  on_old_ground_ = is_urgent_ = true;
  stale_ = whole_map(map).walls;
  next_stale_ = 0;
  refresh(map, kWorkAtOnce);
}

void MapSolver::plan(const WallMap& map) {
  const std::uint32_t frames = map.submaps[map.active()].frames;
  if (frames > 1 && std::has_single_bit(frames)) is_active_due_ = true;
  if (step_.under_way() || next_stale_ < stale_.size()) return;
  step_.set_tolerance(kTolerance);
  const int period = std::max(kLeastPeriod, static_cast<int>(map.submaps.size() / 10));
  is_whole_ = is_urgent_ || (on_old_ground_ && closes_since_whole_ >= period);
  if (is_whole_) {
    step_.begin(map);
  } else if (has_closed_) {
    step_.begin(map, neighbourhood(map, kNear));
  } else if (is_active_due_) {
    step_.begin(map, neighbourhood(map, kBeside));
  } else {
    return;
  }
  has_closed_ = is_active_due_ = false;
}

bool MapSolver::advance(WallMap& map) {
  const double work = is_urgent_ ? kUrgentWork : is_whole_ ? kWholeWork : kWorkPerFrame;
  if (next_stale_ < stale_.size()) {
    refresh(map, work);
    return false;
  }
  if (!step_.under_way() || !step_.advance(map, work)) return false;
  if (is_whole_) {
    closes_since_whole_ = 0;
    on_old_ground_ = is_urgent_ = false;
  }
  if (!step_.apply(map)) return false;
  stale_ = step_.walls();
  next_stale_ = 0;
  refresh(map, kWorkAtOnce);
  return true;
}

void MapSolver::refresh(WallMap& map, double work) {
  for (; next_stale_ < stale_.size() && work > 0.0; ++next_stale_) {
    const Index wall = stale_[next_stale_];
    work -= kWorkOfForm * static_cast<double>(1 + 2 * map.walls[wall].memberships.size());
    map.refresh(wall);
  }
}

WallMap MapSolver::refreshed(WallMap map) const {
  for (std::size_t i = next_stale_; i < stale_.size(); ++i) map.refresh(stale_[i]);
  return map;
}

WallMap optimised(WallMap map) {
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
