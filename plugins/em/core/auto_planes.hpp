// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "em/core/auto_options.hpp"
#include "em/core/plane_memory.hpp"
#include "em/core/types.hpp"
#include "em/core/workers.hpp"

namespace hallway::em {

/// Finds the finite planes of clouds: the algorithm `auto`. Its model is that of thesis 3.5: planes with an
/// extent, points that one of them explains or none; planes are grown from flat neighbourhoods, then all of
/// them are fitted together.
///
/// What comes out depends on the points alone: not on their order, the unit of length, or how often each is
/// given; and on rotation and translation no more than rounding does.
class PlaneExtractor {
 public:
  /// Starts the threads that the options ask for. Throws std::invalid_argument for options out of range.
  explicit PlaneExtractor(const AutoOptions& options = {});

  /// The planes of `cloud` (any frame, any unit of length). Points that are not finite, or beyond 1e100, are
  /// in no plane. About O(n log n). Throws std::length_error from 2^28 points.
  Extraction extract(std::span<const Vec3> cloud) const;

  /// The same for one of several clouds that a sensor saw one after the other: the planes of the last one are tried first; planes that are
  /// the same have the same ids, and no other plane ever has. What comes out depends on the clouds before.
  Extraction extract(std::span<const Vec3> cloud, PlaneMemory& memory) const;

 private:
  Extraction extract_from(std::span<const Vec3> cloud, const PlaneMemory& memory) const;

  AutoOptions options_;
  std::unique_ptr<Workers> workers_;
};

}  // namespace hallway::em
