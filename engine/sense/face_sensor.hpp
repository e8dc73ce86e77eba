// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include "base/random.hpp"
#include "sense/face_plan.hpp"
#include "sense/face_view.hpp"
#include "sense/plane_sensor.hpp"

namespace hallway::sense {

/// Sees whole faces of the world, walls, floors, ceilings and slopes, as planes with polygonal outlines, from any pose: what is within the
/// view and not hidden by something nearer, from the empty side.
///
/// Noise is drawn for each face and frame: the face is moved along its normal and tilted about two axes through the middle of what is
/// seen of it, each end of each edge of its outline is moved across the edge in the face; what these edges bound is given. What is seen never depends on noise, but a face that its noise
/// would leave without an outline, or carry to the other side of the sensor, is not given. Order is random, as PlaneSensor's.
class FaceSensor {
 public:
  /// Keeps a reference to `plan`, which must outlive the sensor. Throws Error{kBadInput} as PlaneSensor does, and for an angle of view of 180 degrees
  /// or more, or ranges that are distances (`bounded_sides`).
  FaceSensor(PlaneSensorSpec spec, const FacePlan& plan, std::uint64_t seed);

  /// Replaces `out` by what is seen in a step; PlaneObservation::true_plane is an index in FacePlan::faces. Of what is
  /// seen, `detection.dropout` is lost; clutter is what false_face() makes.
  ///
  /// @param T_world_body  the robot's true pose; throws as check_pose() does
  void observe(const Pose& T_world_body, std::uint32_t step, std::vector<PlaneObservation>& out) const;

  /// Throws Error{kBadInput} if the sensor would be farther from the origin than trace::Scene::kMaxRayCoordinate.
  void check_pose(const Pose& T_world_body, std::uint32_t step) const;

  const PlaneSensorSpec& spec() const { return spec_; }

 private:
  /// An observation with its place in the random order, and what decides between equal places.
  using Placed = std::tuple<std::uint64_t, std::uint32_t, PlaneObservation>;

  void add_clutter(std::uint32_t step, std::vector<Placed>& all) const;
  std::optional<PlaneObservation> make_seen(const VisibleFace& piece, std::uint32_t step) const;

  PlaneSensorSpec spec_;
  FaceView view_;
  Detection detection_;
  Random noise_;
  Random order_;
};

}  // namespace hallway::sense
