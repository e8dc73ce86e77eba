// SPDX-License-Identifier: MIT
#include "em/core/plane_merge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "geometry/intervals.hpp"

namespace hallway::em {
namespace {

Interval shadow(const std::array<Vec3, 4>& corners, const Vec3& axis) {
  Interval interval{axis.dot(corners[0]), axis.dot(corners[0])};
  for (const Vec3& corner : corners) {
    interval.from = std::min(interval.from, axis.dot(corner));
    interval.to = std::max(interval.to, axis.dot(corner));
  }
  return interval;
}

std::array<Vec3, 2> sides_of(const Outline& outline) {
  const Vec2 axis = outline.rectangle.axis;
  const Vec2 side = outline.rectangle.side();
  return {axis.x() * outline.frame.u + axis.y() * outline.frame.v,
          side.x() * outline.frame.u + side.y() * outline.frame.v};
}

std::vector<std::uint32_t> union_of(const std::vector<std::uint32_t>& a,
                                    const std::vector<std::uint32_t>& b) {
  std::vector<std::uint32_t> both;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

// Merges `planes[i]` with all that it is alike to; true if there was one.
bool absorb(std::vector<Candidate>& planes, std::size_t i, std::span<const Vec3> points,
            const MergeBounds& bounds) {
  bool any = false;
  for (std::size_t j = i + 1; j < planes.size();) {
    if (!mergeable(planes[i], planes[j], bounds)) {
      ++j;
      continue;
    }
    planes[i].members = union_of(planes[i].members, planes[j].members);
    planes[i].fresh = planes[i].fresh && planes[j].fresh;
    maximise(planes[i], points);
    planes.erase(planes.begin() + static_cast<std::ptrdiff_t>(j));
    any = true;
  }
  return any;
}

}  // namespace

bool outlines_meet(const Outline& a, const Outline& b, double gap) {
  const std::array<Vec3, 4> corners_a = corners_of(a);
  const std::array<Vec3, 4> corners_b = corners_of(b);
  for (const Outline* outline : {&a, &b}) {
    for (const Vec3& axis : sides_of(*outline)) {
      const Interval on_a = shadow(corners_a, axis);
      const Interval on_b = shadow(corners_b, axis);
      if (std::max(on_a.from, on_b.from) - std::min(on_a.to, on_b.to) > gap) return false;
    }
  }
  return true;
}

bool mergeable(const Candidate& a, const Candidate& b, const MergeBounds& bounds) {
  if (std::abs(a.fit.normal.dot(b.fit.normal)) < bounds.cos_angle) return false;
  const bool a_larger = a.members.size() >= b.members.size();
  const Candidate& larger = a_larger ? a : b;
  const Candidate& smaller = a_larger ? b : a;
  if (std::abs(larger.fit.distance(smaller.fit.centroid)) > bounds.offset) return false;
  return outlines_meet(a.outline, b.outline, bounds.gap);
}

void merge_alike(std::vector<Candidate>& planes, std::span<const Vec3> points, const MergeBounds& bounds) {
  bool again = true;
  while (again) {
    again = false;
    for (std::size_t i = 0; i < planes.size(); ++i) again = absorb(planes, i, points, bounds) || again;
  }
}

}  // namespace hallway::em
