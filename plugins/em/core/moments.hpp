// SPDX-License-Identifier: MIT
#pragma once

#include "em/core/box_tree.hpp"
#include "em/core/types.hpp"

namespace hallway::em {

/// The total least squares plane of weighted points.
struct PlaneFit {
  PlaneFrame frame;               ///< at the centroid; u along the largest spread
  Vec3 variances = Vec3::Zero();  ///< along normal, v, u: ascending
};

/// Sums of a weighted point set from which its plane follows; adding a point costs ten multiplications, and
/// sets are joined by adding their moments. Coordinates are given relative to a place among the points, lest
/// the squares swallow the noise.
class Moments {
 public:
  /// Adds a point of weight `w`.
  void add(const Vec3& p, double w = 1.0) {
    weight_ += w;
    const double wx = w * p.x();
    const double wy = w * p.y();
    const double wz = w * p.z();
    x_ += wx;
    y_ += wy;
    z_ += wz;
    xx_ += wx * p.x();
    xy_ += wx * p.y();
    xz_ += wx * p.z();
    yy_ += wy * p.y();
    yz_ += wy * p.z();
    zz_ += wz * p.z();
  }

  /// Adds all points of another set, given relative to the same place.
  void join(const Moments& other) {
    weight_ += other.weight_;
    x_ += other.x_;
    y_ += other.y_;
    z_ += other.z_;
    xx_ += other.xx_;
    xy_ += other.xy_;
    xz_ += other.xz_;
    yy_ += other.yy_;
    yz_ += other.yz_;
    zz_ += other.zz_;
  }

  double weight() const { return weight_; }
  /// Mean; the weight must be positive.
  Vec3 mean() const { return Vec3(x_, y_, z_) / weight_; }
  /// Mean squared distance from the place that the points are given relative to.
  double mean_square() const { return xx_ / weight_ + (yy_ / weight_ + zz_ / weight_); }
  /// Covariance about the mean (divided by the weight).
  Mat3 covariance() const;
  /// Variances along the principal axes, ascending and not negative, in closed form; quicker than fit(), good
  /// to about 1e-8 of the largest.
  Vec3 variances() const;
  /// The plane through the points given relative to `reference`.
  PlaneFit fit(const Vec3& reference) const;

 private:
  double weight_ = 0.0;
  double x_ = 0.0, y_ = 0.0, z_ = 0.0;
  double xx_ = 0.0, xy_ = 0.0, xz_ = 0.0, yy_ = 0.0, yz_ = 0.0, zz_ = 0.0;
};

/// A frame at `origin` with that normal (unit); its axes depend on the normal alone.
PlaneFrame frame_on(const Vec3& origin, const Vec3& normal);

/// The frame with its normal turned to `normal` (unit), u kept as near as it can be.
PlaneFrame turned(const PlaneFrame& frame, const Vec3& normal);

}  // namespace hallway::em
