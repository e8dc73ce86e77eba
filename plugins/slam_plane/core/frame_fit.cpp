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

Mat2 PoseInformation::position() const {
  Mat2 position = matrix.topLeftCorner<2, 2>();
  if (matrix(2, 2) > 0.0)
    position -= matrix.topRightCorner<2, 1>() * matrix.bottomLeftCorner<1, 2>() / matrix(2, 2);
  return position;
}

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
    if (!pair.end[k] || !pair.observation->corner[k] || !wall.known[k]) continue;
    arm[k] = T.rotate(pair.observation->end[k]);
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
    const Vec2 arm = T.rotate(pair.observation->middle);
    const double s = basis.along(arm + T.t);
    const double turn = angle_between(basis.direction, T.rotate(pair.observation->direction));
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
  information.heading = information.matrix(2, 2) * kWorstHeading_rad * kWorstHeading_rad > 1.0;
  const Mat2 position = information.position();
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
  const AssociatedObservation& observation = *pairs_[pair].observation;
  const WallEstimate& wall = *pairs_[pair].wall;
  const Vec2 p = T * observation.middle;
  const double turn = angle_between(wall.basis.direction, T.rotate(observation.direction));
  const double offset = wall.basis.across(p);
  return turn * turn / (noise_.angle * noise_.angle + wall.p_tt) +
         offset * offset / (noise_.normal * noise_.normal + wall.variance_at(wall.basis.along(p)));
}

PoseInformation FrameFit::own_information(const std::vector<AssociatedObservation>& frame) const {
  PoseInformation information;
  Vec3 unused = Vec3::Zero();
  for (const AssociatedObservation& observation : frame) {
    const Vec2 l = left_of(observation.direction);
    add_row(Vec3(0.0, 0.0, 1.0), 0.0, 1.0 / (noise_.angle * noise_.angle), information.matrix, unused);
    add_row(Vec3(l.x(), l.y(), l.dot(left_of(observation.middle))), 0.0,
            1.0 / (noise_.normal * noise_.normal), information.matrix, unused);
    for (int k = 0; k < 2; ++k) {
      if (!observation.corner[k]) continue;
      const Vec2& d = observation.direction;
      add_row(Vec3(d.x(), d.y(), d.dot(left_of(observation.end[k]))), 0.0, 1.0 / (noise_.end_variance()),
              information.matrix, unused);
    }
  }
  judge(information);
  return information;
}

}  // namespace hallway::slam_plane
