// SPDX-License-Identifier: MIT
#include "contact/twist_limits.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::contact {
namespace {

/// A limit of twists whose turn is a speed at the radius of gyration.
struct Row {
  Vec3 normal;
  double least;
};

/// The nearest point to a point on all planes of a set, if the set's normals push it there and do not pull.
class ActiveSet {
 public:
  ActiveSet(const std::vector<Row>& rows, const Vec3& wanted) : rows_(rows), wanted_(wanted) {}

  std::optional<Vec3> none() const { return kept(wanted_); }

  std::optional<Vec3> one(std::size_t i) const {
    const Row& row = rows_[i];
    const double push = (row.least - row.normal.dot(wanted_)) / row.normal.squaredNorm();
    if (!(push >= 0.0)) return std::nullopt;
    return kept(wanted_ + push * row.normal);
  }

  std::optional<Vec3> two(std::size_t i, std::size_t j) const {
    const Vec3 &a = rows_[i].normal, &b = rows_[j].normal;
    const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
    const double determinant = a.cross(b).squaredNorm();
    if (!(determinant > 1e-18 * aa * bb)) return std::nullopt;
    const double p = rows_[i].least - a.dot(wanted_), q = rows_[j].least - b.dot(wanted_);
    const double push_a = (bb * p - ab * q) / determinant, push_b = (aa * q - ab * p) / determinant;
    if (!(push_a >= 0.0 && push_b >= 0.0)) return std::nullopt;
    return kept(wanted_ + push_a * a + push_b * b);
  }

  std::optional<Vec3> three(std::size_t i, std::size_t j, std::size_t k) const {
    const Vec3 &a = rows_[i].normal, &b = rows_[j].normal, &c = rows_[k].normal;
    const double volume = a.dot(b.cross(c));
    if (!(std::abs(volume) > 1e-12 * a.norm() * b.norm() * c.norm())) return std::nullopt;
    const Vec3 point =
        (rows_[i].least * b.cross(c) + rows_[j].least * c.cross(a) + rows_[k].least * a.cross(b)) / volume;
    const Vec3 way = point - wanted_;
    const double push_a = way.dot(b.cross(c)) / volume, push_b = way.dot(c.cross(a)) / volume,
                 push_c = way.dot(a.cross(b)) / volume;
    if (!(push_a >= 0.0 && push_b >= 0.0 && push_c >= 0.0)) return std::nullopt;
    return kept(point);
  }

 private:
  std::optional<Vec3> kept(const Vec3& point) const {
    for (const Row& row : rows_) {
      const double size = row.normal.norm() * std::max(point.norm(), wanted_.norm()) + std::abs(row.least);
      if (row.normal.dot(point) < row.least - 1e-12 * size) return std::nullopt;
    }
    return point;
  }

  const std::vector<Row>& rows_;
  const Vec3& wanted_;
};

std::optional<Vec3> nearest(const std::vector<Row>& rows, const Vec3& wanted) {
  const ActiveSet set(rows, wanted);
  if (const auto point = set.none()) return point;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (const auto point = set.one(i)) return point;
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = i + 1; j < rows.size(); ++j) {
      if (const auto point = set.two(i, j)) return point;
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = i + 1; j < rows.size(); ++j) {
      for (std::size_t k = j + 1; k < rows.size(); ++k) {
        if (const auto point = set.three(i, j, k)) return point;
      }
    }
  }
  return std::nullopt;
}

}  // namespace

TwistLimit limit_at(const Pose& pose, const Vec3& point, const Vec3& normal, double least) {
  const Quat back = pose.q.conjugate();
  const Vec3 n = back * normal, r = back * (point - pose.t);
  return {n.x(), n.y(), r.x() * n.y() - r.y() * n.x(), least};
}

std::optional<PlanarTwist> nearest_twist(const PlanarTwist& wanted, const std::vector<TwistLimit>& limits,
                                         double gyration) {
  std::vector<Row> rows;
  bool standing = true;
  for (std::size_t i = 0; i < std::min(limits.size(), kMostLimits); ++i) {
    const TwistLimit& limit = limits[i];
    rows.push_back({Vec3(limit.x, limit.y, limit.turn / gyration), limit.least});
    standing = standing && limit.least <= 0.0;
  }
  const Vec3 scaled(wanted.forward_m_s, wanted.lateral_m_s, wanted.angular_rad_s * gyration);
  const std::optional<Vec3> found = nearest(rows, scaled);
  if (found) return PlanarTwist{found->x(), found->y(), found->z() / gyration};
  if (standing) return PlanarTwist{};
  return std::nullopt;
}

std::optional<PlanarTwist> shortened_twist(const PlanarTwist& wanted, const std::vector<TwistLimit>& limits) {
  double share = 1.0;
  for (const TwistLimit& limit : limits) {
    if (limit.least > 0.0) {
      if (limit.speed(wanted) < limit.least) return std::nullopt;
      continue;
    }
    const double speed = limit.speed(wanted);
    if (speed < limit.least) share = std::min(share, limit.least / speed);
  }
  return wanted * share;
}

}  // namespace hallway::contact
