// SPDX-License-Identifier: MIT
#include "em/core/gaps.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "em/core/plane_shape.hpp"

namespace hallway::em {
namespace {

using Square = std::pair<std::int64_t, std::int64_t>;
using SquareMembers = std::map<Square, std::vector<PointIndex>>;

constexpr double kMostSquares =
    1e9;  // along a plane; finer ones would tell points apart that rounding does not

/// The members by the squares that they lie in.
SquareMembers squares_of(std::span<const Vec3> cloud, const Plane& plane, double side) {
  const PlaneFrame frame = flat_frame(plane.normal, plane.centroid);
  double farthest = 0.0;
  for (const PointIndex member : plane.members)
    farthest = std::max(farthest, frame.flat(cloud[member]).cwiseAbs().maxCoeff());
  side = std::max({side, farthest / kMostSquares, std::numeric_limits<double>::min()});
  SquareMembers squares;
  for (const PointIndex member : plane.members) {
    const Vec2 place = frame.flat(cloud[member]) / side;
    squares[{std::llround(place.x()), std::llround(place.y())}].push_back(member);
  }
  return squares;
}

/// Takes the squares that hang together with the first one out of the map. @return their members, ascending
std::vector<PointIndex> take_part(SquareMembers& squares) {
  std::vector<PointIndex> part;
  std::vector<Square> next;
  const auto take = [&](SquareMembers::iterator square) {
    part.insert(part.end(), square->second.begin(), square->second.end());
    next.push_back(square->first);
    squares.erase(square);
  };
  take(squares.begin());
  while (!next.empty()) {
    const Square at = next.back();
    next.pop_back();
    for (std::int64_t dx = -1; dx <= 1; ++dx) {
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        const auto beside = squares.find({at.first + dx, at.second + dy});
        if (beside != squares.end()) take(beside);
      }
    }
  }
  std::sort(part.begin(), part.end());
  return part;
}

/// The part of a plane that has these members.
Plane part_of(std::span<const Vec3> cloud, const Plane& whole, std::vector<PointIndex> members) {
  Plane part = whole;
  std::vector<Vec3> points;
  for (const PointIndex member : members) points.push_back(cloud[member]);
  const Footprint foot = footprint_of(points, whole.normal, whole.centroid);
  part.centroid = foot.centroid;
  part.rms = foot.rms;
  part.corners = corners_of(foot.outline);
  part.hull = hull_of(foot.outline);
  part.members = std::move(members);
  return part;
}

struct Part {
  Plane plane;
  std::uint32_t whole = 0;  ///< label of the plane that it is a part of
};

void add_parts(std::span<const Vec3> cloud, double gap, std::size_t min_points, Part whole,
               std::vector<Part>& parts) {
  SquareMembers squares = squares_of(cloud, whole.plane, 0.5 * gap);
  for (bool first = true; !squares.empty(); first = false) {
    std::vector<PointIndex> members = take_part(squares);
    if (first && squares.empty()) {
      parts.push_back(std::move(whole));
    } else if (members.size() >= min_points) {
      parts.push_back({part_of(cloud, whole.plane, std::move(members)), whole.whole});
    }
  }
}

}  // namespace

void split_at_gaps(std::span<const Vec3> cloud, double gap, std::size_t min_points, Extraction& found) {
  std::vector<Part> parts;
  for (std::uint32_t k = 0; k < found.planes.size(); ++k)
    add_parts(cloud, gap, min_points, {std::move(found.planes[k]), k}, parts);
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    return a.plane.members.size() > b.plane.members.size();
  });
  std::vector<std::uint32_t> labels(found.labels.size(), kNoPlane);
  found.planes.clear();
  for (Part& part : parts) {
    const auto k = static_cast<std::uint32_t>(found.planes.size());
    for (const PointIndex member : part.plane.members) {
      if (found.labels[member] == part.whole) labels[member] = k;
    }
    part.plane.id = k;
    found.planes.push_back(std::move(part.plane));
  }
  found.labels = std::move(labels);
}

}  // namespace hallway::em
