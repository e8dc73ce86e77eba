// SPDX-License-Identifier: MIT
#include "run/plane_truth.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "geom/arrays.hpp"
#include "record/plane_observations.hpp"
#include "run/abi_pose.hpp"

namespace hallway::run {
namespace {

/// Points stand a little off the faces that they are on.
constexpr double kOnPlane_m = 0.005;

bool is_on(const Vec3& point, const log::TruePlane& plane) {
  const Vec3 corner = to_vec3(plane.corners_m[0]);
  const Vec3 along = to_vec3(plane.corners_m[1]) - corner, up = to_vec3(plane.corners_m[3]) - corner;
  const Vec3 normal = along.cross(up).normalized();
  const Vec3 from = point - corner;
  const double u = along.dot(from) / along.squaredNorm(), v = up.dot(from) / up.squaredNorm();
  return std::abs(normal.dot(from)) <= kOnPlane_m && u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0;
}

const hw_planes_t* planes_in(const hw_sample_t& sample) {
  return sample.kind == HW_SAMPLE_PLANES ? static_cast<const hw_planes_t*>(sample.payload) : nullptr;
}

}  // namespace

PlaneTruth::PlaneTruth(const Source& source) : T_body_sensor_(pose_of(source.sensor().T_body_sensor)) {
  if (source.sensor().kind != HW_SAMPLE_POINTS || !source.true_planes() || !source.true_landmarks()) return;
  for (const log::Landmark& landmark : *source.true_landmarks()) {
    const Vec3 place = to_vec3(landmark.position_m);
    for (const log::TruePlane& plane : *source.true_planes()) {
      if (!landmark.moving && is_on(place, plane)) true_plane_of_landmark_[landmark.id] = plane.id;
    }
  }
}

void PlaneTruth::read(const FrameAnswer& answer) {
  planes_.clear();
  points_.clear();
  if (answer.frame.is_of_planes) {
    read_planes(answer);
  } else {
    read_points(answer);
  }
}

/// Adds an observation, in the body's frame.
eval::AssociatedPlane& PlaneTruth::add_plane(const log::PlaneObservation& seen) {
  eval::AssociatedPlane& plane = planes_.emplace_back();
  plane.normal = T_body_sensor_.q * to_vec3(seen.normal);
  plane.centroid = T_body_sensor_ * to_vec3(seen.centroid_m);
  for (const auto& corner : seen.outline()) plane.bounds.push_back(T_body_sensor_ * to_vec3(corner));
  return plane;
}

void PlaneTruth::read_planes(const FrameAnswer& answer) {
  std::optional<std::span<const std::uint64_t>> landmarks;
  if (answer.outputs != nullptr) landmarks = answer.outputs->associations(0);
  for (std::size_t i = 0; i < answer.frame.planes.size(); ++i) {
    const log::PlaneObservation& seen = answer.frame.planes[i];
    eval::AssociatedPlane& plane = add_plane(seen);
    plane.true_plane = seen.true_plane;
    if (landmarks) plane.landmark = (*landmarks)[i];
    // The lower edge of a rectangle shows how much of its plane was seen.
    const std::size_t n = seen.hull_m.empty() ? 2 : plane.bounds.size();
    for (std::size_t k = 0; k < n; ++k) points_.push_back({seen.true_plane, plane.bounds[k]});
  }
}

log::LandmarkId PlaneTruth::true_plane_of(const log::Observation& seen) const {
  const auto found = true_plane_of_landmark_.find(seen.landmark);
  return found == true_plane_of_landmark_.end() ? log::kNoLandmark : found->second;
}

void PlaneTruth::read_points(const FrameAnswer& answer) {
  for (const log::Observation& seen : answer.frame.observations) {
    const log::LandmarkId plane = true_plane_of(seen);
    if (plane != log::kNoLandmark) points_.push_back({plane, T_body_sensor_ * to_vec3(seen.point)});
  }
  if (answer.with_planes == nullptr) return;
  for (std::uint32_t k = 0; k < answer.with_planes->n_samples; ++k) {
    const hw_planes_t* planes = planes_in(*answer.with_planes->samples[k]);
    if (planes != nullptr && planes->sample == 0) add_found(answer, k);
  }
}

/// The planes that were found in the sensor's reading, which is sample 0.
void PlaneTruth::add_found(const FrameAnswer& answer, std::uint32_t sample) {
  const hw_planes_t& planes = *planes_in(*answer.with_planes->samples[sample]);
  const auto landmarks = answer.outputs->associations(sample);
  for (std::uint64_t i = 0; i < planes.count; ++i) {
    const hw_plane_t& found = *hw_plane_at(&planes, i);
    std::map<log::LandmarkId, std::uint64_t> votes;
    for (std::uint64_t m = 0; m < found.n_members; ++m) {
      const std::uint32_t member = planes.members[found.first_member + m];
      ++votes[true_plane_of(answer.frame.observations[member])];
    }
    const auto most = std::max_element(votes.begin(), votes.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    eval::AssociatedPlane& plane = add_plane(record::plane_observation(planes, i));
    if (most != votes.end()) plane.true_plane = most->first;
    if (landmarks) plane.landmark = (*landmarks)[i];
  }
}

}  // namespace hallway::run
