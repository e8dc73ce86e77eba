// SPDX-License-Identifier: MIT
#include "icp/core/scan_fit.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/symmetric.hpp"

namespace hallway::icp {
namespace {

constexpr double kSettled_m = 1e-4;   // of a step, with turns at the scan's radius
constexpr double kToAndFro = 0.2;     // of the noise: a last step that is no failure
constexpr double kCut = 3.0;          // scales of the kernel beyond which a match is none
constexpr double kSpurious = 2.0;     // times what errors of normals tell: below it a direction is open
constexpr double kSurface_m = 0.002;  // how even surfaces are
constexpr double kDependence =
    4.0;  // variances are taken so many times: neighbouring points share their errors

struct Match {
  std::size_t surfel;
  int patch;
};

/// The search for one pose.
class ScanSearch {
 public:
  ScanSearch(const PlaneMap& map, const std::vector<Surfel>& surfels, const Pose& guess,
             const Mat6& guess_covariance, const ScanRules& rules)
      : map_(map),
        surfels_(surfels),
        rules_(rules),
        guess_(guess),
        pose_(guess),
        trust_(inverse_of_positive<6>(guess_covariance).matrix) {
    for (const Surfel& surfel : surfels) radius_m_ += surfel.point.norm();
    radius_m_ = std::max(radius_m_ / std::max<double>(1.0, static_cast<double>(surfels.size())), 0.1);
  }

  ScanFit run() {
    ScanFit result;
    double scale_m = rules_.reach_m;
    double moved_m = 0.0;
    while (result.iterations < rules_.max_iterations) {
      ++result.iterations;
      const bool last_scale = scale_m < 0.5 * rules_.noise.noise_m;
      gather(last_scale ? 0.0 : scale_m);
      moved_m = step();
      if (last_scale && moved_m < kSettled_m) {
        result.converged = true;
        break;
      }
      if (!last_scale) scale_m *= 0.6;
    }
    // Points at the edge between two patches may go to and fro for ever.
    result.converged = result.converged || moved_m < kToAndFro * rules_.noise.noise_m;
    result.T_map_sensor = pose_;
    result.covariance = posterior_;
    result.overlap =
        surfels_.empty() ? 0.0 : static_cast<double>(inliers_) / static_cast<double>(surfels_.size());
    result.residual_m = weights_ > 0.0 ? std::sqrt(squares_ / weights_) : 0.0;
    result.open = open_;
    return result;
  }

 private:
  /// What the matches of the pose tell: normal equations.
  void gather(double scale_m) {
    matches_.clear();
    users_.assign(map_.size(), 0);
    const double reach_m = scale_m > 0.0 ? scale_m : 3.0 * kCut * rules_.noise.noise_m;
    for (std::size_t i = 0; i < surfels_.size(); ++i) {
      const int patch = map_.find(pose_ * surfels_[i].point, pose_.q * surfels_[i].normal, reach_m);
      if (patch < 0) continue;
      matches_.push_back({i, patch});
      ++users_[static_cast<std::size_t>(patch)];
    }
    information_.setZero();
    spurious_.setZero();
    gradient_.setZero();
    inliers_ = 0;
    squares_ = weights_ = chi2_ = 0.0;
    for (const Match& match : matches_) count(match, scale_m);
  }

  void count(const Match& match, double scale_m) {
    const Patch& patch = map_.patch(match.patch);
    const Surfel& surfel = surfels_[match.surfel];
    const Vec3 arm = pose_.q * surfel.point;
    const Vec3 p = arm + pose_.t;
    const double residual = patch.normal.dot(p - patch.mean);
    const double own2 = surfel.variance + patch.rough2 + kSurface_m * kSurface_m;
    const double shared2 = patch.variance_at(p);
    const double variance = own2 + shared2;
    const double kernel2 = kCut * kCut * variance + scale_m * scale_m;
    const double robust = kernel2 / (kernel2 + residual * residual);
    // The error of a patch is the same for all that lie on it.
    const double weight = robust * robust / (own2 + users_[static_cast<std::size_t>(match.patch)] * shared2);
    Vec6 row;
    row << patch.normal, arm.cross(patch.normal);
    information_.noalias() += weight * row * row.transpose();
    gradient_ -= weight * residual * row;
    for (int k = 0; k < 2; ++k) {
      Vec6 false_row;
      false_row << patch.across[k], arm.cross(patch.across[k]);
      spurious_.noalias() += weight * patch.covariance(k + 1, k + 1) * false_row * false_row.transpose();
    }
    if (residual * residual > kCut * kCut * variance) return;
    ++inliers_;
    squares_ += weight * residual * residual;
    weights_ += weight;
    chi2_ += residual * residual / variance;
  }

  /// One step from the matches and the guess. @return how far it moved [m]
  double step() {
    // In turns of the scan's radius, so that turns and shifts are of one size.
    Vec6 units;
    units << 1, 1, 1, 1 / radius_m_, 1 / radius_m_, 1 / radius_m_;
    const auto scaled = [&](const Mat6& m) -> Mat6 { return units.asDiagonal() * m * units.asDiagonal(); };
    const Mat6 told = scaled(information_);
    const Mat6 false_part = scaled(spurious_);
    const Spectrum<6> eigen = spectrum(told);
    const Mat6 trust = scaled(trust_);
    Mat6 known = trust;
    const Vec6 from_guess = (units.cwiseInverse()).asDiagonal() * deviation();
    Vec6 pull = -(trust * from_guess);
    const Vec6 gradient = units.asDiagonal() * gradient_;
    const double dispersion = std::max(1.0, inliers_ > 0 ? chi2_ / inliers_ : 1.0) * kDependence;
    open_ = 0;
    for (int i = 0; i < 6; ++i) {
      const Vec6 v = eigen.vectors.col(i);
      // What errors of normals would tell by themselves counts nothing.
      const double share = 1.0 - kSpurious * v.dot(false_part * v) / std::max(eigen.values(i), 1e-9);
      if (!(share > 0.0)) {
        ++open_;
        continue;
      }
      known += share * eigen.values(i) / dispersion * v * v.transpose();
      pull += v * (share * v.dot(gradient) / dispersion);
    }
    const Inverse<6> inverse = inverse_of_positive<6>(known);
    if (!inverse.is_positive) return 0.0;
    posterior_ = scaled(inverse.matrix);
    const Vec6 move = inverse.matrix * pull;
    const Vec6 change = units.asDiagonal() * move;
    pose_ = {(rotation_by(change.tail<3>()) * pose_.q).normalized(), pose_.t + change.head<3>()};
    return move.cwiseAbs().maxCoeff();
  }

  /// From the guess to the pose.
  Vec6 deviation() const {
    Vec6 result;
    result << pose_.t - guess_.t, rotation_vector(pose_.q * guess_.q.conjugate());
    return result;
  }

  const PlaneMap& map_;
  const std::vector<Surfel>& surfels_;
  const ScanRules& rules_;
  Pose guess_, pose_;
  Mat6 trust_;
  double radius_m_ = 0.0;
  std::vector<Match> matches_;
  std::vector<int> users_;
  Mat6 information_, spurious_, posterior_ = Mat6::Zero();
  Vec6 gradient_;
  int inliers_ = 0, open_ = 0;
  double squares_ = 0.0, weights_ = 0.0, chi2_ = 0.0;
};

}  // namespace

ScanFit register_scan(const PlaneMap& map, const std::vector<Surfel>& surfels, const Pose& guess,
                      const Mat6& guess_covariance, const ScanRules& rules) {
  return ScanSearch(map, surfels, guess, guess_covariance, rules).run();
}

}  // namespace hallway::icp
