// SPDX-License-Identifier: MIT
#include "plane_list.hpp"

#include <algorithm>
#include <utility>

#include "em/core/plane_fit.hpp"
#include "em/core/plane_shape.hpp"

namespace hallway::peers {
namespace {

void copy(const Vec3& from, double (&to)[3]) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

}  // namespace

void PlaneList::add(const std::vector<Vec3>& points, Members members) {
  if (members.empty()) return;
  std::sort(members.begin(), members.end());
  const Vec3 reference = points[members.front()];
  em::Moments moments;
  std::vector<Vec3> own;
  own.reserve(members.size());
  for (const std::uint32_t i : members) {
    own.push_back(points[i]);
    moments.add(points[i] - reference);
  }
  const auto fit = em::fit_plane(moments);
  if (!fit) return;
  const Vec3 centroid = fit->centroid + reference;
  const Vec3 normal = em::orient(fit->normal, centroid);
  const em::Outline outline = em::outline_of(own, normal, centroid);

  hw_plane_t plane{};
  plane.id = planes_.size();
  copy(normal, plane.normal);
  plane.offset_m = std::min(0.0, normal.dot(centroid));
  copy(centroid, plane.centroid);
  const auto corners = em::corners_of(outline);
  for (std::size_t c = 0; c < corners.size(); ++c) copy(corners[c], plane.corners[c]);
  plane.n_points = members.size();
  plane.rms_m = fit->rms();
  plane.exclusive_share = 1.0;  // none of the peers lets planes share points
  plane.first_hull = hull_.size();
  for (const Vec3& p : em::hull_of(outline)) hull_.push_back({p.x(), p.y(), p.z()});
  plane.n_hull = hull_.size() - plane.first_hull;
  plane.first_member = members_.size();
  plane.n_members = members.size();
  members_.insert(members_.end(), members.begin(), members.end());
  planes_.push_back(plane);
}

void PlaneList::put(const sdk::Host& host, std::uint32_t sample) const {
  host.put_planes(sample, planes_, hull_, members_);
}

}  // namespace hallway::peers
