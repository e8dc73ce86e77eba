// SPDX-License-Identifier: MIT
#include "slam_plane/core/wall_evidence.hpp"

#include <cmath>

namespace hallway::slam_plane {
namespace {

/// Information of the places of an observation's ends along its wall, those that count.
Mat2 end_information(const bool (&corner)[2], const Noise& noise) {
  const double shared = noise.along * noise.along;
  const double own = noise.end * noise.end;
  Mat2 information = Mat2::Zero();
  if (corner[kEndA] && corner[kEndB]) {
    const double determinant = own * (own + 2.0 * shared);
    information << own + shared, -shared, -shared, own + shared;
    information /= determinant;
  } else {
    if (corner[kEndA]) information(0, 0) = 1.0 / (own + shared);
    if (corner[kEndB]) information(1, 1) = 1.0 / (own + shared);
  }
  return information;
}

/// Takes an end out of the information of both, and of its product with their places. The end's own product is left.
template <typename Product>
void take_out(int end, Mat2& information, const Product& own, Product& others) {
  const int other = 1 - end;
  if (information(end, end) > 0.0) {
    const double share = information(other, end) / information(end, end);
    information(other, other) -= share * information(end, other);
    others -= share * own;
  }
  information(end, end) = information(end, other) = information(other, end) = 0.0;
}

}  // namespace

void WallForm::add(const WallForm& other) {
  h += other.h;
  b += other.b;
  e += other.e;
  f += other.f;
}

void WallForm::drop_end(int end) {
  take_out(end, e, f[end], f[1 - end]);
  f[end] = 0.0;
}

void WallEvidence::add(const Pose2& T_submap_robot, const AssociatedObservation& observation,
                       const bool (&corner)[2], const Noise& noise) {
  const Vec2 middle = T_submap_robot * observation.middle;
  const Vec2 direction = T_submap_robot.rotate(observation.direction);
  const Vec2 end[2] = {T_submap_robot * observation.end[kEndA], T_submap_robot * observation.end[kEndB]};
  if (count_ == 0) {
    origin_ = middle;
    direction_ = direction;
    reach_[kEndA] = end[kEndA];
    reach_[kEndB] = end[kEndB];
  }
  ++count_;
  const Vec2 m = middle - origin_;
  sum_ += m;
  square_ += m * m.transpose();
  turn_ += angle_between(direction_, direction);
  extend(end);
  if (!corner[kEndA] && !corner[kEndB]) return;
  const Mat2 information = end_information(corner, noise);
  const Vec2 a = end[kEndA] - origin_;
  const Vec2 b = end[kEndB] - origin_;
  ends_ += information;
  place_[kEndA] += information(0, 0) * a + information(0, 1) * b;
  place_[kEndB] += information(1, 0) * a + information(1, 1) * b;
}

void WallEvidence::add(const Pose2& T_this_other, const WallEvidence& other) {
  if (other.count_ == 0) return;
  const Vec2 reach[2] = {T_this_other * other.reach_[kEndA], T_this_other * other.reach_[kEndB]};
  if (count_ == 0) {
    origin_ = T_this_other * other.origin_;
    direction_ = T_this_other.rotate(other.direction_);
    reach_[kEndA] = reach[kEndA];
    reach_[kEndB] = reach[kEndB];
  }
  const auto n = static_cast<double>(other.count_);
  const Vec2 o = T_this_other * other.origin_ - origin_;
  const Vec2 sum = T_this_other.rotate(other.sum_);
  Mat2 turn;
  turn << T_this_other.r.x(), -T_this_other.r.y(), T_this_other.r.y(), T_this_other.r.x();
  const Mat2 square = turn * other.square_ * turn.transpose();
  sum_ += sum + n * o;
  square_ += square + o * sum.transpose() + sum * o.transpose() + n * o * o.transpose();
  turn_ += other.turn_ + n * angle_between(direction_, T_this_other.rotate(other.direction_));
  ends_ += other.ends_;
  for (int k = 0; k < 2; ++k)
    place_[k] += T_this_other.rotate(other.place_[k]) + other.ends_.row(k).sum() * o;
  extend(reach);
  count_ += other.count_;
}

/// Takes note that the wall was seen as far as two places.
void WallEvidence::extend(const Vec2 (&seen)[2]) {
  if (direction_.dot(seen[kEndA] - reach_[kEndA]) < 0.0) reach_[kEndA] = seen[kEndA];
  if (direction_.dot(seen[kEndB] - reach_[kEndB]) > 0.0) reach_[kEndB] = seen[kEndB];
}

void WallEvidence::forget_end(int end) {
  take_out(end, ends_, place_[end], place_[1 - end]);
  place_[end].setZero();
}

WallForm WallEvidence::form(const WallBasis& basis, const Noise& noise) const {
  const auto n = static_cast<double>(count_);
  const double w_line = 1.0 / (noise.normal * noise.normal);
  const double w_angle = 1.0 / (noise.angle * noise.angle);
  const Vec2& d = basis.direction;
  const Vec2 l = left_of(d);
  const Vec2 o = origin_ - basis.origin;
  const Vec2 sum = sum_ + n * o;
  // Projections of the second moments about the basis's origin.
  const double ds = d.dot(sum_), dls = l.dot(sum_), dd = d.dot(o), dl = l.dot(o);
  const double ss = d.dot(square_ * d) + 2.0 * dd * ds + n * dd * dd;
  const double sr = d.dot(square_ * l) + dd * dls + ds * dl + n * dd * dl;
  const double turn = turn_ + n * angle_between(d, direction_);
  WallForm form;
  const double along = w_line * d.dot(sum);
  form.h << w_line * ss + w_angle * n, along, along, w_line * n;
  form.b << w_line * sr + w_angle * turn, w_line * l.dot(sum);
  form.e = ends_;
  for (int k = 0; k < 2; ++k) form.f[k] = d.dot(place_[k] + (ends_(k, 0) + ends_(k, 1)) * o);
  return form;
}

bool solve(const WallForm& form, const WallBasis& basis, const bool (&use_end)[2], WallEstimate& estimate) {
  const double determinant = form.h(0, 0) * form.h(1, 1) - form.h(0, 1) * form.h(0, 1);
  if (!(determinant > 0.0)) return false;
  estimate.p_tt = form.h(1, 1) / determinant;
  estimate.p_oo = form.h(0, 0) / determinant;
  estimate.p_to = -form.h(0, 1) / determinant;
  const double turn = estimate.p_tt * form.b[0] + estimate.p_to * form.b[1];
  const double offset = estimate.p_to * form.b[0] + estimate.p_oo * form.b[1];
  estimate.basis.origin = basis.origin + offset * left_of(basis.direction);
  estimate.basis.direction = Pose2::at(Vec2::Zero(), turn).rotate(basis.direction).normalized();
  WallForm ends = form;
  for (int k = 0; k < 2; ++k) {
    if (!use_end[k]) ends.drop_end(k);
  }
  const Mat2& e = ends.e;
  const Vec2& f = ends.f;
  for (int k = 0; k < 2; ++k) estimate.known[k] = e(k, k) > 0.0;
  const bool both = estimate.known[kEndA] && estimate.known[kEndB];
  const double d = e(0, 0) * e(1, 1) - e(0, 1) * e(0, 1);
  estimate.covariance = both ? -e(0, 1) / d : 0.0;
  for (int k = 0; k < 2; ++k) {
    if (!estimate.known[k]) continue;
    const int other = 1 - k;
    estimate.variance[k] = both ? e(other, other) / d : 1.0 / e(k, k);
    estimate.end[k] = both ? (e(other, other) * f[k] - e(0, 1) * f[other]) / d : f[k] / e(k, k);
  }
  return true;
}

}  // namespace hallway::slam_plane
