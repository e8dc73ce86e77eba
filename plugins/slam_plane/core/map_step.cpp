// SPDX-License-Identifier: MIT
#include "slam_plane/core/map_step.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace hallway::slam_plane {
namespace {

constexpr double kHuber_m = 0.1;        // an end that is farther off counts less
constexpr double kHold = 1.0;           // information that holds a submap where it is (Levenberg) [1/m^2]
constexpr double kHoldLines = 100.0;    // likewise, of one whose frames left a direction open
constexpr double kHoldHeading = 100.0;  // [1/rad^2]
constexpr double kWorkOfLink = 0.1;     // in an iteration
constexpr double kMostTurn_rad = 0.5;   // more is no small step
constexpr double kMostMove_m = 5.0;     // likewise

/// How the lines and ends of a submap, as seen in the map, move with the submap's pose about its own origin.
Eigen::Matrix<double, 4, 3> motion(const WallBasis& basis, const Vec2& origin) {
  const Vec2& d = basis.direction;
  const Vec2 l = left_of(d);
  const Vec2 arm = basis.origin - origin;
  Eigen::Matrix<double, 4, 3> m;
  m << 0.0, 0.0, 1.0,             //
      l.x(), l.y(), d.dot(arm),   //
      d.x(), d.y(), -l.dot(arm),  //
      d.x(), d.y(), -l.dot(arm);
  return m;
}

Eigen::Matrix4d matrix(const Mat2& line, const Mat2& ends) {
  Eigen::Matrix4d h = Eigen::Matrix4d::Zero();
  h.topLeftCorner<2, 2>() = line;
  h.bottomRightCorner<2, 2>() = ends;
  return h;
}

Eigen::Vector4d vector(const WallForm& form) {
  return {form.b[0], form.b[1], form.f[0], form.f[1]};
}

void scale_end(WallForm& form, int end, double scale) {
  const double root = std::sqrt(scale);
  form.e(end, end) *= scale;
  form.e(0, 1) *= root;
  form.e(1, 0) *= root;
  form.f[end] *= scale;
}

Mat2 inverse_or_zero(const Mat2& m) {
  if (m(0, 0) > 0.0 && m(1, 1) > 0.0 && m.determinant() > 1e-12 * m(0, 0) * m(1, 1)) return m.inverse();
  Mat2 inverse = Mat2::Zero();
  for (int i = 0; i < 2; ++i) {
    if (m(i, i) > 0.0) inverse(i, i) = 1.0 / m(i, i);
  }
  if (m(0, 0) > 0.0 && m(1, 1) > 0.0) inverse(1, 1) = 0.0;
  return inverse;
}

}  // namespace

void MapStep::begin(const WallMap& map, SubmapNeighbourhood part) {
  part_ = std::move(part);
  const std::size_t n = part_.submaps.size();
  slots_.assign(map.submaps.size(), kNone);
  poses_.clear();
  diagonal_.assign(n, Mat3::Zero());
  reduced_.assign(n, Mat3::Zero());
  for (Index slot = 0; slot < n; ++slot) {
    const SubmapRecord& submap = map.submaps[part_.submaps[slot]];
    slots_[part_.submaps[slot]] = slot;
    poses_.push_back(submap.T_map_submap);
    // What is known next to nothing of, walls that are parallel but for noise would carry far along them.
    const double position = submap.lines_only ? kHoldLines : kHold;
    diagonal_[slot].diagonal() = reduced_[slot].diagonal() = Vec3(position, position, kHoldHeading);
  }
  first_slot_ = slots_.empty() ? kNone : slots_[0];
  active_ = map.active() != kNone ? map.active() : map.submaps.size() - 1;
  r_.assign(n, Vec3::Zero());
  x_.assign(n, Vec3::Zero());
  links_.clear();
  columns_.clear();
  next_wall_ = 0;
  debt_ = 0.0;
  iterations_ = 0;
  stage_ = Stage::gather;
}

void MapStep::gather(const WallMap& map, Index w) {
  const WallRecord& wall = map.walls[w];
  if (wall.merged_into != kNone) return;
  const WallBasis& basis = wall.estimate.basis;
  Column column{links_.size(), 0, Mat2::Zero(), Mat2::Zero()};
  WallForm sum;
  bool is_held = false;  // by a submap that stays
  forms_.clear();
  for (const Membership& at : wall.memberships) {
    if (at.submap >= slots_.size()) continue;
    const SubmapRecord& submap = map.submaps[at.submap];
    const WallEvidence& evidence = submap.members[at.member].evidence;
    if (evidence.count() == 0) continue;
    const Index slot = slots_[at.submap];
    const Pose2 T = (slot == kNone ? submap.T_map_submap : poses_[slot]).inverse();
    WallForm form = evidence.form({T * basis.origin, T.rotate(basis.direction)}, map.noise());
    for (int k = 0; k < 2; ++k) {
      if (!wall.estimate.known[k]) {
        form.drop_end(k);
        continue;
      }
      const double e = form.e(k, k);
      if (e <= 0.0 || form.e(0, 1) != 0.0) continue;
      const double off = std::abs(form.f[k] / e - wall.estimate.end[k]);
      if (off > kHuber_m) scale_end(form, k, kHuber_m / off);
    }
    sum.add(form);
    if (slot == kNone) {
      is_held = true;
      continue;
    }
    forms_.push_back(form);
    links_.push_back({slot, Mat34::Zero()});
  }
  column.end = links_.size();
  if (column.end - column.first < (is_held ? 1 : 2)) {  // tells nothing of the poses
    links_.resize(column.first);
    return;
  }
  column.line_inverse = inverse_or_zero(sum.h);
  column.ends_inverse = inverse_or_zero(sum.e);
  const Eigen::Matrix4d inverse = matrix(column.line_inverse, column.ends_inverse);
  const Vec4 solution = inverse * vector(sum);
  for (std::size_t i = column.first; i < column.end; ++i) {
    Link& link = links_[i];
    const WallForm& form = forms_[i - column.first];
    const Eigen::Matrix<double, 4, 3> D = motion(basis, poses_[link.slot].t);
    const Eigen::Matrix4d h = matrix(form.h, form.e);
    link.coupling = D.transpose() * h;
    const Mat3 own = link.coupling * D;
    diagonal_[link.slot] += own;
    reduced_[link.slot] += own - link.coupling * inverse * link.coupling.transpose();
    r_[link.slot] += link.coupling * solution - D.transpose() * vector(form);
  }
  columns_.push_back(column);
}

