// SPDX-License-Identifier: MIT
#include "eval/followed_walls.hpp"

#include <algorithm>
#include <optional>

namespace hallway::eval {
namespace {

constexpr double kAlong = 0.766;  ///< cos of the largest angle between heading and wall
constexpr double kLeastFollowed_m = 0.1;

bool is_followed(const FollowedWall& visit, const FloorPlan& plan, const DrivenWay& way) {
  const double driven_m = way.poses()[visit.last_pose].way_m - way.poses()[visit.first_pose].way_m;
  return driven_m >= std::min(kLeastFollowed_m, 0.5 * plan.walls()[visit.wall].length_m);
}

}  // namespace

std::vector<FollowedWall> find_followed_walls(const FloorPlan& plan, const DrivenWay& way, double reach_m) {
  std::vector<FollowedWall> followed;
  std::optional<FollowedWall> visit;
  const auto finish = [&] {
    if (!visit || !is_followed(*visit, plan, way)) return;
    if (!followed.empty() && followed.back().wall == visit->wall) {
      followed.back().last_pose = visit->last_pose;
      followed.back().last_along_m = visit->last_along_m;
    } else {
      followed.push_back(*visit);
    }
  };
  for (std::size_t i = 0; i < way.poses().size(); ++i) {
    const WayPose& pose = way.poses()[i];
    const auto hit = plan.first_hit(pose.place(), pose.right(), reach_m);
    if (!hit || hit->direction.dot(pose.forward()) < kAlong) continue;
    if (hit->along_m < plan.walls()[hit->wall].bend_m) continue;  // of the corner
    if (!visit || visit->wall != hit->wall) {
      finish();
      visit = {hit->wall, i, i, hit->along_m, hit->along_m};
    }
    visit->last_pose = i;
    visit->last_along_m = hit->along_m;
  }
  finish();
  return followed;
}

}  // namespace hallway::eval
