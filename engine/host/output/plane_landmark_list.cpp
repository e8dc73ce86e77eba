// SPDX-License-Identifier: MIT
#include "host/output/plane_landmark_list.hpp"

#include <hallway/output.h>

#include <algorithm>
#include <cmath>

#include "base/unit_quaternion.hpp"
#include "host/samples/strided.hpp"
#include "host/samples/three.hpp"

namespace hallway::host {
namespace {

constexpr std::uint64_t kLeastCorners = 3;

/// What is wrong with a plane's own numbers, null if nothing.
const char* number_problem(const hw_mapped_plane_t& plane) {
  if (!is_finite(plane.normal) || !std::isfinite(plane.offset_m)) return "a number that is not finite";
  if (std::abs(length(plane.normal) - 1.0) > kUnitTolerance) return "a normal that is not of unit length";
  if (plane.n_corners < kLeastCorners) return "fewer than 3 corners";
  return nullptr;
}

/// What is wrong with a plane's outline, null if nothing.
const char* outline_problem(const hw_mapped_plane_t& plane, std::span<const hw_mapped_corner_t> outline) {
  double reach = 0;
  for (const hw_mapped_corner_t& corner : outline) {
    if (!is_finite(corner.position)) return "a corner that is not finite";
    reach = std::max(reach, length(corner.position));
  }
  for (const hw_mapped_corner_t& corner : outline) {
    if (!(std::abs(dot(plane.normal, corner.position) - plane.offset_m) <= kOnPlane * reach))
      return "a corner that is not on it";
  }
  double twice_area = 0;
  for (std::size_t i = 2; i < outline.size(); ++i)
    twice_area += turn(outline[0].position, outline[i - 1].position, outline[i].position, plane.normal);
  return twice_area < -kOnPlane * reach * reach ? "corners that run clockwise" : nullptr;
}

template <typename T>
void append(std::vector<T>& all, const Strided<T>& list) {
  demand(all.size() + list.size() <= kMaxElements, "too many in one call");
  list.append_to(all);
}

}  // namespace

void PlaneLandmarkList::clear() {
  planes_.clear();
  corners_.clear();
}

void PlaneLandmarkList::add(const hw_mapped_planes_t& planes) {
  const std::size_t first_plane = planes_.size(), first_corner = corners_.size();
  append(planes_, Strided<hw_mapped_plane_t>(planes.planes, planes.count, planes.stride));
  append(corners_, Strided<hw_mapped_corner_t>(planes.corners, planes.n_corners, planes.corner_stride));
  std::uint64_t end = 0;
  for (hw_mapped_plane_t& plane : std::span(planes_).subspan(first_plane)) {
    demand(plane.id != HW_NO_LANDMARK, "the id HW_NO_LANDMARK");
    const auto fail = [&](const char* what) {
      throw Malformed{fmt::format("plane {} has {}", plane.id, what)};
    };
    if (plane.status > HW_LANDMARK_DYNAMIC) {
      throw Malformed{fmt::format("plane {} has the unknown status {}", plane.id, plane.status)};
    }
    if (const char* problem = number_problem(plane)) fail(problem);
    if (!lies_within(plane.first_corner, plane.n_corners, planes.n_corners))
      fail("corners beyond their list");
    if (plane.first_corner < end) fail("corners of the plane before it");
    end = plane.first_corner + plane.n_corners;
    plane.first_corner += first_corner;
    if (const char* problem = outline_problem(plane, outline(plane))) fail(problem);
  }
}

}  // namespace hallway::host
