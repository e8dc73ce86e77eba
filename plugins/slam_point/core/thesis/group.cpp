// SPDX-License-Identifier: MIT
#include "slam_point/core/thesis/group.hpp"

#include "slam_point/core/fit/alignment.hpp"

namespace hallway::slam_point::thesis {

bool Group::add(std::span<const Vec3> seen, Basis basis, double least_m) {
  if (iterations_ == 0) {
    if (!begin(seen, basis, least_m)) return false;
  } else if (basis == Basis::three) {
    T_group_sensor_ = basis_pose(seen[basis_[0]], seen[basis_[1]], seen[basis_[2]]);
  } else if (!align(seen, T_group_sensor_)) {
    return false;
  }
  ++iterations_;
  const double share = 1.0 / static_cast<double>(iterations_);
  const Mat3 rotation = T_group_sensor_.q.toRotationMatrix();
  for (std::size_t m = 0; m < mean_.size(); ++m)
    mean_[m] += share * (rotation * seen[m] + T_group_sensor_.t - mean_[m]);
  return true;
}

bool Group::begin(std::span<const Vec3> seen, Basis basis, double least_m) {
  if (!choose_basis(seen, least_m, basis_)) return false;
  if (basis == Basis::three) T_group_sensor_ = basis_pose(seen[basis_[0]], seen[basis_[1]], seen[basis_[2]]);
  mean_.assign(points_.size(), Vec3::Zero());
  return true;
}

bool Group::align(std::span<const Vec3> seen, Pose& T_group_sensor) const {
  Alignment alignment(T_group_sensor);
  for (std::size_t m = 0; m < mean_.size(); ++m) alignment.add(mean_[m], seen[m], 1.0);
  // From iteration to iteration the sensor turns little; where it was away for longer, only the fit from nothing finds it.
  return alignment.solve({}, T_group_sensor) || rigid_fit(mean_, seen, T_group_sensor);
}

bool Group::place(std::span<const Vec3> places) {
  const std::span<const Vec3> means(mean_.data(), places.size());
  if (placed_) {
    Alignment alignment(T_map_group_);
    for (std::size_t m = 0; m < places.size(); ++m) alignment.add(places[m], means[m], 1.0);
    if (alignment.solve({}, T_map_group_)) return true;
  }
  placed_ = rigid_fit(places, means, T_map_group_) || placed_;
  return placed_;
}

}  // namespace hallway::slam_point::thesis
