// SPDX-License-Identifier: MIT
#include "eval/topology_truth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "eval/followed_walls.hpp"
#include "eval/opening.hpp"
#include "geometry/convex2.hpp"

namespace hallway::eval {
namespace {

constexpr double kStraightOn_rad = std::numbers::pi / 4;
constexpr double kBack_rad = 3 * kStraightOn_rad;
constexpr double kSamePlace_m = 0.1;  ///< two finds of one kind so near are one node
constexpr double kNoWall_m = std::numeric_limits<double>::infinity();

double angle_from(const Vec2& a, const Vec2& b) {
  return std::atan2(cross(a, b), a.dot(b));
}

/// Finds the nodes along a way.
class TruthFinder {
 public:
  TruthFinder(const FloorPlan& plan, const DrivenWay& way, const TruthSettings& settings)
      : plan_(plan),
        way_(way),
        settings_(settings),
        followed_(find_followed_walls(plan, way, settings.reach_m)) {}

  TopologyTruth find() {
    leave_out_edges();
    for (std::size_t i = 1; i < followed_.size(); ++i) {
      add_transition(followed_[i - 1], followed_[i]);
      if (i >= 2) add_dead_end(i - 1);
    }
    std::ranges::stable_sort(truth_.passes, {}, &TruePass::way_m);
    truth_.came_around = came_around();
    return std::move(truth_);
  }

 private:
  const PlanWall& wall_of(const FollowedWall& followed) const { return plan_.walls()[followed.wall]; }

  bool is_followed_to_end(const FollowedWall& followed) const {
    return wall_of(followed).length_m - followed.last_along_m <= settings_.end_m;
  }
  /// Whether there is free space beside the end of a wall.
  bool opens(const FollowedWall& followed) const {
    return opens_at_end(plan_, followed.wall, settings_.accepted_gap_m);
  }

  /// Leaves out narrow walls that are the edge of an end: the thickness of a wall, which the robot turned round, and door frames in line.
  void leave_out_edges() {
    std::vector<FollowedWall> kept;
    for (const FollowedWall& followed : followed_) {
      if (!kept.empty() && is_edge(kept.back(), followed)) continue;
      if (!kept.empty() && kept.back().wall == followed.wall) {
        kept.back().last_pose = followed.last_pose;
        kept.back().last_along_m = followed.last_along_m;
      } else {
        kept.push_back(followed);
      }
    }
    followed_ = std::move(kept);
  }

  bool is_edge(const FollowedWall& before, const FollowedWall& followed) const {
    const PlanWall &a = wall_of(before), &narrow = wall_of(followed);
    if (narrow.length_m > settings_.thin_m || !is_followed_to_end(before)) return false;
    const double turn = angle_from(a.end_direction(), narrow.start_direction());
    const Vec2 gap = narrow.start() - a.end();
    if (gap.norm() >= settings_.thin_m) return false;
    if (std::abs(turn) < kStraightOn_rad)
      return std::abs(cross(a.end_direction(), gap)) < settings_.accepted_step_m;
    return turn < 0.0 || turn >= kBack_rad;
  }

  /// What there is between two walls that were followed one after the other.
  void add_transition(const FollowedWall& before, const FollowedWall& after) {
    const PlanWall &a = wall_of(before), &b = wall_of(after);
    if (!is_followed_to_end(before)) return;
    const double turn = angle_from(a.end_direction(), b.start_direction());
    if (turn <= -kStraightOn_rad || turn >= kBack_rad) {  // round a thin wall's end: half a turn either way
      if (opens(before)) add_turned_end(before, after);
    } else if (turn >= kStraightOn_rad) {
      if (opens(before)) add_opening_before_wall(before, after);
    } else if (after.first_along_m <= settings_.end_m + wall_of(after).bend_m) {
      add_straight_on(before, after);
    }
  }

  /// A step or an opening that the robot passed.
  void add_straight_on(const FollowedWall& before, const FollowedWall& after) {
    const PlanWall &a = wall_of(before), &b = wall_of(after);
    const Vec2 gap = b.start() - a.end();
    if (gap.norm() > settings_.widest_m) return;
    if (std::abs(a.end_direction().dot(gap)) < settings_.accepted_gap_m) {
      add_step(before, after);
    } else if (opens(before)) {
      add_opening({before.wall, after.wall, 0.0, a.end(), b.start()}, before);
      add_edge(-1, b.start(), before);
    }
  }

  /// An opening that the robot passed to the wall ahead, along which it went on to the left.
  void add_opening_before_wall(const FollowedWall& before, const FollowedWall& after) {
    const auto opening = find_opening(plan_, before.wall, settings_.widest_m, settings_.aside_m);
    if (opening && opening->far_wall == after.wall && opening->width_m() >= settings_.accepted_gap_m)
      add_opening(*opening, before);
  }

