// SPDX-License-Identifier: MIT
#include "icp/core/point_map.hpp"

namespace hallway::icp {

std::optional<std::uint32_t> PointMap::known_near(const Vec3& p) const {
  std::optional<std::uint32_t> best;
  double best2 = separation_m_ * separation_m_;
  grid_.visit_near(p, [&](std::uint32_t number) {
    const double distance2 = (first_seen_[number] - p).squaredNorm();
    if (distance2 < best2 || (distance2 == best2 && (!best || number < *best))) {
      best = number;
      best2 = distance2;
    }
  });
  return best;
}

std::uint64_t PointMap::add(const Vec3& p) {
  const std::optional<std::uint32_t> known = known_near(p);
  if (!known) {
    grid_.add(p);
    first_seen_.push_back(p);
    landmarks_.push_back({p, 1});
    return landmarks_.size() - 1;
  }
  Landmark& landmark = landmarks_[*known];
  ++landmark.observations;
  landmark.position += (p - landmark.position) / static_cast<double>(landmark.observations);
  return *known;
}

Points PointMap::near(const Vec3& place, double radius_m) const {
  Points found;
  for (const Landmark& landmark : landmarks_) {
    if ((landmark.position - place).squaredNorm() <= radius_m * radius_m) found.push_back(landmark.position);
  }
  return found;
}

}  // namespace hallway::icp
