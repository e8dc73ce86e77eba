// SPDX-License-Identifier: MIT
#include "em/core/candidate.hpp"

#include <algorithm>

namespace hallway::em {

bool OrientedBox::touches(const Vec3& middle, const Vec3& half_sides) const {
  const Vec3 d = middle - centre;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double reach = half[static_cast<Eigen::Index>(i)] + axes[i].cwiseAbs().dot(half_sides);
    // A little more than touching, lest rounding shut out what contains() lets in.
    if (std::abs(axes[i].dot(d)) > reach * (1.0 + 1e-9)) return false;
  }
  return true;
}

bool maximise(Candidate& plane, std::span<const Vec3> points) {
  Moments moments;
  std::vector<Vec3> members;
  members.reserve(plane.members.size());
  for (const std::uint32_t i : plane.members) {
    moments.add(points[i]);
    members.push_back(points[i]);
  }
  const auto fit = fit_plane(moments);
  if (!fit) return false;
  plane.fit = *fit;
  plane.outline = outline_of(members, fit->normal, fit->centroid);
  return true;
}

std::optional<Candidate> plane_through(std::span<const Vec3> points, std::vector<std::uint32_t> three) {
  Candidate plane;
  plane.members = std::move(three);
  std::sort(plane.members.begin(), plane.members.end());
  if (!maximise(plane, points)) return std::nullopt;
  return plane;
}

OrientedBox matching_space(const Candidate& plane, double expansion, double distance) {
  const Rectangle& bounds = plane.outline.rectangle;
  const PlaneFrame& frame = plane.outline.frame;
  OrientedBox box;
  box.centre = frame.lift(bounds.centre);
  box.axes[0] = bounds.axis.x() * frame.u + bounds.axis.y() * frame.v;
  box.axes[1] = bounds.side().x() * frame.u + bounds.side().y() * frame.v;
  box.axes[2] = plane.fit.normal;
  box.half = Vec3(bounds.half_u + expansion, bounds.half_v + expansion, distance);
  return box;
}

std::vector<std::uint32_t> count_uses(const std::vector<Candidate>& planes, std::size_t points) {
  std::vector<std::uint32_t> uses(points, 0);
  for (const Candidate& plane : planes) {
    for (const std::uint32_t i : plane.members) ++uses[i];
  }
  return uses;
}

double exclusive_share(const Candidate& plane, const std::vector<std::uint32_t>& uses) {
  if (plane.members.empty()) return 0.0;
  const auto own = std::count_if(plane.members.begin(), plane.members.end(),
                                 [&](std::uint32_t i) { return uses[i] == 1; });
  return static_cast<double>(own) / static_cast<double>(plane.members.size());
}

void drop_shared(std::vector<Candidate>& planes, std::size_t points, double least) {
  std::vector<std::uint32_t> uses = count_uses(planes, points);
  while (true) {
    std::size_t worst = planes.size();
    double worst_share = least;
    for (std::size_t i = 0; i < planes.size(); ++i) {
      if (planes[i].fresh) continue;
      const double share = exclusive_share(planes[i], uses);
      const bool tied = worst < planes.size() && share == worst_share;
      if (share < worst_share || (tied && planes[i].members.size() < planes[worst].members.size())) {
        worst = i;
        worst_share = share;
      }
    }
    if (worst == planes.size()) return;
    for (const std::uint32_t i : planes[worst].members) --uses[i];
    planes.erase(planes.begin() + static_cast<std::ptrdiff_t>(worst));
  }
}

}  // namespace hallway::em
