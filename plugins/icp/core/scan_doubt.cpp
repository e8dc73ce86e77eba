// SPDX-License-Identifier: MIT
#include "icp/core/scan_doubt.hpp"

#include <algorithm>

namespace hallway::icp {
namespace {

constexpr double kUnsteady = 0.5;  // of a change of velocity
constexpr double kSkew = 0.3;      // of the motion over a scan
constexpr double kNoFit = 0.3;     // standard deviation where no surfel fits [m, rad]
// Of the usual overlap, by what is measured: the loss that new surroundings make, too.
constexpr double kUsualLoss[] = {0.0, 0.1, 0.2};

Mat6 even(double sigma_m, double sigma_rad) {
  Vec6 variances;
  variances.head<3>().setConstant(sigma_m * sigma_m);
  variances.tail<3>().setConstant(sigma_rad * sigma_rad);
  return variances.asDiagonal();
}

}  // namespace

Mat6 doubt_of_velocity(const Quat& q_map_scanner, const Vec6& wrong, bool turns) {
  const Mat3 turn = q_map_scanner.toRotationMatrix();
  Vec6 moved = Vec6::Zero();
  moved.head<3>() = turn * wrong.head<3>();
  if (turns) moved.tail<3>() = turn * wrong.tail<3>();
  return moved * moved.transpose();
}

Mat6 doubt_of_change(const Quat& q_map_scanner, const Vec6& changed, bool turns) {
  return doubt_of_velocity(q_map_scanner, kUnsteady * changed, turns);
}

Mat6 doubt_of_skew(const Pose& motion) {
  return even(kSkew * motion.t.norm(), kSkew * rotation_vector(motion.q).norm());
}

Mat6 doubt_of_overlap(double overlap, double usual, Measured measured, bool turns) {
  const double loss = 1.0 - overlap / std::max(usual, overlap);
  if (!(loss > kUsualLoss[static_cast<int>(measured)])) return Mat6::Zero();
  return even(kNoFit * loss, turns ? kNoFit * loss : 0.0);
}

}  // namespace hallway::icp
