// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geom/plane.hpp"

namespace hallway {

/// A plane a x + b y + c z = d whose four numbers are taken as exact. They have no common length: planes through points of a
/// grid have whole numbers.
struct ExactPlane {
  std::array<double, 4> abcd{};
  Plane unit;  ///< the same with a unit normal, rounded
  /// The coefficients as whole numbers of a common power of two, where they are small enough for 128-bit arithmetic;
  /// else `whole` is false.
  std::array<std::int64_t, 4> whole_abcd{};
  int normal_bits = 0;  ///< of the largest of whole a, b, c
  int offset_bits = 0;  ///< of whole d
  bool whole = false;
  /// True if a x + b y + c z - d is computed without rounding in double precision for grid points (see ExactPoint::on_grid).
  bool short_numbers = false;
};

/// A plane of a PlaneSet with one of its two orientations.
struct OrientedPlane {
  std::uint32_t index = 0;
  bool flipped = false;  ///< the normal is the opposite of the plane's own
  friend bool operator==(const OrientedPlane&, const OrientedPlane&) = default;
};

/// The point that three planes of a PlaneSet share. The planes define it; the coordinates are for looking at.
struct ExactPoint {
  std::array<std::uint32_t, 3> planes{};
  Vec3 at = Vec3::Zero();  ///< rounded
  double error = 0.0;      ///< no coordinate of `at` is farther off than this
  /// `at` is the point itself, and its coordinates are multiples of 1/256 up to 131072.
  bool on_grid = false;
};

/// Planes by number; planes that are the same, or nearly the same where it matters, have one number. In the unit of the
/// input, whatever it is; the limits are chosen for map units.
class PlaneSet {
 public:
  /// Which side of a plane of its own orientation something lies on.
  enum class Side : int { kBack = -1, kOn = 0, kFront = 1 };

  /// The plane through three points, its normal along (p2 - p0) x (p1 - p0): outward for points that run clockwise as seen
  /// from outside. If `extent`, the corners of the piece that is used, lie within `merge_distance` of a plane that is already
  /// there and has nearly the same normal, that one is taken. The points must not lie on a line.
  OrientedPlane add(const std::array<Vec3, 3>& points, const std::vector<Vec3>& extent,
                    double merge_distance);
  /// The plane where coordinate `axis` is `value`, its normal along the axis.
  OrientedPlane add_axial(int axis, double value);

  const ExactPlane& operator[](std::uint32_t index) const { return planes_[index]; }
  std::size_t size() const { return planes_.size(); }
  /// The plane with a unit normal in the given orientation.
  Plane unit(OrientedPlane plane) const;

  /// On which side of the plane the point lies. Exact: a filter in double precision decides nearly all; where it cannot, whole
  /// numbers of 128 bits or of any length do.
  Side side(std::uint32_t plane, const ExactPoint& point) const;
  /// The point that three planes share; their normals must be linearly independent.
  ExactPoint intersect(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  /// Whether two points are the same point.
  bool same(const ExactPoint& a, const ExactPoint& b) const;

 private:
  OrientedPlane find_or_add(const std::array<double, 4>& abcd, const std::vector<Vec3>& extent,
                            double merge_distance);
  Side side_exact(std::uint32_t plane, const ExactPoint& point) const;

  std::vector<ExactPlane> planes_;
  /// Planes by a rounded key of normal and offset: buckets of a hash table in order of addition.
  std::vector<std::vector<std::uint32_t>> buckets_;
};

}  // namespace hallway
