// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "trace/scene.hpp"
#include "trace/sight_line.hpp"
#include "trace/triangle_set.hpp"

namespace hallway::trace {

/// What a Scene asks; it has checked that all coordinates are finite and within Scene::kMaxRayCoordinate.
/// Queries are const and may run on any number of threads at once.
class QueryBackend {
 public:
  static constexpr std::size_t kMostLines = 64;  ///< of a call of first_hits()

  QueryBackend() = default;
  virtual ~QueryBackend() = default;
  QueryBackend(const QueryBackend&) = delete;
  QueryBackend& operator=(const QueryBackend&) = delete;

  /// The least hit by (distance, triangle).
  virtual std::optional<Hit> first_hit(const SightLine& line) const = 0;
  /// The same for many lines, at most kMostLines; `hits` has their length.
  virtual void first_hits(std::span<const SightLine> lines, std::span<std::optional<Hit>> hits) const = 0;
  /// Whether there is any hit on sight_line_between() the two.
  virtual bool occluded(const Vec3& from, const Vec3& to) const = 0;
  /// The same for many lines from one point; `occluded` has the length of `points`.
  virtual void occluded_from(const Vec3& eye, std::span<const Vec3> points,
                             std::span<std::uint8_t> occluded) const = 0;
};

std::unique_ptr<const QueryBackend> make_brute_force_backend(TriangleSet triangles);
std::unique_ptr<const QueryBackend> make_embree_backend(TriangleSet triangles);

/// Embree's version and the instruction set that it uses.
std::string embree_description();

}  // namespace hallway::trace
