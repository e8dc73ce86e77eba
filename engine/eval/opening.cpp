// SPDX-License-Identifier: MIT
#include "eval/opening.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hallway::eval {
namespace {

constexpr double kRoomSeen = 0.6;
constexpr double kDeepest = 2.5;  ///< times the width
constexpr double kWidest = 4.0;   ///< times the depth
constexpr double kEquallyNear_m = 1e-3;
constexpr double kAhead_m = 1e-6;  ///< what is nearer is at the wall's end itself

/// A frame at the end of a wall: x along the wall, y to its free side.
struct EndFrame {
  explicit EndFrame(const PlanWall& wall) : origin(wall.end()), along(wall.end_direction()) {}
  Vec2 local(const Vec2& point) const { return {along.dot(point - origin), cross(along, point - origin)}; }

  Vec2 origin, along;
};

/// The part of a segment, by its shares, that is within the strip |y| <= aside and x <= ahead. Coordinates are those of an end's frame.
class Clipped {
 public:
  Clipped(const Vec2& from, const Vec2& to, double aside_m, double ahead_m) : from_(from), to_(to) {
    keep(aside_m - from.y(), from.y() - to.y());
    keep(aside_m + from.y(), to.y() - from.y());
    keep(ahead_m - from.x(), from.x() - to.x());
  }

  bool is_empty() const { return low_ > high_; }
  double ahead(double share) const { return from_.x() + share * (to_.x() - from_.x()); }
  double aside(double share) const { return from_.y() + share * (to_.y() - from_.y()); }
  /// The share that is nearest to the end along the wall.
  double nearest() const { return to_.x() < from_.x() ? high_ : low_; }
  /// The share that is nearest to the wall's line.
  double most_in_line() const {
    const double slope = to_.y() - from_.y();
    return slope == 0.0 ? nearest() : std::clamp(-from_.y() / slope, low_, high_);
  }

 private:
  /// Leaves the shares where at_zero + slope * share >= 0.
  void keep(double at_zero, double slope) {
    if (slope > 0.0) {
      low_ = std::max(low_, -at_zero / slope);
    } else if (slope < 0.0) {
      high_ = std::min(high_, -at_zero / slope);
    } else if (at_zero < 0.0) {
      high_ = -1.0;
    }
  }

  Vec2 from_, to_;
  double low_ = 0.0, high_ = 1.0;
};

/// Which walls the boundary after a wall's end consists of until it leaves the strip or goes back: they are the edge of the opening, not its
/// far side.
std::vector<std::size_t> edge_walls(const FloorPlan& plan, std::size_t wall, double aside_m) {
  const EndFrame frame(plan.walls()[wall]);
  std::vector<std::size_t> edge;
  for (std::size_t at = plan.walls()[wall].next; at != PlanWall::kNone && at != wall;
       at = plan.walls()[at].next) {
    edge.push_back(at);
    const Vec2 end = frame.local(plan.walls()[at].end());
    if (edge.size() > plan.walls().size() || end.y() < -aside_m || end.x() < -aside_m) break;
  }
  return edge;
}

/// The opening's edge itself is the last one of the polygon.
struct Edge {
  Vec2 from, to;
};

/// How far along a ray an edge is; empty where the ray does not meet its line ahead.
std::optional<double> range_to(const Edge& edge, const Vec2& from, const Vec2& direction) {
  const Vec2 along = edge.to - edge.from;
  const double facing = cross(direction, along);
  if (facing <= 0.0) return std::nullopt;
  const double range = cross(edge.from - from, along) / facing;
  return range >= 0.0 ? std::optional(range) : std::nullopt;
}

/// The first edge that a ray meets.
const Edge* first_edge(const std::vector<Edge>& edges, const Vec2& from, const Vec2& direction) {
  const Edge* first = nullptr;
  double nearest = 0.0;
  for (const Edge& edge : edges) {
    if (cross(direction, edge.from - from) > 0.0 || cross(direction, edge.to - from) < 0.0) continue;
    const auto range = range_to(edge, from, direction);
    if (range && (first == nullptr || *range < nearest)) {
      first = &edge;
      nearest = *range;
    }
  }
  return first;
}

}  // namespace

bool opens_at_end(const FloorPlan& plan, std::size_t wall, double depth_m) {
  const EndFrame frame(plan.walls()[wall]);
  std::size_t at = plan.walls()[wall].next;
  const double ahead_m = depth_m + (at != PlanWall::kNone ? plan.walls()[at].bend_m : 0.0);
  for (std::size_t count = 0; at != PlanWall::kNone && count < plan.walls().size(); ++count) {
    for (const Vec2& point : plan.walls()[at].points) {
      const Vec2 local = frame.local(point);
      if (local.y() < -depth_m || local.x() < -depth_m) return true;
      if (local.y() > depth_m || local.x() > ahead_m) return false;
    }
    at = plan.walls()[at].next;
  }
  return false;
}

