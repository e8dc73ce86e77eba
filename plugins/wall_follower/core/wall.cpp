// SPDX-License-Identifier: MIT
#include "wall_follower/core/wall.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/median.hpp"

namespace hallway::wall_follower {
namespace {

constexpr std::size_t kLeastPoints = 3;  // of which a line's position is certain
constexpr double kTurnPerPoint = 0.02;   // the expected direction follows the fitted one by this share
constexpr double kPrior = 0.25;  // a fit over this length counts half, the expected direction half [m]

}  // namespace

void Wall::expect(const Vec2& at, double direction) {
  at_ = at;
  direction_ = expected_ = direction;
  points_.clear();
  pending_.clear();
}

double Wall::behind(const Vec2& point) const {
  const Vec2 u = unit(direction_);
  const Vec2 d = point - at_;
  return u.y() * d.x() - u.x() * d.y();
}

double Wall::distance(const Vec2& from) const {
  return -behind(from);
}

double Wall::extent() const {
  if (points_.size() < 2) return 0.0;
  return std::abs(unit(direction_).dot(points_.back().at - points_.front().at));
}

std::optional<Step> Wall::add(const WallPoint& point) {
  const double offset = behind(point.at);
  const bool is_known = points_.size() >= kLeastPoints;
  if (is_known && std::abs(offset) > options_.least_step_m) {
    if (!pending_.empty() && behind(pending_.back().at) * offset < 0.0) pending_.clear();
    pending_.push_back(point);
    if (point.way_m - pending_.front().way_m < options_.confirm_m || pending_.size() < kLeastPoints)
      return std::nullopt;
    std::vector<double> offsets;
    for (const WallPoint& one : pending_) offsets.push_back(behind(one.at));
    const double size = median(offsets);
    Step step{size > 0.0 ? 1 : -1, std::abs(size), pending_.front()};
    points_.swap(pending_);
    pending_.clear();
    expected_ = direction_;
    fit();
    return step;
  }
  pending_.clear();
  points_.push_back(point);
  while (points_.back().way_m - points_.front().way_m > options_.fit_m) points_.pop_front();
  fit();
  return std::nullopt;
}

void Wall::fit() {
  Vec2 middle = Vec2::Zero();
  for (const WallPoint& point : points_) middle += point.at;
  middle /= static_cast<double>(points_.size());
  const Vec2 u = unit(expected_);
  double along2 = 0.0, along_across = 0.0, least = 0.0, most = 0.0;
  for (const WallPoint& point : points_) {
    const Vec2 d = point.at - middle;
    const double along = u.dot(d), across = u.x() * d.y() - u.y() * d.x();
    along2 += along * along;
    along_across += along * across;
    least = std::min(least, along);
    most = std::max(most, along);
  }
  at_ = middle;
  const double length = most - least;
  const double share = length * length / (length * length + kPrior * kPrior);
  direction_ = expected_;
  if (along2 > 1e-6) direction_ += share * std::atan(along_across / along2);
  expected_ += kTurnPerPoint * (direction_ - expected_);
}

}  // namespace hallway::wall_follower
