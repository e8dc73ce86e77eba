// SPDX-License-Identifier: MIT
#include "slam_point/core/fit/directional_fit.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "geometry/symmetric.hpp"
#include "slam_point/core/fit/alignment.hpp"

namespace hallway::slam_point {
namespace {

using StepVector = Eigen::Matrix<double, 6, 1>;

constexpr std::array<double, 2> kFirstInliers{4.0,
                                              2.0};  // in the first passes a residual may be so much larger
constexpr std::size_t kMostFitSteps = 12;
constexpr double kStepSettled_rad = 1e-7;
constexpr double kStepSettled_m = 1e-7;
constexpr double kStaleTurn_rad = 1e-3;  // a turn that changes what a pair says too little to look again

/// One fit.
class DirectionalFitter {
 public:
  DirectionalFitter(const std::vector<DirectionalPair>& pairs, const FitRules& rules, const Pose& guess)
      : pairs_(pairs), rules_(rules), T_(guess), informations_(pairs.size()) {}

  bool fit();
  const Pose& pose() const { return T_; }

 private:
  void start();
  void take_informations();
  void sum(double inlier_m);
  bool is_determined() const;

  const std::vector<DirectionalPair>& pairs_;
  const FitRules& rules_;
  Pose T_;
  std::vector<Mat3> informations_;  // of each pair, frame a
  Mat6 normal_ = Mat6::Zero();
  StepVector gradient_ = StepVector::Zero();
};

/// Without directions the answer is near, whatever the guess and the outliers are.
void DirectionalFitter::start() {
  std::vector<Pair> plain;
  plain.reserve(pairs_.size());
  for (const DirectionalPair& pair : pairs_)
    plain.push_back({pair.reference, pair.point, pair.plain_weight, pair.weight.along});
  robust_fit(plain, {rules_.planar, 0.0, rules_.inlier_m}, T_);
}

void DirectionalFitter::take_informations() {
  const PointMotion motion(T_);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const DirectionalPair& pair = pairs_[i];
    informations_[i] = pair_information(pair.known, ray_information(motion.turned(pair.point), pair.weight));
  }
}

void DirectionalFitter::sum(double inlier_m) {
  const PointMotion motion(T_);
  const double inlier2 = inlier_m * inlier_m;
  normal_.setZero();
  gradient_.setZero();
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const Vec3 y = motion.turned(pairs_[i].point);
    const Vec3 residual = y + T_.t - pairs_[i].reference;
    const Vec3 weighted = informations_[i] * residual;
    const double r2 = residual.dot(weighted);
    const double share = r2 <= inlier2 ? 1.0 : inlier2 / r2;
    const Mat3 information = share * informations_[i];
    const Mat3 turning = skew(y) * information;
    normal_.topLeftCorner<3, 3>() += information;
    normal_.bottomLeftCorner<3, 3>() += turning;
    normal_.bottomRightCorner<3, 3>() -= turning * skew(y);
    gradient_.head<3>() += share * weighted;
    gradient_.tail<3>() += share * y.cross(weighted);
  }
  normal_.topRightCorner<3, 3>() = normal_.bottomLeftCorner<3, 3>().transpose();
  if (!rules_.planar) return;
  // Out-of-plane directions are decoupled in planar data.
  normal_.diagonal().segment<3>(2).array() += 1.0;
  gradient_.segment<3>(2).setZero();
}

/// Whether the rotation, whatever the translation, is known well enough.
bool DirectionalFitter::is_determined() const {
  const Mat3 travel = normal_.topLeftCorner<3, 3>();
  const Mat3 cross = normal_.bottomLeftCorner<3, 3>();
  const Ldlt<3> factors(travel);
  if (!(factors.least_pivot() > 0.0)) return false;
  const Mat3 turn = normal_.bottomRightCorner<3, 3>() - cross * factors.solve_all(cross.transpose());
  if (rules_.planar) return turn(2, 2) >= rules_.min_spread_m2;
  return least_eigenvalue(turn) >= rules_.min_spread_m2;
}

bool DirectionalFitter::fit() {
  if (pairs_.size() < rules_.least_pairs()) return false;
  start();
  double stale = kStaleTurn_rad;
  for (std::size_t pass = 0; pass < kMostFitSteps; ++pass) {
    if (stale >= kStaleTurn_rad) {
      take_informations();
      stale = 0.0;
    }
    const bool first = pass < kFirstInliers.size();
    sum(first ? kFirstInliers[pass] * rules_.inlier_m : rules_.inlier_m);
    const Ldlt<6> factors(normal_);
    if (!(factors.least_pivot() > 0.0)) return false;
    const StepVector step = -factors.solve(gradient_);
    if (!step.allFinite()) return false;
    T_.q = (rotation_exp(step.tail<3>()) * T_.q).normalized();
    T_.t += step.head<3>();
    const double turn = step.tail<3>().norm();
    stale += turn;
    const bool plain = std::isinf(rules_.inlier_m);
    if ((plain || !first) && turn < kStepSettled_rad && step.head<3>().norm() < kStepSettled_m) break;
  }
  return is_determined();
}

}  // namespace

Mat3 skew(const Vec3& v) {
  Mat3 m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

Mat6 motion_information(const Vec3& y_row, const Mat3& information, const Vec3& y_column) {
  const Mat3 turned = information * skew(y_column);
  Mat6 block;
  block << information, -turned, skew(y_row) * information, -skew(y_row) * turned;
  return block;
}

bool directional_fit(const std::vector<DirectionalPair>& pairs, const FitRules& rules, Pose& T) {
  DirectionalFitter fitter(pairs, rules, T);
  if (!fitter.fit()) return false;
  T = fitter.pose();
  return true;
}

}  // namespace hallway::slam_point
