// SPDX-License-Identifier: MIT
#include "trace/sight_line.hpp"

#include <algorithm>

namespace hallway::trace {

std::optional<SightLine> sight_line(const Vec3& origin, const Vec3& direction, double max_distance) {
  const double largest = direction.cwiseAbs().maxCoeff();
  if (largest == 0.0 || max_distance < 0.0) return std::nullopt;
  return SightLine{origin, (direction / largest).normalized(), max_distance};
}

std::optional<SightLine> sight_line_between(const Vec3& one, const Vec3& other) {
  // Starting at the lesser point makes the answer the same from both ends, also where rounding decides.
  const bool ordered = std::lexicographical_compare(one.begin(), one.end(), other.begin(), other.end());
  const Vec3& from = ordered ? one : other;
  const Vec3& to = ordered ? other : one;
  return sight_line(from, to - from, (to - from).norm());
}

}  // namespace hallway::trace
