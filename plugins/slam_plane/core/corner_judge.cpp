// SPDX-License-Identifier: MIT
#include "slam_plane/core/corner_judge.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace hallway::slam_plane {
namespace {

constexpr double kNearerSigmas = 2.0;  // that something is nearer by, if it hides
constexpr double kLeastRange_m = 0.05;
constexpr double kAgreeSigmas = 3.0;     // of an end that is where the map has a corner
constexpr double kRecallSigmas = 2.5;    // by which a corner that the map tells is in view and not hidden
constexpr double kLeastNearer_m = 0.03;  // what hides is nearer by, where the map tells both
constexpr double kMostEnd_m =
    0.03;  // standard deviation of ends above which a cut beside a corner is not told from it
constexpr double kSightStep_m = 1.5;  // less than twice the reach of the map's index

/// Whether the map has a wall other than `own`, or nearly has one, across the way from one place to another.
bool crosses_a_wall(const WallMap& map, Index own, const Vec2& from, const Vec2& to) {
  bool crosses = false;
  const int steps = 1 + static_cast<int>((to - from).norm() / kSightStep_m);
  for (int i = 0; i <= steps && !crosses; ++i) {
    map.visit_near(from + (to - from) * (static_cast<double>(i) / steps), [&](Index w) {
      if (w == own || crosses) return;
      const WallEstimate& wall = map.walls[w].estimate;
      const double here = wall.basis.across(from), there = wall.basis.across(to);
      if (here * there >= 0.0 || std::abs(there) < kLeastNearer_m)
        return;  // one that meets there does not hide
      const double place = wall.basis.along(from + here / (here - there) * (to - from));
      crosses = place > wall.reach[kEndA] - kLeastNearer_m && place < wall.reach[kEndB] + kLeastNearer_m;
    });
  }
  return crosses;
}

}  // namespace

CornerJudge::CornerJudge(const Options& options)
    : noise_(options.noise()), sigmas_(options.corner_sigmas), margin_(radians(options.border_margin_deg)) {}

/// A place of the robot's frame on a wall of direction d, of which the standard deviations across and along the wall are given.
CornerJudge::EndView CornerJudge::view_of(const Vec2& p, const Vec2& d, double across, double along) {
  const double range = std::max(p.norm(), kLeastRange_m);
  const double cosine = d.dot(p) / range,
               sine = cross(d, p) / range;  // of the wall against the line of sight
  return {std::atan2(p.y(), p.x()),
          range,
          std::hypot(cosine * across, sine * along) / range,
          std::hypot(sine * across, cosine * along),
          std::hypot(d.y() * across, d.x() * along),
          Vec3::Zero()};
}

CornerJudge::EndView CornerJudge::view_end(const AssociatedObservation& observation, int end) const {
  double across = std::hypot(noise_.normal, 0.5 * observation.length * noise_.angle);
  double along = std::hypot(noise_.end, noise_.along);
  if (along > kMostEnd_m)
    across = along = std::hypot(across, along);  // wherever the last points happen to lie
  return view_of(observation.end[end], observation.direction, across, along);
}

bool CornerJudge::at_border(const View& view, const AssociatedObservation& observation, int end,
                            const EndView& seen) const {
  if (view.horizontal_fov_rad < 2.0 * std::numbers::pi) {
    const double inside = 0.5 * view.horizontal_fov_rad - std::abs(seen.bearing);
    if (inside < margin_ + sigmas_ * seen.bearing_sigma) return true;
  }
  if (view.max_range_m <= 0.0) return false;
  if (view.range_bounds_sides) return seen.range > view.max_range_m - sigmas_ * seen.range_sigma;
  return observation.end[end].x() > view.max_range_m - sigmas_ * seen.depth_sigma;
}

bool CornerJudge::behind_end(const EndView& seen, const EndView& other) const {
  const double nearer = kNearerSigmas * std::hypot(seen.range_sigma, other.range_sigma);
  if (other.range > seen.range - nearer) return false;
  const double turn = std::remainder(seen.bearing - other.bearing, 2.0 * std::numbers::pi);
  return std::abs(turn) < sigmas_ * std::hypot(seen.bearing_sigma, other.bearing_sigma);
}

/// Whether `hides(other)` is true of an end of another observation, of those next to it by bearing, as far as `reach`.
template <typename Hides>
bool CornerJudge::any_beside(std::size_t end, double reach, Hides hides) const {
  const EndView& seen = ends_[end];
  const std::size_t n = by_bearing_.size();
  for (const std::size_t step : {std::size_t{1}, n - 1}) {  // to the left and to the right, all round
    std::size_t at = place_[end];
    for (std::size_t i = 1; i < n; ++i) {
      at = (at + step) % n;
      const std::size_t other = by_bearing_[at];
      const double turn = std::remainder(ends_[other].bearing - seen.bearing, 2.0 * std::numbers::pi);
      if (std::abs(turn) > reach) break;
      if (other / 2 != end / 2 && hides(other)) return true;
    }
  }
  return false;
}

/// Whether an end lies behind that of another observation.
bool CornerJudge::is_hidden(std::size_t end) const {
  const EndView& seen = ends_[end];
  // As far as the widest doubt about any bearing reaches.
  const double reach = sigmas_ * (seen.bearing_sigma + widest_);
  return any_beside(end, reach, [&](std::size_t other) { return behind_end(seen, ends_[other]); });
}

