// SPDX-License-Identifier: MIT
#include "wall_follower/core/explorer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wall_follower/core/circuits.hpp"
#include "wall_follower/core/sweep_rule.hpp"

namespace hallway::wall_follower {
namespace {

constexpr double kSpacing = 0.2;     // of the points of an outline [m]
constexpr double kLeastDepth = 0.7;  // an exit is free for that far [m]
constexpr double kFarthest = 10.0;   // a ray without an echo is that long [m]
constexpr double kNear =
    1.2;  // a ray that ends so near another wall has met it: the ways to both have errors [m]
constexpr double kBeyond =
    0.6;  // a ray goes on by this: the sonar hears the nearest of what is in its cone [m]
constexpr double kNearItself = 0.5;  // likewise, of the wall where it begins [m]
constexpr double kJustAhead = 0.5;   // an exit nearer than this may be behind [m]
constexpr std::size_t kMostExits = 512;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// How far along a ray, as a share of it, a segment crosses it.
std::optional<double> crosses(const Vec2& from, const Vec2& ray, const Vec2& a, const Vec2& b) {
  const Vec2 side = b - a;
  const double area = cross(ray, side);
  if (std::abs(area) < 1e-9) return std::nullopt;
  const double along = cross(a - from, side) / area, within = cross(a - from, ray) / area;
  const bool is_met = along >= 0.0 && along <= 1.0 && within >= 0.0 && within <= 1.0;
  return is_met ? std::optional(along) : std::nullopt;
}

double distance_to(const Vec2& point, const Vec2& a, const Vec2& b) {
  const Vec2 side = b - a;
  const double share = std::clamp(side.dot(point - a) / std::max(side.squaredNorm(), 1e-9), 0.0, 1.0);
  return (a + share * side - point).norm();
}

}  // namespace

void Explorer::begin() {
  wall_.clear();
  std::erase_if(exits_, [](const Exit& exit) { return !exit.circuit; });
}

void Explorer::forget(double from_m) {
  std::erase_if(wall_, [&](const Point& point) { return point.way_m > from_m; });
  std::erase_if(exits_, [&](const Exit& exit) { return !exit.circuit && exit.way_m > from_m; });
}

void Explorer::see_wall(const Vec2& at, double way_m) {
  if (!wall_.empty() && (wall_.back().at - at).norm() < kSpacing) return;
  wall_.push_back({at, way_m});
}

void Explorer::see_exits(const Sweep& sweep, const Vec2& from, int quarter, double slant, double way_m,
                         bool is_hallway) {
  name_exits(std::nullopt);
  if (exits_.size() >= kMostExits) return;
  for (const int turn : {1, 0, -1}) {
    if (turn == 0 && !is_hallway) continue;  // along the wall the sonar hears the wall
    const double depth = view_of(sweep, turn * kQuarter - slant, options_).depth_m;
    if (depth < kLeastDepth) continue;
    exits_.push_back({from, quarter, turn, std::min(depth, kFarthest), way_m, {}, {}, false, 0});
  }
}

void Explorer::name_exits(std::optional<std::uint32_t> node) {
  if (node) {
    for (Exit& exit : exits_) {
      if (!exit.circuit && !exit.node) exit.node = node;
    }
  } else {
    std::erase_if(exits_, [](const Exit& exit) { return !exit.node; });
  }
}

void Explorer::close(double from_m, double to_m, const Vec2& correction, bool is_around) {
  const std::size_t circuit = outlines_.size();
  Outline& outline = outlines_.emplace_back();
  outline.from_m = from_m;
  outline.length_m = to_m - from_m;
  outline.is_around = is_around;
  for (const Point& point : wall_) {
    if (point.way_m < from_m || point.way_m > to_m) continue;
    outline.points.push_back({point.at + share_of(correction, from_m, to_m, point.way_m), point.way_m});
  }
  name_exits(std::nullopt);
  for (Exit& exit : exits_) {
    if (exit.circuit || exit.way_m < from_m || exit.way_m > to_m) continue;
    exit.circuit = circuit;
    exit.from += share_of(correction, from_m, to_m, exit.way_m);
  }
  begin();
}

std::optional<Landing> Explorer::landing(const Exit& exit) const {
  std::optional<Landing> crossed, near;
  double least_share = 1.0, least_off = std::numeric_limits<double>::infinity();
  const Vec2 ray = exit.depth_m * exit.direction();
  const Vec2 end = exit.from + ray;
  const Vec2 longer = ray + kBeyond * exit.direction();
  for (std::size_t circuit = 0; circuit < outlines_.size(); ++circuit) {
    if (exit.turn < 0 && exit.circuit == circuit) continue;  // the ray begins in an opening of that wall
    const std::vector<Point>& points = outlines_[circuit].points;
    const double gate = exit.circuit == circuit ? kNearItself : kNear;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Point& a = points[i];
      const Point& b = points[(i + 1) % points.size()];
      const Landing here{circuit, a.way_m - outlines_[circuit].from_m};
      const std::optional<double> share = crosses(exit.from, longer, a.at, b.at);
      if (share && *share < least_share) {
        least_share = *share;
        crossed = here;
      }
      const double off = distance_to(end, a.at, b.at);
      if (off < gate && off < least_off) {
        least_off = off;
        near = here;
      }
    }
  }
  return crossed ? crossed : near;
}