  void add_step(const FollowedWall& before, const FollowedWall& after) {
    const PlanWall &a = wall_of(before), &b = wall_of(after);
    const double nearer_m = cross(a.end_direction(), b.start() - a.end());
    if (std::abs(nearer_m) < settings_.accepted_step_m) return;
    const Vec2 place = nearer_m > 0.0 ? b.start() : a.end();  // of the nearer wall's edge
    add({.kind = TrueKind::kStep,
         .direction = nearer_m > 0.0 ? -1 : 1,
         .size_m = std::abs(nearer_m),
         .from = place,
         .to = place,
         .is_demanded = std::abs(nearer_m) >= settings_.demanded_step_m},
        before);
  }

  /// An end that the robot turned round to the right.
  void add_turned_end(const FollowedWall& before, const FollowedWall& after) {
    const PlanWall &a = wall_of(before), &b = wall_of(after);
    if (const auto opening = find_opening(plan_, before.wall, settings_.widest_m, settings_.aside_m)) {
      add_opening(*opening, before);
    } else {
      add({.kind = TrueKind::kWallEnd, .direction = 1, .size_m = kNoWall_m, .from = a.end(), .to = a.end()},
          before);
      add_edge(1, a.end(), before);
    }
    if ((b.start() - a.end()).norm() <= settings_.reach_m) add_edge(-1, b.start(), before);
  }

  void add_opening(const Opening& opening, const FollowedWall& before) {
    const bool is_room = what_is_behind(plan_, opening) == Behind::kRoom;
    add({.kind = is_room ? TrueKind::kRoom : TrueKind::kHallway,
         .size_m = opening.width_m(),
         .from = opening.from,
         .to = opening.to,
         .is_demanded = opening.width_m() >= settings_.demanded_gap_m},
        before);
    add_edge(1, opening.from, before);
  }

  /// Where a wall ends or begins beside an opening or an end: it may be charted too.
  void add_edge(int direction, const Vec2& place, const FollowedWall& before) {
    add({.kind = TrueKind::kStep,
         .direction = direction,
         .size_m = kNoWall_m,
         .from = place,
         .to = place,
         .is_demanded = false},
        before);
  }

  /// Of a wall between two inner corners, with walls at least as long as it is on both sides.
  void add_dead_end(std::size_t i) {
    const PlanWall &a = wall_of(followed_[i - 1]), &end = wall_of(followed_[i]),
                   &b = wall_of(followed_[i + 1]);
    const auto turns_left = [](const PlanWall& from, const PlanWall& to) {
      return angle_from(from.end_direction(), to.start_direction()) > kStraightOn_rad;
    };
    if (a.next != followed_[i].wall || end.next != followed_[i + 1].wall) return;
    if (!turns_left(a, end) || !turns_left(end, b)) return;
    if (end.length_m > std::min({settings_.dead_end_m, a.length_m, b.length_m})) return;
    add({.kind = TrueKind::kDeadEnd,
         .size_m = end.length_m,
         .from = end.start(),
         .to = end.end(),
         .is_demanded = false},
        followed_[i]);
  }

  /// @param before  the wall that was followed when the robot came to it
  void add(const TrueNode& node, const FollowedWall& before) {
    const auto is_same = [&](const TrueNode& other) {
      return other.kind == node.kind && other.direction == node.direction &&
             other.is_demanded == node.is_demanded && (other.from - node.from).norm() < kSamePlace_m;
    };
    auto found = std::ranges::find_if(truth_.nodes, is_same);
    const auto index = static_cast<std::size_t>(found - truth_.nodes.begin());
    if (found == truth_.nodes.end()) truth_.nodes.push_back(node);
    truth_.passes.push_back({index, way_.way_abreast(node.from, before.last_pose)});
  }

  bool came_around() const {
    for (std::size_t j = 0; j < followed_.size(); ++j) {
      const FollowedWall& again = followed_[j];
      const double way_m = way_.poses()[again.first_pose].way_m;
      if (wall_of(again).next == again.wall &&
          way_.poses()[again.last_pose].way_m - way_m >= std::max(wall_of(again).length_m, settings_.loop_m))
        return true;
      for (std::size_t i = 0; i < j; ++i) {
        const FollowedWall& first = followed_[i];
        if (first.wall == again.wall && first.first_along_m <= again.last_along_m &&
            again.first_along_m <= first.last_along_m &&
            way_m - way_.poses()[first.last_pose].way_m >= settings_.loop_m)
          return true;
      }
    }
    return false;
  }

  const FloorPlan& plan_;
  const DrivenWay& way_;
  const TruthSettings& settings_;
  std::vector<FollowedWall> followed_;
  TopologyTruth truth_;
};

}  // namespace

double TrueNode::distance_to(const Vec2& place) const {
  const Vec2 along = to - from;
  const double squared = along.squaredNorm();
  const double share = squared > 0.0 ? std::clamp(along.dot(place - from) / squared, 0.0, 1.0) : 0.0;
  return (from + share * along - place).norm();
}

TopologyTruth find_truth(const FloorPlan& plan, const DrivenWay& way, const TruthSettings& settings) {
  return TruthFinder(plan, way, settings).find();
}

}  // namespace hallway::eval
