// SPDX-License-Identifier: MIT
#include "contact/simplex.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace hallway::contact {
namespace {

/// How far along an edge its nearest point to the origin is, in [0, 1].
double nearest_share(const Vec3& from, const Vec3& to) {
  const Vec3 along = to - from;
  const double length2 = along.squaredNorm();
  return length2 > 0.0 ? std::clamp(-from.dot(along) / length2, 0.0, 1.0) : 0.0;
}

Vec3 between(const Vec3& from, const Vec3& to, double share) {
  return share == 1.0 ? to : Vec3(from + share * (to - from));
}

}  // namespace

NearestOfTriangle nearest_of_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  const Vec3 normal = ab.cross(ac);
  const double area2 = normal.squaredNorm();
  const double size2 = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  if (area2 > 1e-26 * size2 * size2) {
    // Twice the areas that the projected origin spans with the edges.
    const double wa = normal.dot(b.cross(c)), wb = normal.dot(c.cross(a)), wc = normal.dot(a.cross(b));
    if (wa > 0.0 && wb > 0.0 && wc > 0.0) {
      const double sum = wa + wb + wc;
      return {normal * (normal.dot(a) / area2), {wa / sum, wb / sum, wc / sum}};
    }
  }
  using Ends = std::pair<std::size_t, std::size_t>;
  const std::array<const Vec3*, 3> corners{&a, &b, &c};
  NearestOfTriangle best;
  double least = INFINITY;
  for (const auto& [from, to] : {Ends(0, 1), Ends(0, 2), Ends(1, 2)}) {
    const double share = nearest_share(*corners[from], *corners[to]);
    const Vec3 point = between(*corners[from], *corners[to], share);
    if (!(point.squaredNorm() < least)) continue;
    least = point.squaredNorm();
    best = {point, {}};
    best.weights[from] = 1.0 - share;
    best.weights[to] = share;
  }
  return best;
}

/// The nearest point to the origin of a part of the simplex.
struct Simplex::Found {
  Vec3 point = Vec3::Zero();
  std::array<double, 4> weights{};  ///< of the points, zero for those that do not carry it
};

Simplex::Simplex(const DifferencePoint& point) : nearest_(point.at) {
  points_[0] = point;
}

bool Simplex::has(const DifferencePoint& point) const {
  return std::any_of(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(count_),
                     [&](const DifferencePoint& p) { return p.at == point.at; });
}

Simplex::Found Simplex::on_segment(std::size_t a, std::size_t b) const {
  const double share = nearest_share(points_[a].at, points_[b].at);
  Found found{between(points_[a].at, points_[b].at, share), {}};
  found.weights[a] = 1.0 - share;
  found.weights[b] = share;
  return found;
}

Simplex::Found Simplex::on_triangle(std::size_t a, std::size_t b, std::size_t c) const {
  const NearestOfTriangle nearest = nearest_of_triangle(points_[a].at, points_[b].at, points_[c].at);
  Found found{nearest.point, {}};
  found.weights[a] = nearest.weights[0];
  found.weights[b] = nearest.weights[1];
  found.weights[c] = nearest.weights[2];
  return found;
}

Simplex::Found Simplex::nearest_of_four() const {
  constexpr std::array<std::array<std::size_t, 4>, 4> kFaces{
      {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}}};
  bool inside = true;
  Found best;
  double least = INFINITY;
  for (const auto& [a, b, c, opposite] : kFaces) {
    const Vec3& pa = points_[a].at;
    const Vec3 ab = points_[b].at - pa, ac = points_[c].at - pa, up = points_[opposite].at - pa;
    const Vec3 normal = ab.cross(ac);
    const double height = normal.dot(up), of_origin = -normal.dot(pa);
    const bool flat = std::abs(height) <= 1e-14 * ab.norm() * ac.norm() * up.norm();
    if (!flat && (height > 0.0 ? of_origin >= 0.0 : of_origin <= 0.0)) continue;  // not beyond this face
    inside = false;
    const Found found = on_triangle(a, b, c);
    if (found.point.squaredNorm() < least) {
      least = found.point.squaredNorm();
      best = found;
    }
  }
  if (inside) best.weights = {0.25, 0.25, 0.25, 0.25};
  return best;
}

void Simplex::take(const Found& found) {
  nearest_ = found.point;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    if (found.weights[i] <= 0.0) continue;
    points_[kept] = points_[i];
    weights_[kept++] = found.weights[i];
  }
  count_ = kept;
}

void Simplex::add(const DifferencePoint& point) {
  points_[count_++] = point;
  if (count_ == 2) {
    take(on_segment(0, 1));
  } else if (count_ == 3) {
    take(on_triangle(0, 1, 2));
  } else {
    take(nearest_of_four());
    holds_origin_ = count_ == 4;
  }
}

Vec3 Simplex::on_first() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < count_; ++i) sum += weights_[i] * points_[i].first;
  return sum;
}

Vec3 Simplex::on_second() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < count_; ++i) sum += weights_[i] * points_[i].second;
  return sum;
}

Vec3 Simplex::direction() const {
  Vec3 found = nearest_;
  if (count_ == 2) {
    const Vec3 along = (points_[1].at - points_[0].at).normalized();
    found = points_[0].at - along * along.dot(points_[0].at);
    found -= along * along.dot(found);
  } else if (count_ == 3) {
    found = (points_[1].at - points_[0].at).cross(points_[2].at - points_[0].at);
    if (found.dot(nearest_) < 0.0) found = -found;
  }
  const double length = found.norm();
  return length > 0.0 && std::isfinite(length) ? Vec3(found / length) : Vec3::Zero();
}

}  // namespace hallway::contact