double Explorer::ahead_m(std::size_t circuit, double from_m, double to_m) const {
  const double lap = std::max(outlines_[circuit].length_m, 1e-9);
  const double ahead = std::fmod(to_m - from_m, lap);
  return ahead < 0.0 ? ahead + lap : ahead;
}

bool Explorer::is_room(std::size_t circuit) const {
  return outlines_[circuit].is_around && std::ranges::all_of(exits_, [&](const Exit& exit) {
           if (exit.circuit != circuit || exit.turn < 0) return true;
           const std::optional<Landing> to = landing(exit);
           return to && to->circuit == circuit;
         });
}

bool Explorer::is_aim(const Exit& exit) const {
  return exit.circuit && !exit.is_tried && (exit.turn >= 0 || is_room(*exit.circuit));
}

std::size_t Explorer::left() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(exits_, [&](const Exit& exit) { return is_aim(exit) && !landing(exit); }));
}

std::optional<Route> Explorer::next(std::size_t circuit, double station_m, Exploration rule) const {
  if (rule == Exploration::none) return std::nullopt;
  struct Step {
    double cost = std::numeric_limits<double>::infinity();  // to the exit
    std::size_t first = 0;                                  // exit of the present wall on the way
    bool is_open = true;
  };
  std::vector<Step> steps(exits_.size());
  std::vector<std::optional<Landing>> landings;
  for (const Exit& exit : exits_) landings.push_back(landing(exit));
  for (std::size_t i = 0; i < exits_.size(); ++i) {
    if (exits_[i].circuit != circuit) continue;
    steps[i].cost = ahead_m(circuit, station_m, this->station_m(exits_[i]));
    if (steps[i].cost < kJustAhead) steps[i].cost += outlines_[circuit].length_m;
    steps[i].first = i;
  }
  std::optional<Route> best;
  const auto is_aimed_at = [&](std::size_t i) { return !landings[i] && is_aim(exits_[i]); };
  if (rule == Exploration::right_hand) {
    std::optional<std::size_t> ahead;
    const auto is_before = [&](std::size_t a, std::size_t b) {
      const bool is_through = exits_[a].turn < 0;
      return is_through != (exits_[b].turn < 0) ? !is_through : steps[a].cost < steps[b].cost;
    };
    for (std::size_t i = 0; i < exits_.size(); ++i) {
      if (exits_[i].circuit == circuit && is_aimed_at(i) && (!ahead || is_before(i, *ahead))) ahead = i;
    }
    if (ahead)
      return Route{*ahead, std::nullopt, steps[*ahead].cost, steps[*ahead].cost + exits_[*ahead].depth_m};
  }
  for (;;) {
    // The exit with the least way to it (Dijkstra, 1959).
    std::optional<std::size_t> nearest;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (steps[i].is_open && std::isfinite(steps[i].cost) &&
          (!nearest || steps[i].cost < steps[*nearest].cost))
        nearest = i;
    }
    if (!nearest || (best && best->cost_m <= steps[*nearest].cost)) return best;
    Step& step = steps[*nearest];
    step.is_open = false;
    const Exit& exit = exits_[*nearest];
    if (is_aimed_at(*nearest)) {
      const double cost = step.cost + exit.depth_m;
      if (!best || cost < best->cost_m)
        best = Route{step.first, landings[step.first], steps[step.first].cost, cost};
    } else if (landings[*nearest] && !exit.is_tried) {
      const Landing& to = *landings[*nearest];
      for (std::size_t i = 0; i < exits_.size(); ++i) {
        if (exits_[i].circuit != to.circuit || !steps[i].is_open) continue;
        const double cost =
            step.cost + exit.depth_m + ahead_m(to.circuit, to.station_m, this->station_m(exits_[i]));
        if (cost < steps[i].cost) steps[i] = {cost, step.first, true};
      }
    }
  }
}

}  // namespace hallway::wall_follower
