// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geom/box.hpp"
#include "geom/plane.hpp"
#include "map/convex_body.hpp"
#include "map/document.hpp"

namespace hallway::editor {

/// A face by three points of its plane, map units, counter-clockwise as seen from outside; the texture lies as the Standard format
/// puts it.
map::Face face_through(const Vec3& a, const Vec3& b, const Vec3& c, const std::string& material);

/// The plane of a face, map units, normal out of its brush; none where its points are on one line.
std::optional<Plane> plane_of(const map::Face& face);

/// The body that a brush is, map units; none where it is no closed body. Side::plane is the index of the face.
std::optional<map::ConvexBody> body_of(const map::Brush& brush);

/// Volume of a body, in its unit cubed. O(corners of its sides).
double volume_of(const map::ConvexBody& body);

/// What a body occupies.
Box bounds_of(const map::ConvexBody& body);

/// A point whose coordinates are so near a millionth of a unit that only rounding can have moved them away, put there.
Vec3 tidied(const Vec3& point);

/// The box between two corners, map units. Throws Error{kUsage} where it has no volume.
map::Brush box_brush(const Vec3& a, const Vec3& b, const std::string& material);

/// What lies between two convex flat polygons with the same number of corners, whose sides are flat too; map units. Either may be
/// degenerate to an edge or point of the other (a wedge): sides without area are left out.
/// @param bottom, top  counter-clockwise as seen from the top, corners over each other
/// Throws Error{kUsage} where that is no convex body with a volume and those corners.
map::Brush column(std::span<const Vec3> bottom, std::span<const Vec3> top, const std::string& material);

/// What lies between a convex flat polygon and the same one displaced, map units; the corners may run either way round.
/// Throws Error{kUsage} for fewer than three corners, a polygon that is not convex and flat, and a displacement within its plane.
map::Brush extrusion(std::span<const Vec3> base, const Vec3& way, const std::string& material);

/// A simple polygon in x and y as convex parts, counter-clockwise: ears are cut off, neighbours joined while they stay convex.
/// Corners on a straight edge are kept out. Throws Error{kUsage} for a polygon that touches or crosses itself, turns straight back or has
/// no area. O(n^3).
std::vector<std::vector<Vec3>> convex_parts(std::span<const Vec3> polygon);

/// What of a convex polygon in x and y is behind a line, on the side where `normal` does not point; counter-clockwise as it was. Empty
/// where nothing with an area is. O(n).
std::vector<Vec3> polygon_behind(std::span<const Vec3> polygon, const Vec3& place, const Vec3& normal);

/// A face through a plane, its points near `place`.
map::Face face_on(const Plane& plane, const Vec3& place, const std::string& material);

/// What is behind all those faces, each with its texture; faces that bound nothing are left out, and of two on one plane one stays.
/// None where that is no closed body.
std::optional<map::Brush> behind_all(const std::vector<map::Face>& faces);

/// What of a brush is behind a plane, and what is in front of it; the cut has the material of `cut`, whose points say where it is. A part
/// that is thinner than a millionth of a unit is none.
struct Halves {
  std::optional<map::Brush> behind{};
  std::optional<map::Brush> in_front{};
};
/// Throws Error{kUsage} where the brush is no body or the face no plane.
Halves halves(const map::Brush& brush, const map::Face& cut);

/// What two brushes have in common, each face as the brush has it that it comes from; none where that has no volume.
std::optional<map::Brush> intersection(const map::Brush& a, const map::Brush& b);

/// How the walls of a hollow body meet.
enum class Joint {
  kMitred,  ///< each face becomes one wall, their joints run from the outer edge to the inner one
  kSlabs,   ///< each wall ends at those before it
};

/// The walls of a brush, without its inside; together with it they are the brush, and none overlaps another.
/// @param inside  material of their inner faces; empty: that of the outer face
/// Throws Error{kUsage} where the brush is no body, or so thin that nothing is inside. O(faces^3).
std::vector<map::Brush> hollowed(const map::Brush& brush, double thickness, Joint joint,
                                 const std::string& inside);

}  // namespace hallway::editor
