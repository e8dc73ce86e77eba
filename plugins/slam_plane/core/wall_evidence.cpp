// SPDX-License-Identifier: MIT
#include "slam_plane/core/wall_evidence.hpp"

#include <cmath>

namespace hallway::slam_plane {
namespace {

/// Information of the places of a piece's ends along its wall, those that count.
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

}  // namespace

void WallForm::add(const WallForm& other) {
  h_tt += other.h_tt;
  h_to += other.h_to;
  h_oo += other.h_oo;
  b_t += other.b_t;
  b_o += other.b_o;
  e_aa += other.e_aa;
  e_ab += other.e_ab;
  e_bb += other.e_bb;
  f_a += other.f_a;
  f_b += other.f_b;
}

void WallForm::drop_end(int end) {
  double& e = end == kEndA ? e_aa : e_bb;
  double& f = end == kEndA ? f_a : f_b;
  if (e > 0.0) {
    const double share = e_ab / e;
    (end == kEndA ? e_bb : e_aa) -= share * e_ab;
    (end == kEndA ? f_b : f_a) -= share * f;
  }
  e = f = e_ab = 0.0;
}

void WallEvidence::add(const Pose2& T_submap_robot, const Sighting& sighting, const bool (&corner)[2],
                       const Noise& noise) {
  const Vec2 middle = T_submap_robot * sighting.middle;
  const Vec2 direction = T_submap_robot.rotate(sighting.direction);
  const Vec2 end[2] = {T_submap_robot * sighting.end[kEndA], T_submap_robot * sighting.end[kEndB]};
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
  if (direction_.dot(end[kEndA] - reach_[kEndA]) < 0.0) reach_[kEndA] = end[kEndA];
  if (direction_.dot(end[kEndB] - reach_[kEndB]) > 0.0) reach_[kEndB] = end[kEndB];
  if (!corner[kEndA] && !corner[kEndB]) return;
  const Mat2 information = end_information(corner, noise);
  const Vec2 a = end[kEndA] - origin_;
  const Vec2 b = end[kEndB] - origin_;
  ends_ += information;
  place_[kEndA] += information(0, 0) * a + information(0, 1) * b;
  place_[kEndB] += information(1, 0) * a + information(1, 1) * b;
  for (int k = 0; k < 2; ++k) corners_[k] += corner[k] ? 1u : 0u;
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
  place_[kEndA] += T_this_other.rotate(other.place_[kEndA]) + other.ends_.row(0).sum() * o;
  place_[kEndB] += T_this_other.rotate(other.place_[kEndB]) + other.ends_.row(1).sum() * o;
  if (direction_.dot(reach[kEndA] - reach_[kEndA]) < 0.0) reach_[kEndA] = reach[kEndA];
  if (direction_.dot(reach[kEndB] - reach_[kEndB]) > 0.0) reach_[kEndB] = reach[kEndB];
  count_ += other.count_;
  for (int k = 0; k < 2; ++k) corners_[k] += other.corners_[k];
}

void WallEvidence::forget_end(int end) {
  const int other = 1 - end;
  if (ends_(end, end) > 0.0) {
    const double share = ends_(other, end) / ends_(end, end);
    ends_(other, other) -= share * ends_(end, other);
    place_[other] -= share * place_[end];
  }
  ends_(end, end) = ends_(end, other) = ends_(other, end) = 0.0;
  place_[end].setZero();
  corners_[end] = 0;
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
  form.h_tt = w_line * ss + w_angle * n;
  form.h_to = w_line * d.dot(sum);
  form.h_oo = w_line * n;
  form.b_t = w_line * sr + w_angle * turn;
  form.b_o = w_line * l.dot(sum);
  form.e_aa = ends_(0, 0);
  form.e_ab = ends_(0, 1);
  form.e_bb = ends_(1, 1);
  form.f_a = d.dot(place_[kEndA] + (ends_(0, 0) + ends_(0, 1)) * o);
  form.f_b = d.dot(place_[kEndB] + (ends_(1, 0) + ends_(1, 1)) * o);
  return form;
}

bool solve(const WallForm& form, const WallBasis& basis, const bool (&use_end)[2], WallEstimate& estimate) {
  const double determinant = form.h_tt * form.h_oo - form.h_to * form.h_to;
  if (!(determinant > 0.0)) return false;
  estimate.p_tt = form.h_oo / determinant;
  estimate.p_oo = form.h_tt / determinant;
  estimate.p_to = -form.h_to / determinant;
  const double turn = estimate.p_tt * form.b_t + estimate.p_to * form.b_o;
  const double offset = estimate.p_to * form.b_t + estimate.p_oo * form.b_o;
  estimate.basis.origin = basis.origin + offset * left_of(basis.direction);
  estimate.basis.direction = Pose2::at(Vec2::Zero(), turn).rotate(basis.direction).normalized();
  WallForm ends = form;
  for (int k = 0; k < 2; ++k) {
    if (!use_end[k]) ends.drop_end(k);
  }
  const double d = ends.e_aa * ends.e_bb - ends.e_ab * ends.e_ab;
  estimate.known[kEndA] = ends.e_aa > 0.0;
  estimate.known[kEndB] = ends.e_bb > 0.0;
  if (estimate.known[kEndA] && estimate.known[kEndB]) {
    estimate.variance[kEndA] = ends.e_bb / d;
    estimate.variance[kEndB] = ends.e_aa / d;
    estimate.covariance = -ends.e_ab / d;
    estimate.end[kEndA] = (ends.e_bb * ends.f_a - ends.e_ab * ends.f_b) / d;
    estimate.end[kEndB] = (ends.e_aa * ends.f_b - ends.e_ab * ends.f_a) / d;
    return true;
  }
  estimate.covariance = 0.0;
  if (estimate.known[kEndA]) {
    estimate.variance[kEndA] = 1.0 / ends.e_aa;
    estimate.end[kEndA] = ends.f_a / ends.e_aa;
  }
  if (estimate.known[kEndB]) {
    estimate.variance[kEndB] = 1.0 / ends.e_bb;
    estimate.end[kEndB] = ends.f_b / ends.e_bb;
  }
  return true;
}

}  // namespace hallway::slam_plane
