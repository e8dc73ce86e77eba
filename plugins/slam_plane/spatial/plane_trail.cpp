// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/plane_trail.hpp"

#include <algorithm>
#include <cmath>

#include "slam_plane/spatial/outline.hpp"

namespace hallway::slam_plane::spatial {
namespace {

constexpr double kOff_m = 0.05;         // of an observation from its plane, more than noise is likely to do
constexpr double kOff_rad = 0.05;       // likewise
constexpr std::uint64_t kFollowed = 3;  // frames for which a plane may be where it was seen last
constexpr std::uint64_t kInARow = 5;    // frames out of view that do not break a row
constexpr std::uint32_t kOutliers = 8;  // in a row make a plane one that moves,
constexpr double kMove_m = 0.15;        // if it is so far from where it was at the first of them,
constexpr double kMove_rad = 0.15;      // or turned by so much

double angle_of(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

void PlaneTrail::note(const AssociatedObservation& observation, const Pose& T_map_robot, const Feature& plane,
                      bool outlier, std::uint64_t iteration) {
  const Vec3 normal = T_map_robot.q * observation.normal;
  centre_ = T_map_robot * observation.centre;
  plane_.plane << normal, normal.dot(centre_);
  outline_.clear();
  append_moved(T_map_robot, observation.outline, outline_);
  off_ = std::abs(plane.distance(centre_)) > kOff_m || angle_of(plane.normal(), normal) > kOff_rad;
  if (!outlier || seen_ + kInARow < iteration) outliers_ = 0;
  if (outlier && outliers_++ == 0) first_ = plane_.plane;
  seen_ = iteration;
}

bool PlaneTrail::moves() const {
  return outliers_ >= kOutliers && (std::abs(first_.head<3>().dot(centre_) - first_(3)) > kMove_m ||
                                    angle_of(first_.head<3>(), plane_.normal()) > kMove_rad);
}

bool PlaneTrail::is_followed(std::uint64_t iteration) const {
  return off_ && seen_ + kFollowed >= iteration;
}

}  // namespace hallway::slam_plane::spatial
