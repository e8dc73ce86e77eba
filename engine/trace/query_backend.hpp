// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "trace/scene.hpp"
#include "trace/sight_line.hpp"
#include "trace/triangle_set.hpp"

namespace hallway::trace {

/// What a Scene asks. Queries are const and may run on any number of threads at once.
class QueryBackend {
 public:
  QueryBackend() = default;
  virtual ~QueryBackend() = default;
  QueryBackend(const QueryBackend&) = delete;
  QueryBackend& operator=(const QueryBackend&) = delete;

  /// The least hit by (distance, triangle).
  virtual std::optional<Hit> first_hit(const SightLine& line) const = 0;
  /// Whether there is any hit.
  virtual bool any_hit(const SightLine& line) const = 0;
};

std::unique_ptr<const QueryBackend> make_brute_force_backend(TriangleSet triangles);

/// Throws Error{kInternal} if Embree fails.
std::unique_ptr<const QueryBackend> make_embree_backend(TriangleSet triangles);

/// Version and instruction set of Embree. Throws Error{kInternal} if Embree does not start.
std::string embree_description();

}  // namespace hallway::trace
