// SPDX-License-Identifier: MIT
#include "host/samples/plane_lists.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/unit_quaternion.hpp"
#include "host/samples/strided.hpp"
#include "host/samples/three.hpp"

namespace hallway::host {
namespace {

double reach_of(const hw_plane_t& plane) {
  double reach = 0;
  for (const Three& corner : plane.corners) reach = std::max(reach, length(corner));
  return reach;
}

/// Whether a point is on a plane; false for one that is not finite.
class OnPlane {
 public:
  explicit OnPlane(const hw_plane_t& plane) : plane_(plane), tolerance_(kOnPlane * reach_of(plane)) {}
  bool operator()(const Three& point) const {
    return std::abs(dot(plane_.normal, point) - plane_.offset_m) <= tolerance_;
  }

 private:
  const hw_plane_t& plane_;
  double tolerance_;
};

bool is_finite(const hw_plane_t& plane) {
  const bool corners =
      std::ranges::all_of(plane.corners, [](const Three& corner) { return host::is_finite(corner); });
  return corners && host::is_finite(plane.normal) && host::is_finite(plane.centroid) &&
         std::isfinite(plane.offset_m) && std::isfinite(plane.rms_m) && std::isfinite(plane.exclusive_share);
}

/// What is wrong with a plane's own numbers, null if nothing.
const char* plane_problem(const hw_plane_t& plane) {
  if (!is_finite(plane)) return "a number that is not finite";
  if (std::abs(length(plane.normal) - 1.0) > kUnitTolerance) return "a normal that is not of unit length";
  if (plane.offset_m > 0) return "a normal that points away from the sensor";
  if (plane.rms_m < 0) return "a negative rms_m";
  if (plane.exclusive_share < 0 || plane.exclusive_share > 1) return "an exclusive_share outside of 0 to 1";
  const OnPlane is_on(plane);
  if (!is_on(plane.centroid)) return "a centroid that is not on it";
  if (!std::ranges::all_of(plane.corners, is_on)) return "a corner that is not on it";
  const double reach = reach_of(plane);
  if (turn(plane.corners[0], plane.corners[1], plane.corners[3], plane.normal) < -kOnPlane * reach * reach)
    return "corners that run clockwise";
  return nullptr;
}

void check_hull(const hw_plane_t& plane, std::span<const hw_point3_t> hull) {
  const OnPlane is_on(plane);
  for (const hw_point3_t& point : hull) {
    if (!is_on({point.x, point.y, point.z}))
      throw Malformed{fmt::format("plane {} has a hull point that is not on it", plane.id)};
  }
}

/// Checks that a range lies within a list and behind the one before; `end` is where that ended.
void check_range(const hw_plane_t& plane, std::uint64_t first, std::uint64_t count, std::size_t size,
                 std::uint64_t& end, const char* what) {
  if (count == 0) return;
  if (!lies_within(first, count, size))
    throw Malformed{fmt::format("plane {} has {} beyond their list", plane.id, what)};
  if (first < end) throw Malformed{fmt::format("plane {} has {} of the plane before it", plane.id, what)};
  end = first + count;
}

void check_members(const hw_plane_t& plane, std::span<const std::uint32_t> members, std::uint64_t elements) {
  if (plane.n_members != 0 && plane.n_members != plane.n_points) {
    throw Malformed{
        fmt::format("plane {} has {} members and {} points", plane.id, plane.n_members, plane.n_points)};
  }
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (members[i] >= elements)
      throw Malformed{
          fmt::format("plane {} has member {} of a sample of {}", plane.id, members[i], elements)};
    if (i > 0 && members[i] <= members[i - 1])
      throw Malformed{fmt::format("plane {} has members that do not ascend", plane.id)};
  }
}

template <typename T, typename Range>
std::span<const T> part(const std::vector<T>& all, const Range& range) {
  return std::span(all).subspan(range.first, range.count);
}

void check_ids(std::span<const hw_plane_t> planes) {
  std::vector<std::uint64_t> ids;
  for (const hw_plane_t& plane : planes) ids.push_back(plane.id);
  std::ranges::sort(ids);
  const auto twice = std::ranges::adjacent_find(ids);
  if (twice != ids.end()) throw Malformed{fmt::format("two of them have the id {}", *twice)};
}

}  // namespace

void clear_empty_ranges(std::span<hw_plane_t> planes) {
  for (hw_plane_t& plane : planes) {
    if (plane.n_hull == 0) plane.first_hull = 0;
    if (plane.n_members == 0) plane.first_member = 0;
  }
}

void check_plane_list(const PlaneList& list, std::uint64_t elements) {
  std::uint64_t hull_end = 0, members_end = 0;
  for (const hw_plane_t& plane : list.planes) {
    if (const char* problem = plane_problem(plane))
      throw Malformed{fmt::format("plane {} has {}", plane.id, problem)};
    check_range(plane, plane.first_hull, plane.n_hull, list.hull_points.size(), hull_end, "hull points");
    check_range(plane, plane.first_member, plane.n_members, list.members.size(), members_end, "members");
    check_hull(plane, list.hull_of(plane));
    check_members(plane, list.members_of(plane), elements);
  }
  check_ids(list.planes);
}

void PlaneLists::clear() {
  entries_.clear();
  planes_.clear();
  hull_points_.clear();
  members_.clear();
}

std::optional<PlaneList> PlaneLists::of(std::uint32_t sample) const {
  const auto entry = std::ranges::lower_bound(entries_, sample, {}, &Entry::sample);
  if (entry == entries_.end() || entry->sample != sample) return std::nullopt;
  return PlaneList{part(planes_, entry->planes), part(hull_points_, entry->hull_points),
                   part(members_, entry->members)};
}

void PlaneLists::add(const hw_planes_t& planes, std::uint32_t sample, std::uint64_t elements) {
  demand(!of(sample), "a second time for one sample");
  const Strided<hw_plane_t> list(planes.planes, planes.count, planes.stride);
  const Strided<hw_point3_t> hull_points(planes.hull_points, planes.n_hull_points, planes.hull_stride);
  check_list(planes.members, planes.n_members);
  const Entry entry{sample,
                    {planes_.size(), list.size()},
                    {hull_points_.size(), hull_points.size()},
                    {members_.size(), planes.n_members}};
  list.append_to(planes_);
  clear_empty_ranges(std::span(planes_).subspan(entry.planes.first));
  hull_points.append_to(hull_points_);
  members_.resize(members_.size() + planes.n_members);
  if (planes.n_members != 0)
    std::memcpy(&members_[entry.members.first], planes.members, planes.n_members * sizeof(std::uint32_t));
  check_plane_list(
      {part(planes_, entry.planes), part(hull_points_, entry.hull_points), part(members_, entry.members)},
      elements);
  entries_.insert(std::ranges::upper_bound(entries_, sample, {}, &Entry::sample), entry);
}

}  // namespace hallway::host
