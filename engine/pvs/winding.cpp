// SPDX-License-Identifier: MIT
#include "pvs/winding.hpp"

#include <algorithm>
#include <limits>

namespace hallway::pvs {

Cut cut(const Winding& winding, const Cutter& plane, Winding& rest) {
  std::array<double, Winding::kCapacity + 1> reach;
  double highest = -std::numeric_limits<double>::infinity();
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < winding.count; ++i) {
    reach[i] = plane.reach(winding.points[i]);
    highest = std::max(highest, reach[i]);
    lowest = std::min(lowest, reach[i]);
  }
  if (highest < 0.0) return Cut::kNothing;
  if (lowest >= 0.0 || winding.count == Winding::kCapacity) return Cut::kAll;
  reach[winding.count] = reach[0];
  std::size_t count = 0;
  for (std::size_t i = 0; i < winding.count; ++i) {
    const double here = reach[i];
    const double there = reach[i + 1];
    const Vec3& point = winding.points[i];
    if (here >= 0.0) rest.points[count++] = point;
    if ((here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0)) {
      const Vec3& next = winding.points[i + 1 == winding.count ? 0 : i + 1];
      rest.points[count++] = point + (here / (here - there)) * (next - point);
    }
  }
  rest.count = count;
  return count < 3 ? Cut::kNothing : Cut::kPart;
}

}  // namespace hallway::pvs
