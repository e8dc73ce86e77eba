// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/output.h>
#include <hallway/sample.h>
#include <hallway/status.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/output/drawing.hpp"
#include "host/output/plane_landmark_list.hpp"
#include "host/output/topology.hpp"
#include "host/samples/plane_lists.hpp"

namespace hallway::host {

/// The pose that a plugin put.
struct PoseOutput {
  bool valid = false;      ///< false: the plugin says that it is lost, T_map_body is the identity
  hw_pose_t T_map_body{};  ///< finite, unit quaternion
  /// As hw_pose_output_t says; finite, symmetric, no negative variance. Nothing if not told or lost.
  std::optional<std::array<double, 36>> covariance{};
  /// The time that it is of, not later than the frame's; 0: the frame's, or lost.
  std::int64_t t_ns = 0;
};

/// xx, xy, xz, yy, yz, zz; six zeros where nothing is known.
using LandmarkCovariance = std::array<double, 6>;

/// The drive command that a plugin put; finite.
struct DriveCommand {
  double linear_m_s = 0;     ///< along the body's x axis
  double angular_rad_s = 0;  ///< about the body's z axis
  double lateral_m_s = 0;    ///< along the body's y axis

  friend bool operator==(const DriveCommand&, const DriveCommand&) = default;
};

/// A counter that a plugin put.
struct Counter {
  std::string name;
  double value = 0;
};

/// Poses answered under one number of the map's parts belong to another part; see HW_COUNTER_MAP_EPOCH.
struct JoinedEpoch {
  std::uint64_t epoch = 0;
  std::uint64_t into = 0;

  friend bool operator==(const JoinedEpoch&, const JoinedEpoch&) = default;
};

/// What one call of a plugin put, checked and copied into buffers that are used again for the next call.
class Outputs {
 public:
  /// The pose, if one was put.
  const std::optional<PoseOutput>& pose() const { return pose_; }
  /// The drive command, if one was put.
  const std::optional<DriveCommand>& drive_command() const { return drive_command_; }
  /// The landmarks, ids distinct, in the order put.
  std::span<const hw_landmark_t> landmarks() const { return landmarks_; }
  /// For each of landmarks() the covariance of its position as hw_landmarks_t says; empty if none were put.
  std::span<const LandmarkCovariance> landmark_covariances() const { return landmark_covariances_; }
  /// Per element of that sample of the frame, the landmark it was taken for, or HW_NO_LANDMARK; nothing if
  /// not put.
  std::optional<std::span<const std::uint64_t>> associations(std::uint32_t sample) const;
  /// The planes found in that sample of the frame; nothing if not put.
  std::optional<PlaneList> planes(std::uint32_t sample) const { return planes_.of(sample); }
  /// The planes of the map, ids distinct from each other's and from the landmarks'.
  const PlaneLandmarkList& plane_landmarks() const { return plane_landmarks_; }
  /// The topological map, null if none was put.
  const Topology* topology() const { return has_topology_ ? &topology_ : nullptr; }
  /// What the plugin shows at this frame, null if it put nothing.
  const Drawing* drawing() const { return has_drawing_ ? &drawing_ : nullptr; }
  /// The submaps, in the order put.
  std::span<const hw_submap_t> submaps() const { return submaps_; }
  /// The landmarks of a submap of this object.
  std::span<const std::uint64_t> members(const hw_submap_t& submap) const;
  /// The landmarks of all submaps, as first_member counts them.
  std::span<const std::uint64_t> all_members() const { return submap_members_; }
  /// The counters, in the order put.
  std::span<const Counter> counters() const { return std::span(counters_).first(n_counters_); }
  /// Of process(): which connected part of the map the pose is in (HW_COUNTER_MAP_EPOCH); nothing if it was not put, or is no whole number from 0
  /// to 2^53. O(counters).
  std::optional<std::uint64_t> map_epoch() const;
  /// Of report(): which parts were joined to others, ascending. What is no such counter is left out. O(n log n) of the counters.
  std::vector<JoinedEpoch> joined_epochs() const;

 private:
  friend class OutputCollector;
  struct AssociationRange {
    std::uint32_t sample;
    std::size_t first, count;
  };

  std::optional<PoseOutput> pose_;
  std::optional<DriveCommand> drive_command_;
  std::vector<hw_landmark_t> landmarks_;
  std::vector<LandmarkCovariance> landmark_covariances_;
  std::vector<AssociationRange> association_ranges_;  ///< by sample
  std::vector<std::uint64_t> association_ids_;
  PlaneLists planes_;
  PlaneLandmarkList plane_landmarks_;
  Topology topology_;
  bool has_topology_ = false;
  Drawing drawing_;
  bool has_drawing_ = false;
  std::vector<hw_submap_t> submaps_;
  std::vector<std::uint64_t> submap_members_;
  std::vector<Counter> counters_;  ///< the first n_counters_ count; the others keep their memory
  std::size_t n_counters_ = 0;
};

/// Receives the outputs of one call and checks them. The first output that is not as output.h says is the
/// call's fault, however the call itself ends.
class OutputCollector {
 public:
  /// Begins a call: forgets what was there. `frame` is null in report(); it must live until finish().
  /// `sample_indices` gives for each sample of `frame` the index under which Outputs shall know it.
  void begin(const hw_frame_t* frame, std::span<const std::uint32_t> sample_indices);
  /// Takes one output. Never throws: HW_OK also for kinds that are not known, else what the plugin shall
  /// return.
  hw_status_t put(const hw_output_t* output) noexcept;
  /// Ends a call. @return what was wrong with its outputs, empty if nothing
  std::string finish();

  const Outputs& outputs() const { return outputs_; }

 private:
  hw_status_t copy(const hw_output_t& output);
  hw_status_t copy_pose(const hw_pose_output_t& pose);
  hw_status_t copy_drive_command(const hw_drive_command_t& command);
  hw_status_t copy_landmarks(const hw_landmarks_t& landmarks);
  void copy_landmark_covariances(const double* covariances, std::size_t first);
  hw_status_t copy_associations(const hw_associations_t& associations);
  hw_status_t copy_planes(const hw_planes_t& planes);
  hw_status_t copy_mapped_planes(const hw_mapped_planes_t& planes);
  hw_status_t copy_topology(const hw_topology_t& topology);
  hw_status_t copy_drawing(const hw_drawing_t& drawing);
  hw_status_t copy_submaps(const hw_submaps_t& submaps);
  hw_status_t copy_counters(const hw_counters_t& counters);
  hw_status_t fault(hw_status_t status, std::string text);
  /// The number of elements of a sample that an output is about. Throws Malformed where there is no such sample.
  std::uint64_t elements_of(std::uint32_t sample) const;
  /// Among landmarks and mapped planes, which have one numbering.
  void check_distinct_ids();

  Outputs outputs_;
  const hw_frame_t* frame_ = nullptr;
  std::span<const std::uint32_t> sample_indices_;
  bool open_ = false;
  std::string fault_;
  std::vector<std::uint64_t> sorted_ids_;
};

}  // namespace hallway::host
