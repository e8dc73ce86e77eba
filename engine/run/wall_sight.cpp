// SPDX-License-Identifier: MIT
#include "run/wall_sight.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "host/strided.hpp"
#include "run/abi_pose.hpp"

namespace hallway::run {
namespace {

/// Points stand a little off the faces that they are on.
constexpr double kOnWall_m = 0.005;

Vec3 place_of(const std::array<double, 3>& numbers) {
  return Vec3(numbers.data());
}

bool stands_on(const Vec3& point, const log::TrueWall& wall) {
  const Vec3 corner = place_of(wall.corners_m[0]);
  const Vec3 along = place_of(wall.corners_m[1]) - corner, up = place_of(wall.corners_m[3]) - corner;
  const Vec3 normal = along.cross(up).normalized();
  const Vec3 from = point - corner;
  const double u = along.dot(from) / along.squaredNorm(), v = up.dot(from) / up.squaredNorm();
  return std::abs(normal.dot(from)) <= kOnWall_m && u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0;
}

const hw_planes_t* planes_in(const hw_sample_t& sample) {
  return sample.kind == HW_SAMPLE_PLANES ? static_cast<const hw_planes_t*>(sample.payload) : nullptr;
}

}  // namespace

WallSight::WallSight(const Source& source) : T_body_sensor_(pose_of(source.sensor().T_body_sensor)) {
  if (source.sensor().kind != HW_SAMPLE_POINTS || !source.true_walls() || !source.true_landmarks()) return;
  for (const log::Landmark& landmark : *source.true_landmarks()) {
    const Vec3 place = place_of(landmark.position_m);
    for (const log::TrueWall& wall : *source.true_walls()) {
      if (!landmark.moving && stands_on(place, wall)) wall_of_landmark_[landmark.id] = wall.id;
    }
  }
}

void WallSight::read(const FrameAnswer& answer) {
  given_.clear();
  places_.clear();
  if (answer.frame.is_of_planes) {
    read_planes(answer);
  } else {
    read_points(answer);
  }
}

void WallSight::read_planes(const FrameAnswer& answer) {
  std::optional<std::span<const std::uint64_t>> taken_for;
  if (answer.outputs != nullptr) taken_for = answer.outputs->associations(0);
  for (std::size_t i = 0; i < answer.frame.planes.size(); ++i) {
    const log::ObservedPlane& seen = answer.frame.planes[i];
    eval::GivenPlane& given = given_.emplace_back();
    given.wall = seen.wall;
    if (taken_for) given.taken_for = (*taken_for)[i];
    given.normal = T_body_sensor_.q * place_of(seen.plane.normal);
    given.middle = T_body_sensor_ * place_of(seen.plane.centroid_m);
    for (const auto& point : seen.hull_m) given.bounds.push_back(T_body_sensor_ * place_of(point));
    if (seen.hull_m.empty()) {
      for (const auto& corner : seen.plane.corners_m)
        given.bounds.push_back(T_body_sensor_ * place_of(corner));
    }
    for (const auto& point : seen.hull_m) places_.push_back({seen.wall, T_body_sensor_ * place_of(point)});
    if (!seen.hull_m.empty()) continue;
    for (const std::size_t corner : {0u, 1u})
      places_.push_back({seen.wall, T_body_sensor_ * place_of(seen.plane.corners_m[corner])});
  }
}

log::LandmarkId WallSight::wall_of(const log::Observation& seen) const {
  const auto found = wall_of_landmark_.find(seen.landmark);
  return found == wall_of_landmark_.end() ? log::kNoLandmark : found->second;
}

void WallSight::read_points(const FrameAnswer& answer) {
  for (const log::Observation& seen : answer.frame.observations) {
    const log::LandmarkId wall = wall_of(seen);
    if (wall != log::kNoLandmark) places_.push_back({wall, T_body_sensor_ * place_of(seen.point)});
  }
  if (answer.with_planes == nullptr) return;
  for (std::uint32_t k = 0; k < answer.with_planes->n_samples; ++k) {
    const hw_planes_t* planes = planes_in(*answer.with_planes->samples[k]);
    if (planes != nullptr && planes->sample == 0) add_found(answer, k);
  }
}

/// A plane that was found, in the body's frame.
eval::GivenPlane WallSight::placed(const hw_planes_t& planes, const hw_plane_t& plane) const {
  eval::GivenPlane given;
  given.normal = T_body_sensor_.q * Vec3(plane.normal);
  given.middle = T_body_sensor_ * Vec3(plane.centroid);
  const host::Strided<hw_point3_t> points(planes.hull_points, planes.n_hull_points, planes.hull_stride);
  for (std::uint64_t i = 0; i < plane.n_hull; ++i) {
    const hw_point3_t point = points[plane.first_hull + i];
    given.bounds.push_back(T_body_sensor_ * Vec3(point.x, point.y, point.z));
  }
  if (plane.n_hull == 0) {
    for (const auto& corner : plane.corners) given.bounds.push_back(T_body_sensor_ * Vec3(corner));
  }
  return given;
}

/// The planes that were found in the sensor's reading, which is sample 0.
void WallSight::add_found(const FrameAnswer& answer, std::uint32_t sample) {
  const hw_planes_t& planes = *planes_in(*answer.with_planes->samples[sample]);
  const auto taken_for = answer.outputs->associations(sample);
  for (std::uint64_t i = 0; i < planes.count; ++i) {
    const hw_plane_t& plane = *hw_plane_at(&planes, i);
    std::map<log::LandmarkId, std::uint64_t> votes;
    for (std::uint64_t m = 0; m < plane.n_members; ++m) {
      const std::uint32_t member = planes.members[plane.first_member + m];
      ++votes[wall_of(answer.frame.observations[member])];
    }
    const auto most = std::max_element(votes.begin(), votes.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    eval::GivenPlane& given = given_.emplace_back(placed(planes, plane));
    if (most != votes.end()) given.wall = most->first;
    if (taken_for) given.taken_for = (*taken_for)[i];
  }
}

}  // namespace hallway::run
