// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "geometry/se3.hpp"
#include "trace/triangle_mesh.hpp"

namespace hallway::trace {

/// A ray in the world frame.
struct Ray {
  Vec3 origin = Vec3::Zero();      ///< metres
  Vec3 direction = Vec3::UnitX();  ///< of any length; a zero direction hits nothing
  double max_distance = 0.0;       ///< metres from the origin, may be infinite; below zero hits nothing
};

/// Where a ray meets the scene.
struct Hit {
  double distance = 0.0;       ///< metres from the ray's origin, computed in double precision
  std::uint32_t triangle = 0;  ///< index into TriangleMesh::triangles
};

/// How a scene finds the triangles that a ray may hit. Which triangle is hit, and where, is what one and the same
/// predicate in double precision says, so that both give the same answers.
enum class Backend {
  kEmbree,      ///< a tree of boxes, logarithmic in the number of triangles
  kBruteForce,  ///< every triangle for every ray: the oracle of the tests, and for the thread sanitizer
};

class QueryBackend;

/// A set of triangles that can be asked what a ray meets. Queries may run on any number of threads at once.
///
/// What counts as a hit (the same for both backends):
/// - distances from 0 to `max_distance`, ends included, from either side; a triangle through the origin is
///   hit at 0;
/// - edges and vertices belong to the triangle, so no ray slips between two triangles that share an edge;
/// - a ray within 1e-9 rad of a triangle's plane runs along it and does not hit it (it may hit the
///   neighbours, at their edges); a triangle without area is never hit;
/// - of several triangles at the same distance the one with the lowest index is hit.
///
/// Rounding lets a triangle reach over its edges by at most 4e-15 w (w + d) / l: w the width of the triangle,
/// d the distance from the ray's origin, l the length of the edge. That is far less than 0.1 mm in a scene of
/// buildings (w = 100 m, d = 10 km, l = 1 cm: 0.4 um); a ray that passes further than that from all edges is
/// decided as in exact arithmetic.
class Scene {
 public:
  /// Coordinates of vertices may reach this far from the world's origin, in metres.
  static constexpr double kMaxCoordinate = 1e7;
  /// Rays may start this far from the world's origin, in metres along each axis.
  static constexpr double kMaxRayCoordinate = 1e8;
  /// Whether a ray may start or end at a point: it is finite and within kMaxRayCoordinate.
  static bool takes(const Vec3& point) {
    const auto within = [](double value) { return std::abs(value) <= kMaxRayCoordinate; };  // false for NaN
    return within(point.x()) && within(point.y()) && within(point.z());
  }

  /// Copies the triangles and builds what the backend needs: O(n log n). An empty mesh is a scene that is
  /// never hit. Throws Error{kBadInput} naming the triangle or vertex if an index is out of range, or a
  /// coordinate is not finite or beyond kMaxCoordinate; Error{kInternal} with Embree's own message if Embree
  /// fails.
  Scene(const TriangleMesh& mesh, Backend backend);
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// The nearest hit. Throws Error{kBadInput} if the ray holds a NaN, or starts beyond kMaxRayCoordinate.
  std::optional<Hit> first_hit(const Ray& ray) const;

  /// Asks first_hit() for many rays: the same answers, in less time; least where rays that follow each other start and end near each
  /// other, as those of neighbouring beams of a scanner do. Uses no memory that grows with their number. Throws as first_hit() does,
  /// and Error{kInternal} if the lengths differ; the answers are then not complete.
  void first_hits(std::span<const Ray> rays, std::span<std::optional<Hit>> hits) const;

  /// Whether any triangle touches the segment between the two points, ends included. The same for (a, b) and
  /// (b, a). False for a segment without length. Throws as first_hit() does.
  bool occluded(const Vec3& from, const Vec3& to) const;

  /// Asks occluded(eye, p) for many points: the same answers, as 0 or 1, in less time; least where points that follow each
  /// other lie near each other. Uses no memory that grows with their number. Throws as occluded() does, and
  /// Error{kInternal} if the lengths differ; the answers are then not complete.
  void occluded_from(const Vec3& eye, std::span<const Vec3> points,
                     std::span<std::uint8_t> occluded_points) const;

 private:
  std::unique_ptr<const QueryBackend> backend_;
};

/// The backend's name, version and instruction set for the record of a run, e.g. "Embree 3.13.5, ISA avx2".
/// Answers do not depend on the instruction set.
std::string backend_description(Backend backend);

}  // namespace hallway::trace
