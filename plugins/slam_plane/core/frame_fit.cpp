// SPDX-License-Identifier: MIT
#include "slam_plane/core/frame_fit.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/symmetric.hpp"

namespace hallway::slam_plane {
namespace {

constexpr double kEndGateSigmas = 4.0;  // of an end
constexpr double kWorstHeading_rad = 0.1;
constexpr double kHoldOpen = 1e10;  // information that holds an open direction where it is [1/m^2]
constexpr int kSteps = 3;           // the last one with ends gated

void add_row(const Vec3& gradient, double residual, double weight, Mat3& h, Vec3& g) {
  h += weight * gradient * gradient.transpose();
  g -= weight * residual * gradient;
}

}  // namespace

FrameFit::FrameFit(const Options& options) : noise_(options.noise()), undetermined_(options.undetermined_m) {}

bool FrameFit::end_row(const Pair& pair, const Pose2& T, Ends ends, Row& row) const {
  const WallEstimate& wall = *pair.wall;
  const double own = noise_.end * noise_.end;
  const double shared = noise_.along * noise_.along;
  const Vec2& d = wall.basis.direction;
  double residual[2] = {0.0, 0.0}, variance[2] = {0.0, 0.0};
  bool use[2] = {false, false};
  Vec2 arm[2];
  double doubt = 1.0;
  for (int k = 0; k < 2; ++k) {
    if (!pair.end[k] || !pair.sighting->corner[k] || !wall.known[k]) continue;
    arm[k] = T.rotate(pair.sighting->end[k]);
    residual[k] = wall.basis.along(arm[k] + T.t) - wall.end[k];
    variance[k] = own + shared + wall.variance[k];
    const double ratio2 = residual[k] * residual[k] / (kEndGateSigmas * kEndGateSigmas * variance[k]);
    if (ends == Ends::gated && ratio2 > 1.0) continue;
    if (ends == Ends::doubted) doubt = std::max(doubt, 1.0 + ratio2);
    use[k] = true;
  }
  if (!use[kEndA] && !use[kEndB]) return false;
  double share[2] = {use[kEndA] ? 1.0 : 0.0, use[kEndB] ? 1.0 : 0.0};
  row.variance = use[kEndA] ? variance[kEndA] : variance[kEndB];
  if (use[kEndA] && use[kEndB]) {  // the best mean of two that share an error
    const double both = shared + wall.covariance;
    const double sum = variance[kEndA] + variance[kEndB] - 2.0 * both;
    share[kEndA] = (variance[kEndB] - both) / sum;
    share[kEndB] = (variance[kEndA] - both) / sum;
    row.variance = (variance[kEndA] * variance[kEndB] - both * both) / sum;
  }
  row.variance *= doubt;
  row.residual = 0.0;
  double turn = 0.0;
  for (int k = 0; k < 2; ++k) {
    if (!use[k]) continue;
    row.residual += share[k] * residual[k];
    turn += share[k] * d.dot(left_of(arm[k]));
  }
  row.gradient = Vec3(d.x(), d.y(), turn);
  return true;
}

void FrameFit::step(Pose2& T, Ends ends, PoseInformation& information) const {
  Mat3 h = Mat3::Zero();
  Vec3 g = Vec3::Zero();
  for (const Pair& pair : pairs_) {
    const WallBasis& basis = pair.wall->basis;
    const Vec2 l = left_of(basis.direction);
    const Vec2 arm = T.rotate(pair.sighting->middle);
    const double s = basis.along(arm + T.t);
    const double turn = angle_between(basis.direction, T.rotate(pair.sighting->direction));
    add_row(Vec3(0.0, 0.0, 1.0), turn, 1.0 / (noise_.angle * noise_.angle + pair.wall->p_tt), h, g);
    add_row(Vec3(l.x(), l.y(), l.dot(left_of(arm))), basis.across(arm + T.t),
            1.0 / (noise_.normal * noise_.normal + pair.wall->variance_at(s)), h, g);
    Row row;
    if (end_row(pair, T, ends, row)) add_row(row.gradient, row.residual, 1.0 / row.variance, h, g);
  }
  information.matrix = h;
  judge(information);
  if (information.open > 0) {
    const Vec2& u = information.direction;
    h.topLeftCorner<2, 2>() +=
        kHoldOpen * (information.open == 2 ? Mat2(Mat2::Identity()) : Mat2(u * u.transpose()));
  }
  if (!information.heading) h(2, 2) += kHoldOpen;
  const Vec3 x = Ldlt<3>(h).solve(g);
  if (x.allFinite()) T = T.moved(x.head<2>(), x(2));
}

/// What of the position is open once the heading is free too.
void FrameFit::judge(PoseInformation& information) const {
  const Mat3& h = information.matrix;
  information.heading = h(2, 2) * kWorstHeading_rad * kWorstHeading_rad > 1.0;
  Mat2 position = h.topLeftCorner<2, 2>();
  if (h(2, 2) > 0.0) position -= h.topRightCorner<2, 1>() * h.bottomLeftCorner<1, 2>() / h(2, 2);
  const double middle = 0.5 * (position(0, 0) + position(1, 1));
  const double half = 0.5 * (position(0, 0) - position(1, 1));
  const double spread = std::hypot(half, position(0, 1));
  const double least = 1.0 / (undetermined_ * undetermined_);
  information.open = (middle + spread < least ? 1 : 0) + (middle - spread < least ? 1 : 0);
  // Eigenvector of the smaller eigenvalue.
  const double angle = 0.5 * std::atan2(position(0, 1), half);
  information.direction = Vec2(-std::sin(angle), std::cos(angle));
}

PoseInformation FrameFit::solve(Pose2& T) const {
  PoseInformation information;
  if (pairs_.empty()) return information;
  for (int i = 0; i < kSteps; ++i) step(T, i + 1 < kSteps ? Ends::doubted : Ends::gated, information);
  return information;
}

double FrameFit::line_distance2(std::size_t pair, const Pose2& T) const {
  const Sighting& sighting = *pairs_[pair].sighting;
  const WallEstimate& wall = *pairs_[pair].wall;
  const Vec2 p = T * sighting.middle;
  const double turn = angle_between(wall.basis.direction, T.rotate(sighting.direction));
  const double offset = wall.basis.across(p);
  return turn * turn / (noise_.angle * noise_.angle + wall.p_tt) +
         offset * offset / (noise_.normal * noise_.normal + wall.variance_at(wall.basis.along(p)));
}

bool FrameFit::end_agrees(std::size_t pair, int end, const Pose2& T) const {
  const Sighting& sighting = *pairs_[pair].sighting;
  const WallEstimate& wall = *pairs_[pair].wall;
  if (!sighting.corner[end] || !wall.known[end]) return false;
  const double residual = wall.basis.along(T * sighting.end[end]) - wall.end[end];
  const double variance = noise_.end * noise_.end + noise_.along * noise_.along + wall.variance[end];
  return residual * residual <= kEndGateSigmas * kEndGateSigmas * variance;
}

PoseInformation FrameFit::own_information(const std::vector<Sighting>& frame) const {
  PoseInformation information;
  Vec3 unused = Vec3::Zero();
  for (const Sighting& sighting : frame) {
    const Vec2 l = left_of(sighting.direction);
    add_row(Vec3(0.0, 0.0, 1.0), 0.0, 1.0 / (noise_.angle * noise_.angle), information.matrix, unused);
    add_row(Vec3(l.x(), l.y(), l.dot(left_of(sighting.middle))), 0.0, 1.0 / (noise_.normal * noise_.normal),
            information.matrix, unused);
    for (int k = 0; k < 2; ++k) {
      if (!sighting.corner[k]) continue;
      const Vec2& d = sighting.direction;
      add_row(Vec3(d.x(), d.y(), d.dot(left_of(sighting.end[k]))), 0.0,
              1.0 / (noise_.end * noise_.end + noise_.along * noise_.along), information.matrix, unused);
    }
  }
  judge(information);
  return information;
}

}  // namespace hallway::slam_plane
