// SPDX-License-Identifier: MIT
#include "slam_point/core/pose_information.hpp"

#include <Eigen/Cholesky>

namespace hallway::slam_point {

std::optional<Mat6> PoseInformation::covariance(bool planar) const {
  // Of x = exp(r) lever + t the derivative by (t, r) is [I, -[lever]x].
  Mat3 cross;
  cross << 0.0, -sum_.z(), sum_.y(), sum_.z(), 0.0, -sum_.x(), -sum_.y(), sum_.x(), 0.0;
  Mat6 information;
  information << weight_ * Mat3::Identity(), -cross, cross, outer_.trace() * Mat3::Identity() - outer_;
  if (is_directional_) information += directional_;
  if (planar) {
    // z, roll and pitch are decoupled from the rest there, and known.
    information.block<3, 6>(2, 0).setZero();
    information.block<6, 3>(0, 2).setZero();
    information.diagonal().segment<3>(2).setOnes();
  }
  const Eigen::LLT<Mat6> factor(information);
  if (factor.info() != Eigen::Success) return std::nullopt;
  Mat6 covariance = factor.solve(Mat6::Identity());
  if (planar) covariance.diagonal().segment<3>(2).setZero();
  if (!covariance.allFinite()) return std::nullopt;
  return Mat6(0.5 * (covariance + covariance.transpose()));
}

}  // namespace hallway::slam_point
