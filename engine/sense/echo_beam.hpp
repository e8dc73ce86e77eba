// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::sense {

/// Where a sonar's head hears an echo from. The head's frame: x along the beam's middle, y left, z up.
struct EchoBeamSpec {
  /// Full angle of a cone about x, (0, pi]. Without meaning where there is a polygon.
  double cone_rad = 0.5235987755982988;
  /// Corners in the x-y plane [m], either way round, the last joined with the first; it need not hold the head, nor be convex. Echoes come from what
  /// is within. Empty: a cone.
  std::vector<Vec2> polygon{};
  /// Of a polygon: full angle about the y axis through which it reaches up and down, [0, pi); 0: it is flat.
  double height_rad = 0.0;
  /// Between neighbouring rays, at most, (0, 0.2].
  double resolution_rad = 0.017453292519943295;
};

/// Distances along a ray.
struct Stretch {
  double from_m = 0.0;
  double to_m = 0.0;
};

/// One ray of a beam.
struct EchoRay {
  Vec3 direction = Vec3::UnitX();  ///< unit, head's frame
  /// Where an echo can come from, ascending; apart from each other. Of a cone the whole ray.
  std::vector<Stretch> heard{};
  bool hears(double range_m) const;
};

/// Corners of a polygon and rays of a beam, at most.
inline constexpr std::size_t kMostBeamCorners = 256;
inline constexpr std::size_t kMostBeamRays = std::size_t{1} << 16;

/// The rays that stand for a beam, the middle one first where it belongs to it. Neighbours are not farther apart than the resolution, and the rim is among them: a
/// surface that the beam meets at all at a range r is missed only where it is smaller than resolution * r across, and a range is too long by less than
/// a share of resolution^2 / 4 for surfaces that the beam meets head on.
///
/// - Cone: with n = ceil(cone / 2 / resolution), the middle and for k = 1 .. n a ring at the angle a = k cone / 2 n from it, of ceil(2 pi sin a / resolution) rays
///   at equal steps that begin at y (a = 0 to the left, then upwards).
/// - Polygon: rows of elevations at equal steps over height_rad, and in each columns of azimuths at equal steps over what the polygon spans as the head sees
///   it, each ends included.
///
/// Throws Error{kBadInput} for angles out of range, for a polygon of less than three corners or of more than kMostBeamCorners, with corners that
/// are not finite or in one place, with edges that cross or touch, and for more than kMostBeamRays.
/// @param max_range_m  how far a cone reaches
std::vector<EchoRay> echo_rays(const EchoBeamSpec& spec, double max_range_m);

/// The azimuths that a polygon spans as the origin sees it.
struct EchoSpan {
  double from_rad = -3.14159265358979323846;
  double width_rad = 2.0 * 3.14159265358979323846;
};

/// A polygon that winds about the origin, or has it on an edge, spans a full turn. The polygon is one that echo_rays() takes.
EchoSpan echo_span(std::span<const Vec2> corners);

/// Of a ray in the plane from the origin, what is within a polygon: ascending, apart.
std::vector<Stretch> within_polygon(std::span<const Vec2> corners, const Vec2& direction);

}  // namespace hallway::sense
