// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "planes/scene.hpp"
#include "planes/score.hpp"

namespace hallway::planes::test {

/// What a perfect plugin would answer: planes and members as they are.
inline std::vector<PlaneObservation> perfect(const Truth& truth) {
  std::vector<PlaneObservation> found;
  for (const TruePlane& plane : truth.planes) {
    PlaneObservation answer{.id = found.size(), .plane = plane.plane};
    if (plane.corners) answer.corners = *plane.corners;
    for (std::size_t i = 0; i < truth.labels.size(); ++i) {
      if (truth.labels[i] == plane.label) answer.members.push_back(static_cast<PointIndex>(i));
    }
    answer.points = answer.members.size();
    found.push_back(std::move(answer));
  }
  return found;
}

/// Points and what is true of them.
struct Case {
  std::vector<Vec3> points{};
  Truth truth{};

  Score score(const std::vector<PlaneObservation>& found) const { return score_planes(points, truth, found); }
};

/// Level squares of 10 x 10 points, one metre above the other from z = 0 on; labels 0, 1, …; then `outliers` points far away.
inline Case levels(int count, int outliers = 0) {
  Case levels;
  for (int level = 0; level < count; ++level) {
    const double z = level;
    levels.truth.planes.push_back(
        {.label = level,
         .plane = {Vec3::UnitZ(), z},
         .corners = Corners{Vec3(0, 0, z), Vec3(9, 0, z), Vec3(9, 9, z), Vec3(0, 9, z)}});
    for (int i = 0; i < 100; ++i) {
      levels.points.emplace_back(i % 10, i / 10, z);
      levels.truth.labels.push_back(level);
    }
  }
  for (int i = 0; i < outliers; ++i) {
    levels.points.emplace_back(100 + i, 50, -20);
    levels.truth.labels.push_back(kNoLabel);
  }
  return levels;
}

/// A perfect answer whose members are replaced.
inline PlaneObservation with_members(PlaneObservation plane, std::vector<PointIndex> members) {
  std::sort(members.begin(), members.end());
  plane.members = std::move(members);
  return plane;
}

/// The numbers from `begin` to before `end`.
inline std::vector<PointIndex> indices(PointIndex begin, PointIndex end) {
  std::vector<PointIndex> list;
  for (PointIndex i = begin; i < end; ++i) list.push_back(i);
  return list;
}

}  // namespace hallway::planes::test
