// SPDX-License-Identifier: MIT
#include "slam_plane/core/frame_locator.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::slam_plane {
namespace {

constexpr std::uint64_t kRecentFrames = 15;  // for which a wall out of view is still looked for first
constexpr double kLeastCrossing =
    0.5;                            // sine between the heading and a direction in which nothing is measured
constexpr double kOutlier2 = 36.0;  // squared distance of an observation that is not its wall's, in variances
constexpr double kOutlierTurn_rad = 0.05;
constexpr double kOutlierBound_m = 0.05;  // below which none outliers

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
  const PoseInformation& report_map = frame.in_map;
  if (!reckoning_.is_running() || !report_map.heading || report_map.open != 1) return;
  if (std::abs(cross(report_map.direction, frame.T_map_robot.r)) <= kLeastCrossing) return reckoning_.reset();
  frame.T_map_robot.t +=
      report_map.direction.dot(reckoning_.place() - frame.T_map_robot.t) * report_map.direction;
}

void FrameLocator::locate_from(const Pose2& T_map_robot, const WallMap& map, std::uint32_t since,
                               Frame& frame) {
  Pose2& T = frame.T_map_robot;
  T = T_map_robot;
  matcher_.correct_heading(map, recent_, frame.observations, T);
  matcher_.match_recent(map, recent_, frame.iteration, T, frame.observations);
  fit_map(map, frame, kAllEpochs, T);
  matcher_.match_map(map, since, T, frame.observations);
  frame.in_map = fit_map(map, frame, kAllEpochs, T);
  known_ = fit_.pairs();
}

PoseInformation FrameLocator::fit_map(const WallMap& map, const Frame& frame, std::uint32_t before_epoch,
                                      Pose2& T) {
  fit_.clear();
  for (const AssociatedObservation& observation : frame.observations) {
    if (!observation.is_evidence() || map.walls[observation.wall].epoch >= before_epoch) continue;
    const WallRecord& wall = map.walls[observation.wall];
    fit_.add(observation, wall.estimate, wall.corner_epoch[kEndA] < before_epoch,
             wall.corner_epoch[kEndB] < before_epoch);
  }
  return fit_.solve(T);
}

void FrameLocator::find_outliers(const WallMap& map, Frame& frame) {
  std::size_t pair = 0;
  bool any = false;
  for (AssociatedObservation& observation : frame.observations) {
    if (!observation.is_evidence()) continue;
    const WallRecord& wall = map.walls[observation.wall];
    const bool recent = wall.last_seen + kRecentFrames >= frame.iteration;
    const double offset = std::abs(wall.estimate.basis.across(frame.T_map_robot * observation.middle));
    const double distance2 = fit_.line_distance2(pair++, frame.T_map_robot);
    const Vec2 direction = frame.T_map_robot.rotate(observation.direction);
    const double turn = std::abs(cross(wall.estimate.basis.direction, direction));
    observation.outlier =
        recent && (offset > kOutlierBound_m || turn > kOutlierTurn_rad) && distance2 > kOutlier2;
    any = any || observation.outlier;
  }
  any = trust_most(map, frame) || any;
  if (any) frame.in_map = fit_map(map, frame, kAllEpochs, frame.T_map_robot);
}

/// What most observations agree on stands: where half of them or more outlier, it is the pose that was wrong. Returns whether that is so.
bool FrameLocator::trust_most(const WallMap& map, Frame& frame) const {
  std::size_t inliers = 0, outliers = 0;
  for (const AssociatedObservation& observation : frame.observations) {
    if (observation.wall == kNone || map.walls[observation.wall].is_dynamic) continue;
    ++(observation.outlier ? outliers : inliers);
  }
  if (outliers == 0 || outliers < inliers) return false;
  for (AssociatedObservation& observation : frame.observations) {
    if (observation.wall != kNone && !map.walls[observation.wall].is_dynamic) observation.outlier = false;
  }
  return true;
}

void FrameLocator::locate_in_submap(const WallMap& map, Frame& frame) {
  const SubmapRecord& submap = map.submaps[map.active()];
  fit_.clear();
  for (const AssociatedObservation& observation : frame.observations) {
    if (!observation.is_evidence()) continue;
    const Index member = map.walls[observation.wall].active_member;
    if (member != kNone) fit_.add(observation, submap.members[member].estimate);
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
  for (const AssociatedObservation& observation : frame.observations) {
    add_new(recent_, observation.wall);
  }
  std::erase_if(recent_, [&](Index w) { return map.walls[w].last_seen + kRecentFrames < frame.iteration; });
}

void FrameLocator::replace(Index gone, Index kept) {
  std::erase(recent_, gone);
  add_new(recent_, kept);
}

}  // namespace hallway::slam_plane