std::optional<Opening> find_opening(const FloorPlan& plan, std::size_t wall, double widest_m,
                                    double aside_m) {
  const EndFrame frame(plan.walls()[wall]);
  const std::vector<std::size_t> edge = edge_walls(plan, wall, aside_m);
  // Calls `visit` with each segment that may be the far side, as it is within the strip.
  const auto for_each = [&](double ahead_m, const auto& visit) {
    for (std::size_t w = 0; w < plan.walls().size(); ++w) {
      if (w == wall || std::ranges::find(edge, w) != edge.end()) continue;
      const std::vector<Vec2>& points = plan.walls()[w].points;
      double along_m = 0.0;
      for (std::size_t i = 1; i < points.size(); ++i) {
        const Clipped part(frame.local(points[i - 1]), frame.local(points[i]), aside_m, ahead_m);
        const double length_m = (points[i] - points[i - 1]).norm();
        if (!part.is_empty() && part.ahead(part.nearest()) > kAhead_m)
          visit(part, Opening{wall, w, along_m, points[i - 1], points[i]}, length_m);
        along_m += length_m;
      }
    }
  };
  std::optional<double> nearest_m;
  for_each(widest_m, [&](const Clipped& part, const Opening&, double) {
    nearest_m = std::min(nearest_m.value_or(widest_m), part.ahead(part.nearest()));
  });
  if (!nearest_m) return std::nullopt;
  // A door's far side is a whole segment that is equally near: its end in line with the wall counts, whatever rounding says.
  std::optional<Opening> best;
  double off_line_m = 0.0;
  for_each(*nearest_m + kEquallyNear_m, [&](const Clipped& part, Opening segment, double length_m) {
    const double share = part.most_in_line();
    const double aside = std::abs(part.aside(share));
    if (best && aside >= off_line_m - kAhead_m) return;
    off_line_m = aside;
    segment.far_along_m += share * length_m;
    segment.to = segment.from + share * (segment.to - segment.from);
    segment.from = frame.origin;
    best = segment;
  });
  return best;
}

std::vector<Vec2> region_behind(const FloorPlan& plan, const Opening& opening) {
  std::vector<Vec2> region{opening.from};
  const std::vector<PlanWall>& walls = plan.walls();
  std::size_t at = walls[opening.wall].next;
  for (std::size_t count = 0; at != opening.far_wall; at = walls[at].next) {
    if (at == PlanWall::kNone || at == opening.wall || ++count > walls.size()) return {};
    region.insert(region.end(), walls[at].points.begin() + 1, walls[at].points.end());
  }
  double along_m = 0.0;
  const std::vector<Vec2>& last = walls[opening.far_wall].points;
  for (std::size_t i = 1; i < last.size(); ++i) {
    along_m += (last[i] - last[i - 1]).norm();
    if (along_m >= opening.far_along_m) break;
    region.push_back(last[i]);
  }
  if (opening.far_along_m > 0.0) region.push_back(opening.to);
  if (region.size() < 3 || polygon_area(region) <= 0.0) return {};
  return region;
}

double seen_share(const std::vector<Vec2>& region) {
  std::vector<Edge> edges;
  for (std::size_t i = 1; i < region.size(); ++i) edges.push_back({region[i - 1], region[i]});
  const Vec2 eye = 0.5 * (region.front() + region.back());
  const Vec2 axis = (region.front() - region.back()).normalized();  // the region is on its left
  const auto ray = [&](double angle) -> Vec2 {
    return std::cos(angle) * axis + std::sin(angle) * Vec2(-axis.y(), axis.x());
  };
  std::vector<double> angles{0.0, std::numbers::pi};
  for (const Vec2& point : region) {
    const Vec2 from = point - eye;
    const double angle = std::atan2(cross(axis, from), axis.dot(from));
    if (angle > 0.0 && angle < std::numbers::pi) angles.push_back(angle);
  }
  std::ranges::sort(angles);
  // Between two corners next to each other one edge is seen, of which the two rays cut a triangle.
  double seen = 0.0;
  for (std::size_t i = 1; i < angles.size(); ++i) {
    const Edge* edge = first_edge(edges, eye, ray(0.5 * (angles[i - 1] + angles[i])));
    if (edge == nullptr) continue;
    const auto a = range_to(*edge, eye, ray(angles[i - 1])), b = range_to(*edge, eye, ray(angles[i]));
    if (a && b) seen += 0.5 * *a * *b * std::sin(angles[i] - angles[i - 1]);
  }
  return seen / polygon_area(region);
}

Behind what_is_behind(const FloorPlan& plan, const Opening& opening) {
  const std::vector<Vec2> region = region_behind(plan, opening);
  if (region.empty()) return Behind::kHallway;
  const Vec2 axis = -plan.walls()[opening.wall].end_direction();
  double left = 0.0, right = 0.0, deep = 0.0, front = 0.0;
  for (const Vec2& point : region) {
    const Vec2 from = point - region.back();
    left = std::min(left, axis.dot(from));
    right = std::max(right, axis.dot(from));
    front = std::min(front, cross(axis, from));
    deep = std::max(deep, cross(axis, from));
  }
  const double wide_m = right - left, deep_m = deep - front;
  if (deep_m > kDeepest * wide_m || wide_m > kWidest * deep_m) return Behind::kHallway;
  return seen_share(region) >= kRoomSeen ? Behind::kRoom : Behind::kHallway;
}

}  // namespace hallway::eval
