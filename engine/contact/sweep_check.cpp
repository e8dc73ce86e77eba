// SPDX-License-Identifier: MIT
#include "contact/sweep_check.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::contact {
namespace {

/// No gap at the end of a part is smaller, metres.
constexpr double kLeastProvedGap = 1e-7;
/// How much a gap below the wanted one may shrink in a part.
constexpr double kShrink = 1e-9;
constexpr int kMostHalvings = 10;

/// How far two boxes are apart along the axis on which they are farthest, negative where they overlap.
double box_gap(const Box& a, const Box& b) {
  return std::max((a.min() - b.max()).maxCoeff(), (b.min() - a.max()).maxCoeff());
}

bool same_pose(const Pose& a, const Pose& b) {
  return a.t == b.t && a.q.coeffs() == b.q.coeffs();
}

}  // namespace

const Separation& SweepCheck::at(const Pose& pose, std::uint32_t obstacle) {
  if (!same_pose(pose, at_)) {
    known_.clear();
    at_ = pose;
  }
  const auto [place, is_new] = known_.try_emplace(obstacle);
  if (is_new) place->second = separate(shape_, pose, obstacles_.triangle(obstacle));
  return place->second;
}

std::vector<std::uint32_t> SweepCheck::within(const Pose& pose, double range) {
  Box box = shape_.box_at(pose);
  box.min().array() -= range;
  box.max().array() += range;
  std::vector<std::uint32_t> found;
  obstacles_.near(box, found);
  std::erase_if(found, [&](std::uint32_t obstacle) { return at(pose, obstacle).gap > range; });
  return found;
}

std::optional<std::uint32_t> SweepCheck::blocker(const Part& part, double least) {
  // On a chord every point of the body is between the boxes of both ends.
  Box box = shape_.box_at(part.from);
  box.extend(shape_.box_at(part.to));
  const double bent = bend(part, shape_.radius()), apart = bent + least + 1e-9;
  Box search = box;
  search.min().array() -= apart;
  search.max().array() += apart;
  std::vector<std::uint32_t> near;
  obstacles_.near(search, near);
  std::optional<std::uint32_t> found;
  for (const std::uint32_t obstacle : near) {
    if (box_gap(box, obstacles_.box(obstacle)) > apart || is_free(part, obstacle, least)) continue;
    if (!found || at(part.from, obstacle).gap < at(part.from, *found).gap) found = obstacle;
  }
  return found;
}

bool SweepCheck::is_free(const Part& part, std::uint32_t obstacle, double least) {
  const Separation& first = at(part.from, obstacle);
  const Separation last = separate(shape_, part.to, obstacles_.triangle(obstacle), first.normal);
  const double needed = std::max(kLeastProvedGap, std::min(least, first.gap - kShrink));
  if (first.gap <= 0.0 || last.gap < needed) return false;
  return is_free(part, obstacle, 0.0, 1.0, first.normal, last.normal, kMostHalvings);
}

bool SweepCheck::is_free(const Part& part, std::uint32_t obstacle, double s0, double s1, const Vec3& n0,
                         const Vec3& n1, int halvings) const {
  const Triangle& triangle = obstacles_.triangle(obstacle);
  const Pose a = pose_in(part, s0), b = pose_in(part, s1);
  const double bent = bend(part, shape_.radius()) * (s1 - s0) * (s1 - s0);
  const double begin = gap_along(shape_, a, triangle, n0), end = gap_along(shape_, b, triangle, n1);
  if (begin <= 0.0 || end <= 0.0) return false;
  if (std::min(begin, gap_along(shape_, b, triangle, n0)) > bent) return true;
  if (std::min(gap_along(shape_, a, triangle, n1), end) > bent) return true;
  const double moved = (b.t - a.t).norm() + shape_.radius() * turning(part) * (s1 - s0);
  if (std::min(begin, end) > bent + 0.25 * (n1 - n0).norm() * moved) return true;
  if (halvings == 0) return false;
  const double middle = 0.5 * (s0 + s1);
  const Separation half = separate(shape_, pose_in(part, middle), triangle, n0 + n1);
  return half.gap > 0.0 && is_free(part, obstacle, s0, middle, n0, half.normal, halvings - 1) &&
         is_free(part, obstacle, middle, s1, half.normal, n1, halvings - 1);
}

}  // namespace hallway::contact
