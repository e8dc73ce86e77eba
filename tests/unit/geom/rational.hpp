// SPDX-License-Identifier: MIT
#pragma once

#include <gmpxx.h>

#include <array>

#include "geom/exact_plane.hpp"

/// Planes and points in rational arithmetic, straight from the definitions: what the fast predicates must agree with.
namespace hallway::test {

using Rational3 = std::array<mpq_class, 3>;

inline mpq_class rational(double value) {
  return mpq_class(value);  // exact: a double is a fraction
}

inline mpq_class determinant(const Rational3& a, const Rational3& b, const Rational3& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

inline Rational3 rational_normal(const ExactPlane& plane) {
  return {rational(plane.abcd[0]), rational(plane.abcd[1]), rational(plane.abcd[2])};
}

inline Rational3 rational_point(const Vec3& point) {
  return {rational(point.x()), rational(point.y()), rational(point.z())};
}

/// a x + b y + c z - d.
inline mpq_class height(const ExactPlane& plane, const Rational3& point) {
  const Rational3 n = rational_normal(plane);
  return n[0] * point[0] + n[1] * point[1] + n[2] * point[2] - rational(plane.abcd[3]);
}

/// Whether the normals of three planes are linearly independent.
inline bool independent(const ExactPlane& a, const ExactPlane& b, const ExactPlane& c) {
  return sgn(determinant(rational_normal(a), rational_normal(b), rational_normal(c))) != 0;
}

/// The point that three planes share, by Cramer's rule.
inline Rational3 shared_point(const ExactPlane& a, const ExactPlane& b, const ExactPlane& c) {
  std::array<Rational3, 3> columns;
  const std::array<const ExactPlane*, 3> planes{&a, &b, &c};
  Rational3 offsets;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) columns[k][i] = rational(planes[i]->abcd[k]);
    offsets[i] = rational(planes[i]->abcd[3]);
  }
  const mpq_class all = determinant(columns[0], columns[1], columns[2]);
  return {determinant(offsets, columns[1], columns[2]) / all,
          determinant(columns[0], offsets, columns[2]) / all,
          determinant(columns[0], columns[1], offsets) / all};
}

inline Rational3 shared_point(const PlaneSet& planes, const ExactPoint& point) {
  return shared_point(planes[point.planes[0]], planes[point.planes[1]], planes[point.planes[2]]);
}

}  // namespace hallway::test
