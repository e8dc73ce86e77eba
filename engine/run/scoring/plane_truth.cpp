// SPDX-License-Identifier: MIT
#include "run/scoring/plane_truth.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "geom/arrays.hpp"
#include "record/plane_observations.hpp"

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

PlaneTruth::PlaneTruth(const Source& source) : sensor_poses_(source.sensors()) {
  if (!source.gives(HW_SAMPLE_POINTS) || !source.true_planes() || !source.true_landmarks()) return;
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
  for (std::uint32_t k = 0; k < answer.frame.n_samples(); ++k) {
    if (answer.frame.sample(k).kind == HW_SAMPLE_PLANES) read_planes(answer, k);
    if (answer.frame.sample(k).kind == HW_SAMPLE_POINTS) read_points(answer, k);
  }
}

/// Adds an observation, in the body's frame.
eval::AssociatedPlane& PlaneTruth::add_plane(const log::PlaneObservation& seen, const Pose& T_body_sensor) {
  eval::AssociatedPlane& plane = planes_.emplace_back();
  plane.normal = T_body_sensor.q * to_vec3(seen.normal);
  plane.centroid = T_body_sensor * to_vec3(seen.centroid_m);
  for (const auto& corner : seen.outline()) plane.bounds.push_back(T_body_sensor * to_vec3(corner));
  return plane;
}

/// The planes that a sensor gave.
void PlaneTruth::read_planes(const FrameAnswer& answer, std::uint32_t sample) {
  const hw_planes_t& planes = *planes_in(answer.frame.sample(sample));
  const auto identities = answer.frame.identities_of(sample);
  std::optional<std::span<const std::uint64_t>> landmarks;
  if (answer.outputs != nullptr) landmarks = answer.outputs->associations(sample);
  for (std::uint64_t i = 0; i < planes.count; ++i) {
    const log::PlaneObservation seen = record::plane_observation(planes, i);
    const log::LandmarkId true_plane = identities.empty() ? log::kNoLandmark : identities[i];
    eval::AssociatedPlane& plane = add_plane(seen, sensor_poses_.of(answer.frame.sample(sample).sensor_id));
    plane.true_plane = true_plane;
    if (landmarks) plane.landmark = (*landmarks)[i];
    // The lower edge of a rectangle shows how much of its plane was seen.
    const std::size_t n = seen.hull_m.empty() ? 2 : plane.bounds.size();
    for (std::size_t k = 0; k < n; ++k) points_.push_back({true_plane, plane.bounds[k]});
  }
}

log::LandmarkId PlaneTruth::true_plane_of(log::LandmarkId landmark) const {
  const auto found = true_plane_of_landmark_.find(landmark);
  return found == true_plane_of_landmark_.end() ? log::kNoLandmark : found->second;
}

/// The points that a sensor gave, and the planes that were found in them.
void PlaneTruth::read_points(const FrameAnswer& answer, std::uint32_t sample) {
  const hw_sample_t& seen = answer.frame.sample(sample);
  const auto& points = *static_cast<const hw_points_t*>(seen.payload);
  const auto identities = answer.frame.identities_of(sample);
  for (std::size_t i = 0; i < identities.size(); ++i) {
    const log::LandmarkId plane = true_plane_of(identities[i]);
    if (plane == log::kNoLandmark) continue;
    const hw_point3_t& point = *hw_point_at(&points, i);
    points_.push_back({plane, sensor_poses_.of(seen.sensor_id) * Vec3(point.x, point.y, point.z)});
  }
  if (answer.with_planes == nullptr) return;
  for (std::uint32_t k = answer.frame.n_samples(); k < answer.with_planes->n_samples; ++k) {
    const hw_planes_t* planes = planes_in(*answer.with_planes->samples[k]);
    if (planes != nullptr && planes->sample == sample) add_found(answer, k);
  }
}

/// The planes that were found in a sensor's reading.
void PlaneTruth::add_found(const FrameAnswer& answer, std::uint32_t sample) {
  const hw_sample_t& added = *answer.with_planes->samples[sample];
  const hw_planes_t& planes = *planes_in(added);
  const auto identities = answer.frame.identities_of(planes.sample);
  const auto landmarks = answer.outputs->associations(sample);
  for (std::uint64_t i = 0; i < planes.count; ++i) {
    const hw_plane_t& found = *hw_plane_at(&planes, i);
    std::map<log::LandmarkId, std::uint64_t> votes;
    for (std::uint64_t m = 0; m < found.n_members; ++m) {
      const std::uint32_t member = planes.members[found.first_member + m];
      ++votes[true_plane_of(identities.empty() ? log::kNoLandmark : identities[member])];
    }
    const auto most = std::max_element(votes.begin(), votes.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    eval::AssociatedPlane& plane =
        add_plane(record::plane_observation(planes, i), sensor_poses_.of(added.sensor_id));
    if (most != votes.end()) plane.true_plane = most->first;
    if (landmarks) plane.landmark = (*landmarks)[i];
  }
}

}  // namespace hallway::run