void MapStep::finish_gathering() {
  const std::size_t n = poses_.size();
  preconditioner_.resize(n);
  z_.resize(n);
  for (std::size_t s = 0; s < n; ++s) {
    Mat3 block = reduced_[s];
    // What nothing determines is left alone: a floor far above what rounding leaves there.
    const double position = diagonal_[s](0, 0) + diagonal_[s](1, 1);
    block.diagonal() += 1e-6 * Vec3(position, position, diagonal_[s](2, 2)) + Vec3::Constant(1e-9);
    preconditioner_[s] = block.inverse();
    if (!preconditioner_[s].allFinite()) preconditioner_[s].setZero();
  }
  if (first_slot_ != kNone) r_[first_slot_].setZero();
  rz_ = 0.0;
  for (std::size_t s = 0; s < n; ++s) {
    z_[s] = preconditioner_[s] * r_[s];
    rz_ += r_[s].dot(z_[s]);
  }
  p_ = z_;
  q_.resize(n);
  first_rz_ = rz_;
}

/// y = S x, S being the poses' matrix with the walls eliminated.
void MapStep::multiply(const std::vector<Vec3>& x, std::vector<Vec3>& y) const {
  for (std::size_t s = 0; s < x.size(); ++s) y[s] = diagonal_[s] * x[s];
  for (const Column& column : columns_) {
    Vec4 sum = Vec4::Zero();
    for (std::size_t i = column.first; i < column.end; ++i)
      sum += links_[i].coupling.transpose() * x[links_[i].slot];
    Vec4 wall;
    wall.head<2>() = column.line_inverse * sum.head<2>();
    wall.tail<2>() = column.ends_inverse * sum.tail<2>();
    for (std::size_t i = column.first; i < column.end; ++i) y[links_[i].slot] -= links_[i].coupling * wall;
  }
  if (first_slot_ != kNone) y[first_slot_].setZero();
}

void MapStep::iterate() {
  multiply(p_, q_);
  double pq = 0.0;
  for (std::size_t s = 0; s < p_.size(); ++s) pq += p_[s].dot(q_[s]);
  ++iterations_;
  if (!(pq > 0.0)) {
    stage_ = Stage::done;
    return;
  }
  const double alpha = rz_ / pq;
  double next = 0.0;
  for (std::size_t s = 0; s < p_.size(); ++s) {
    x_[s] += alpha * p_[s];
    r_[s] -= alpha * q_[s];
    z_[s] = preconditioner_[s] * r_[s];
    next += r_[s].dot(z_[s]);
  }
  const double beta = next / rz_;
  rz_ = next;
  for (std::size_t s = 0; s < p_.size(); ++s) p_[s] = z_[s] + beta * p_[s];
  const int most = 20 + 20 * static_cast<int>(p_.size());
  if (!(rz_ > tolerance_ * tolerance_ * first_rz_) || iterations_ >= most) stage_ = Stage::done;
}

bool MapStep::advance(const WallMap& map, double work) {
  work -= std::exchange(debt_, 0.0);
  while (work > 0.0 && stage_ != Stage::done) {
    if (stage_ == Stage::gather) {
      if (next_wall_ == part_.walls.size()) {
        finish_gathering();
        stage_ = first_rz_ > 0.0 ? Stage::solve : Stage::done;
        continue;
      }
      const Index wall = part_.walls[next_wall_++];
      work -= 4.0 * static_cast<double>(1 + map.walls[wall].memberships.size());
      gather(map, wall);
    } else if (stage_ == Stage::solve) {
      work -= kWorkOfLink * static_cast<double>(links_.size() + 2 * p_.size());
      iterate();
    } else {
      return false;
    }
  }
  if (stage_ == Stage::done) return true;
  debt_ = std::max(0.0, -work);
  return false;
}

bool MapStep::apply(WallMap& map) {
  stage_ = Stage::idle;
  largest_move_ = 0.0;
  for (const Vec3& x : x_) {
    if (!x.allFinite() || std::abs(x(2)) > kMostTurn_rad || x.head<2>().norm() > kMostMove_m) return false;
    largest_move_ = std::max({largest_move_, x.head<2>().norm(), std::abs(x(2))});
  }
  const Pose2 active = map.submaps[active_].T_map_submap;
  for (std::size_t slot = 0; slot < x_.size(); ++slot)
    map.submaps[part_.submaps[slot]].T_map_submap = poses_[slot].moved(x_[slot].head<2>(), x_[slot](2));
  const Pose2 carried = map.submaps[active_].T_map_submap * active.inverse();
  for (std::size_t s = slots_.size(); s < map.submaps.size(); ++s)
    map.submaps[s].T_map_submap = carried * map.submaps[s].T_map_submap;
  return true;
}

}  // namespace hallway::slam_plane
