// SPDX-License-Identifier: MIT
#include "slam_plane/core/frame_locator.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::slam_plane {
namespace {

constexpr std::uint64_t kRecentFrames = 15;  // for which a wall out of view is still looked for first
constexpr double kLeastCrossing =
    0.5;                          // sine between the heading and a direction in which nothing is measured
constexpr double kStray2 = 36.0;  // squared distance of a piece that is not its wall's, in variances
constexpr double kStrayTurn_rad = 0.05;
constexpr double kStrayBound_m = 0.05;  // below which none strays

}  // namespace

void FrameLocator::locate(const WallMap& map, std::uint32_t since, Frame& frame) {
  // The submap may have been moved since the last frame.
  const Pose2 predicted = map.submaps[map.active()].T_map_submap * frame.T_submap_robot * motion_;
  locate_from(predicted, map, since, frame);
  // It may have stopped.
  if (known_ == 0) locate_from(predicted * motion_.inverse(), map, since, frame);
  reckon(map.submaps[map.active()].T_map_submap, frame);
}

/// A robot that is not told along one direction has gone on along it. Where it looks along it, its step is not told either: then the motion so far is as good.
void FrameLocator::reckon(const Pose2& T_map_submap, Frame& frame) {
  if (known_ == 0) return reckoning_.reset();
  reckoning_.predict(T_map_submap, frame.T_map_robot.r, fastest_);
  const PoseInformation& told = frame.in_map;
  if (!reckoning_.is_running() || !told.heading || told.open != 1) return;
  if (std::abs(cross(told.direction, frame.T_map_robot.r)) <= kLeastCrossing) return reckoning_.reset();
  frame.T_map_robot.t += told.direction.dot(reckoning_.place() - frame.T_map_robot.t) * told.direction;
}

void FrameLocator::locate_from(const Pose2& T_map_robot, const WallMap& map, std::uint32_t since,
                               Frame& frame) {
  Pose2& T = frame.T_map_robot;
  T = T_map_robot;
  matcher_.correct_heading(map, recent_, frame.sightings, T);
  matcher_.match_recent(map, recent_, frame.iteration, T, frame.sightings);
  fit_map(map, frame, kNone, T);
  matcher_.match_map(map, since, T, frame.sightings);
  frame.in_map = fit_map(map, frame, kNone, T);
  known_ = fit_.pairs();
}

PoseInformation FrameLocator::fit_map(const WallMap& map, const Frame& frame, std::uint32_t before_epoch,
                                      Pose2& T) {
  fit_.clear();
  for (const Sighting& sighting : frame.sightings) {
    if (sighting.wall == kNone || sighting.stray || map.walls[sighting.wall].epoch >= before_epoch) continue;
    const WallRecord& wall = map.walls[sighting.wall];
    fit_.add(sighting, wall.estimate, wall.corner_epoch[kEndA] < before_epoch,
             wall.corner_epoch[kEndB] < before_epoch);
  }
  return fit_.solve(T);
}

void FrameLocator::find_strays(const WallMap& map, Frame& frame) {
  std::size_t pair = 0;
  bool any = false;
  for (Sighting& sighting : frame.sightings) {
    if (sighting.wall == kNone || sighting.stray) continue;
    const WallRecord& wall = map.walls[sighting.wall];
    const bool recent = wall.last_seen + kRecentFrames >= frame.iteration;
    const double offset = std::abs(wall.estimate.basis.across(frame.T_map_robot * sighting.middle));
    const double distance2 = fit_.line_distance2(pair++, frame.T_map_robot);
    const Vec2 direction = frame.T_map_robot.rotate(sighting.direction);
    const double turn = std::abs(cross(wall.estimate.basis.direction, direction));
    sighting.stray = recent && (offset > kStrayBound_m || turn > kStrayTurn_rad) && distance2 > kStray2;
    any = any || sighting.stray;
  }
  any = trust_most(map, frame) || any;
  if (any) frame.in_map = fit_map(map, frame, kNone, frame.T_map_robot);
}

/// What most pieces agree on stands: where half of them or more stray, it is the pose that was wrong. Returns whether that is so.
bool FrameLocator::trust_most(const WallMap& map, Frame& frame) const {
  std::size_t standing = 0, straying = 0;
  for (const Sighting& sighting : frame.sightings) {
    if (sighting.wall == kNone || map.walls[sighting.wall].is_dynamic) continue;
    ++(sighting.stray ? straying : standing);
  }
  if (straying == 0 || straying < standing) return false;
  for (Sighting& sighting : frame.sightings) {
    if (sighting.wall != kNone && !map.walls[sighting.wall].is_dynamic) sighting.stray = false;
  }
  return true;
}

void FrameLocator::locate_in_submap(const WallMap& map, Frame& frame) {
  const SubmapRecord& submap = map.submaps[map.active()];
  fit_.clear();
  for (const Sighting& sighting : frame.sightings) {
    if (sighting.wall == kNone || sighting.stray) continue;
    const Index member = map.walls[sighting.wall].active_member;
    if (member != kNone) fit_.add(sighting, submap.members[member].estimate);
  }
  frame.T_submap_robot = submap.T_map_submap.inverse() * frame.T_map_robot;
  frame.in_submap = fit_.solve(frame.T_submap_robot);
}

void FrameLocator::note_motion(const Pose2& before, const Frame& frame, const Vec2& untied) {
  reckoning_.correct(frame.T_map_robot, frame.in_map);
  const Pose2 moved = before.inverse() * frame.T_submap_robot;
  Vec2 step = moved.t;
  if (untied != Vec2::Zero()) {
    // Nothing was measured along it. A robot goes where it looks (thesis 4.3.6, rules 24 and 25), which tells the step by its other part unless it
    // looks along it.
    const Vec2 along = frame.T_map_robot.unrotate(untied);
    const Vec2 other = left_of(along);
    const double slide = std::abs(other.x()) > kLeastCrossing ? other.dot(moved.t) / other.x() * along.x()
                                                              : along.dot(motion_.t);
    step = other.dot(moved.t) * other + slide * along;
  }
  motion_ = Pose2::at(motion_.t + smoothing_ * (step - motion_.t),
                      motion_.heading() + smoothing_ * angle_between(motion_.r, moved.r));
  fastest_ = std::max(fastest_, motion_.t.norm());
}

void FrameLocator::note_seen(const WallMap& map, const Frame& frame) {
  reckoning_.keep(map.submaps[map.active()].T_map_submap, frame.T_map_robot);
  for (const Sighting& sighting : frame.sightings) {
    if (std::find(recent_.begin(), recent_.end(), sighting.wall) == recent_.end())
      recent_.push_back(sighting.wall);
  }
  std::erase_if(recent_, [&](Index w) { return map.walls[w].last_seen + kRecentFrames < frame.iteration; });
}

void FrameLocator::replace(Index gone, Index kept) {
  std::erase(recent_, gone);
  if (std::find(recent_.begin(), recent_.end(), kept) == recent_.end()) recent_.push_back(kept);
}

}  // namespace hallway::slam_plane