void CornerJudge::judge(const View& view, std::vector<AssociatedObservation>& frame) const {
  ends_.clear();
  widest_ = 0.0;
  for (const AssociatedObservation& observation : frame) {
    for (const int end : {kEndA, kEndB}) {
      ends_.push_back(view_end(observation, end));
      widest_ = std::max(widest_, ends_.back().bearing_sigma);
    }
  }
  by_bearing_.resize(ends_.size());
  std::iota(by_bearing_.begin(), by_bearing_.end(), std::size_t{0});
  std::ranges::sort(by_bearing_, [&](std::size_t a, std::size_t b) {
    return std::pair(ends_[a].bearing, a) < std::pair(ends_[b].bearing, b);
  });
  place_.resize(ends_.size());
  for (std::size_t i = 0; i < by_bearing_.size(); ++i) place_[by_bearing_[i]] = i;
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    AssociatedObservation& observation = frame[i / 2];
    const int end = static_cast<int>(i % 2);
    const bool cut = at_border(view, observation, end, ends_[i]);
    observation.hidden[end] = !cut && is_hidden(i);
    observation.corner[end] = !cut && !observation.hidden[end];
  }
}

/// Whether an end is seen where the wall has its corner.
bool CornerJudge::agrees(const AssociatedObservation& observation, int end, const WallEstimate& wall,
                         const Located& at) const {
  const Vec2 place = at.T_map_robot * observation.end[end];
  const Vec2& d = wall.basis.direction;
  const Vec3 row(d.x(), d.y(), d.dot(left_of(place - at.T_map_robot.t)));
  const double variance = noise_.end_variance() + wall.variance[end] + row.dot(at.covariance * row);
  const double off = wall.basis.along(place) - wall.end[end];
  return off * off <= kAgreeSigmas * kAgreeSigmas * variance;
}

/// Where the map has a corner, as it is seen from the robot.
CornerJudge::EndView CornerJudge::expect_end(const Vec2& corner, int end, const WallEstimate& wall,
                                             const Located& at) const {
  const Vec2 p = at.T_map_robot.inverse() * corner;
  EndView expected = view_of(p, at.T_map_robot.unrotate(wall.basis.direction),
                             std::sqrt(wall.variance_at(wall.end[end])), std::sqrt(wall.variance[end]));
  const Vec2 sideways = at.T_map_robot.rotate(left_of(p)) / (expected.range * expected.range);
  expected.lever = Vec3(-sideways.x(), -sideways.y(), -1.0);
  return expected;
}

bool CornerJudge::is_in_view(const View& view, std::size_t end, const Located& at) const {
  const EndView& seen = ends_[end];
  if (view.horizontal_fov_rad < 2.0 * std::numbers::pi) {
    const double sigma =
        std::sqrt(seen.bearing_sigma * seen.bearing_sigma + seen.lever.dot(at.covariance * seen.lever));
    if (0.5 * view.horizontal_fov_rad - std::abs(seen.bearing) < kRecallSigmas * sigma) return false;
  }
  if (view.max_range_m <= 0.0) return true;
  const double step2 = at.covariance(0, 0) + at.covariance(1, 1);
  const double depth = view.range_bounds_sides ? seen.range : seen.range * std::cos(seen.bearing);
  const double sigma = view.range_bounds_sides ? seen.range_sigma : seen.depth_sigma;
  return depth < view.max_range_m - kRecallSigmas * std::sqrt(sigma * sigma + step2);
}

/// Whether nothing nearer reaches the bearing of an end. Of two places that the map tells, the robot's own moves both alike.
bool CornerJudge::is_in_front(std::size_t end, const Located& at) const {
  const EndView& seen = ends_[end];
  const double reach = sigmas_ * (seen.bearing_sigma + widest_);
  return !any_beside(end, reach, [&](std::size_t i) {
    const EndView& other = ends_[i];
    const double nearer =
        std::max(kLeastNearer_m, kNearerSigmas * std::hypot(seen.range_sigma, other.range_sigma));
    if (other.range > seen.range - nearer) return false;
    const Vec3 lever = seen.lever - other.lever;
    const double variance = seen.bearing_sigma * seen.bearing_sigma +
                            other.bearing_sigma * other.bearing_sigma + lever.dot(at.covariance * lever);
    const double turn = std::remainder(seen.bearing - other.bearing, 2.0 * std::numbers::pi);
    const double outside =
        i % 2 == kEndA ? turn : -turn;  // of the observation that the other one is an end of
    return outside < kRecallSigmas * std::sqrt(variance);
  });
}

bool CornerJudge::recall(const View& view, const WallMap& map, const Located& at,
                         std::vector<AssociatedObservation>& frame) const {
  if (std::hypot(noise_.end, noise_.along) > kMostEnd_m) return false;
  mapped_.assign(ends_.size(), false);
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    const AssociatedObservation& observation = frame[i / 2];
    const int end = static_cast<int>(i % 2);
    if (!observation.is_evidence()) continue;
    const WallEstimate& wall = map.walls[observation.wall].estimate;
    if (!wall.known[end] || !agrees(observation, end, wall, at)) continue;
    ends_[i] = expect_end(wall.basis.point(wall.end[end]), end, wall, at);
    mapped_[i] = true;
  }
  bool any = false;
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    AssociatedObservation& observation = frame[i / 2];
    const std::size_t end = i % 2;
    if (!mapped_[i] || observation.corner[end] || !is_in_view(view, i, at) || !is_in_front(i, at)) continue;
    const WallEstimate& wall = map.walls[observation.wall].estimate;
    // What hides may be seen too little of to be told, as at the border of the view.
    if (crosses_a_wall(map, observation.wall, at.T_map_robot.t, wall.basis.point(wall.end[end]))) continue;
    observation.corner[end] = any = true;
    observation.hidden[end] = false;
  }
  return any;
}

}  // namespace hallway::slam_plane
