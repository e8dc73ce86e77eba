// SPDX-License-Identifier: MIT
#include "em/core/growth_ahead.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace hallway::em {
namespace {

constexpr std::size_t kAhead = 2;  // seeds by thread that are grown at a time
// Seeds of one plane are not grown at the same time: once one of them is accepted, the others are not needed.
constexpr double kAlike = 0.9;  // cosine of the angle between their planes, at least ...
constexpr double kOffPlane =
    0.1;  // ... and the distance from each other's plane by that between them, at most

bool lies_on(const Vec3& p, const PlaneFrame& plane, double sigma) {
  const Vec3 from = p - plane.origin;
  return std::abs(plane.normal.dot(from)) <= kSlabSigmas * sigma + kOffPlane * from.norm();
}

bool alike(const Seed& left, const Seed& right, double sigma) {
  return std::abs(left.frame.normal.dot(right.frame.normal)) >= kAlike &&
         lies_on(left.frame.origin, right.frame, sigma) && lies_on(right.frame.origin, left.frame, sigma);
}

/// Of the members of what grew, over its plane.
std::vector<double> heights_of(const PointField& field, const Grown& grown) {
  std::vector<double> heights;
  heights.reserve(grown.members.size());
  for (const std::uint32_t i : grown.members) heights.push_back(grown.frame.height(field.points.at(i)));
  return heights;
}

}  // namespace

Attempt GrowthAhead::take(std::size_t number, std::size_t left) {
  std::erase_if(ahead_, [number](const Attempt& attempt) { return attempt.number < number; });
  if (ahead_.empty() || ahead_.front().number != number || stale(ahead_.front())) grow_from(number, left);
  Attempt taken = std::move(ahead_.front());
  ahead_.erase(ahead_.begin());
  return taken;
}

void GrowthAhead::grow_from(std::size_t number, std::size_t left) {
  const std::size_t wanted = workers_.count() > 1 ? std::min(kAhead * workers_.count(), left) : 1;
  std::erase_if(ahead_, [this](const Attempt& attempt) { return stale(attempt); });
  std::vector<std::size_t> chosen;  // those that are grown already and those that are to be
  std::vector<Attempt> batch;
  for (std::size_t next = number; next < trial_.count && chosen.size() < wanted; ++next) {
    const bool grown = std::any_of(ahead_.begin(), ahead_.end(),
                                   [next](const Attempt& attempt) { return attempt.number == next; });
    if (!grown && next != number && (trial_.skip(next) || may_be_one(next, chosen))) continue;
    chosen.push_back(next);
    if (grown) continue;
    batch.emplace_back();
    batch.back().number = next;
  }
  workers_.run(batch.size(), [&](std::size_t k, std::size_t) { grow(batch[k]); });
  std::move(batch.begin(), batch.end(), std::back_inserter(ahead_));
  std::sort(ahead_.begin(), ahead_.end(),
            [](const Attempt& a, const Attempt& b) { return a.number < b.number; });
}

bool GrowthAhead::stale(const Attempt& attempt) const {
  return std::any_of(attempt.grown.relied_on.begin(), attempt.grown.relied_on.end(),
                     [this](std::uint32_t i) { return claimed_[i] != 0; });
}

bool GrowthAhead::may_be_one(std::size_t number, const std::vector<std::size_t>& others) const {
  return std::any_of(others.begin(), others.end(), [&](std::size_t other) {
    return alike(trial_.likely(number), trial_.likely(other), growth_.sigma);
  });
}

void GrowthAhead::grow(Attempt& attempt) const {
  attempt.seed = trial_.seed(attempt.number);
  if (!attempt.seed) return;
  Grower grower(field_, claimed_);
  attempt.grown = growth_.flat ? grower.grow_flat(*attempt.seed, growth_.sigma)
                               : grower.grow(*attempt.seed, growth_.sigma);
  if (attempt.grown.members.size() < growth_.min_points) return;
  attempt.sheets = two_sheets(heights_of(field_, attempt.grown), growth_.min_points);
  if (!attempt.sheets || !(attempt.sheets->noise > 0.0))
    attempt.beside = surroundings_of(field_, claimed_, attempt.grown);
}

}  // namespace hallway::em
