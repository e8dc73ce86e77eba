// SPDX-License-Identifier: MIT
#include "host/output/outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>

#include "base/text.hpp"
#include "base/unit_quaternion.hpp"
#include "host/load/plugin_info.hpp"
#include "host/output/output_kind.hpp"
#include "host/samples/sample_kind.hpp"
#include "host/samples/strided.hpp"

namespace hallway::host {
namespace {

constexpr std::size_t kMaxCounterName = 64;
constexpr double kLargestEpoch = 9007199254740992.0;  // 2^53: doubles count up to it

/// What is wrong with a pose, null if nothing.
const char* pose_problem(const hw_pose_t& pose) {
  if (!is_finite(pose.position)) return "a position that is not finite";
  if (!std::isfinite(quaternion_length(pose.orientation))) return "a quaternion that is not finite";
  if (!is_unit_quaternion(pose.orientation)) return "a quaternion that is not of unit length";
  return nullptr;
}

/// What is wrong with the covariance of a pose, null if nothing.
const char* covariance_problem(const std::array<double, 36>& numbers) {
  for (std::size_t i = 0; i < 36; ++i) {
    if (!std::isfinite(numbers[i])) return "a covariance that is not finite";
    if (numbers[i] != numbers[6 * (i % 6) + i / 6]) return "a covariance that is not symmetric";
  }
  for (std::size_t i = 0; i < 6; ++i) {
    if (numbers[7 * i] < 0) return "a negative variance";
  }
  return nullptr;
}

std::optional<std::uint64_t> whole_number(double value) {
  if (!(value >= 0.0 && value <= kLargestEpoch) || std::floor(value) != value) return std::nullopt;
  return static_cast<std::uint64_t>(value);
}

/// N of a counter that is called "map_epoch_N".
std::optional<std::uint64_t> joined_number(std::string_view name) {
  constexpr std::string_view kPrefix = HW_COUNTER_MAP_EPOCH "_";
  if (!name.starts_with(kPrefix)) return std::nullopt;
  const auto number = parse_int(name.substr(kPrefix.size()));
  if (!number || *number < 0) return std::nullopt;
  return static_cast<std::uint64_t>(*number);
}

template <typename Payload>
const Payload& payload_of(const hw_output_t& output) {
  return *static_cast<const Payload*>(output.payload);
}

}  // namespace

std::optional<std::span<const std::uint64_t>> Outputs::associations(std::uint32_t sample) const {
  const auto range = std::ranges::lower_bound(association_ranges_, sample, {}, &AssociationRange::sample);
  if (range == association_ranges_.end() || range->sample != sample) return std::nullopt;
  return std::span(association_ids_).subspan(range->first, range->count);
}

std::span<const std::uint64_t> Outputs::members(const hw_submap_t& submap) const {
  return std::span(submap_members_).subspan(submap.first_member, submap.n_members);
}

std::optional<std::uint64_t> Outputs::map_epoch() const {
  for (const Counter& counter : counters()) {
    if (counter.name == HW_COUNTER_MAP_EPOCH) return whole_number(counter.value);
  }
  return std::nullopt;
}

std::vector<JoinedEpoch> Outputs::joined_epochs() const {
  std::vector<JoinedEpoch> joined;
  for (const Counter& counter : counters()) {
    const auto epoch = joined_number(counter.name);
    const auto into = whole_number(counter.value);
    if (epoch && into) joined.push_back({*epoch, *into});
  }
  std::ranges::sort(joined, {}, &JoinedEpoch::epoch);
  return joined;
}

void OutputCollector::begin(const hw_frame_t* frame, std::span<const std::uint32_t> sample_indices) {
  frame_ = frame;
  sample_indices_ = sample_indices;
  fault_.clear();
  outputs_.pose_.reset();
  outputs_.drive_command_.reset();
  outputs_.landmarks_.clear();
  outputs_.landmark_covariances_.clear();
  outputs_.association_ranges_.clear();
  outputs_.association_ids_.clear();
  outputs_.planes_.clear();
  outputs_.plane_landmarks_.clear();
  outputs_.has_topology_ = false;
  outputs_.has_drawing_ = false;
  outputs_.submaps_.clear();
  outputs_.submap_members_.clear();
  outputs_.n_counters_ = 0;
  open_ = true;
}

hw_status_t OutputCollector::put(const hw_output_t* output) noexcept {
  try {
    if (!open_) return HW_ERROR_STATE;
    if (!fault_.empty()) return HW_ERROR_DATA;
    if (output == nullptr || !HW_HAS(output, hw_output_t, payload) || output->payload == nullptr) {
      return fault(HW_ERROR_ARGUMENT, "an output without a payload");
    }
    try {
      return copy(*output);
    } catch (const Malformed& malformed) {
      return fault(HW_ERROR_DATA, fmt::format("{}: {}", output_kind_name(output->kind), malformed.text));
    }
  } catch (const std::exception&) {
    return HW_ERROR_MEMORY;
  }
}

hw_status_t OutputCollector::copy(const hw_output_t& output) {
  switch (output.kind) {
    case HW_OUTPUT_POSE:
      return copy_pose(payload_of<hw_pose_output_t>(output));
    case HW_OUTPUT_DRIVE_COMMAND:
      return copy_drive_command(payload_of<hw_drive_command_t>(output));
    case HW_OUTPUT_LANDMARKS:
      return copy_landmarks(payload_of<hw_landmarks_t>(output));
    case HW_OUTPUT_ASSOCIATIONS:
      return copy_associations(payload_of<hw_associations_t>(output));
    case HW_OUTPUT_SUBMAPS:
      return copy_submaps(payload_of<hw_submaps_t>(output));
    case HW_OUTPUT_PLANES:
      return copy_planes(payload_of<hw_planes_t>(output));
    case HW_OUTPUT_MAPPED_PLANES:
      return copy_mapped_planes(payload_of<hw_mapped_planes_t>(output));
    case HW_OUTPUT_TOPOLOGY:
      return copy_topology(payload_of<hw_topology_t>(output));
    case HW_OUTPUT_DRAWING:
      return copy_drawing(payload_of<hw_drawing_t>(output));
    case HW_OUTPUT_COUNTERS:
      return copy_counters(payload_of<hw_counters_t>(output));
    default:
      return HW_OK;
  }
}

hw_status_t OutputCollector::copy_pose(const hw_pose_output_t& pose) {
  demand(HW_HAS(&pose, hw_pose_output_t, T_map_body), "a payload that is too small");
  demand(!outputs_.pose_, "a second one in one call");
  PoseOutput copy;
  copy.T_map_body.orientation[0] = 1.0;
  if (pose.status == HW_POSE_VALID) {
    if (const char* problem = pose_problem(pose.T_map_body)) throw Malformed{problem};
    copy = {.valid = true, .T_map_body = pose.T_map_body, .t_ns = hw_pose_time_ns(&pose)};
    demand(copy.t_ns >= 0, "a time below 0");
    demand(copy.t_ns == 0 || (frame_ != nullptr && copy.t_ns <= frame_->t_ns),
           frame_ == nullptr ? "a time, and this call has no frame" : "a time after the frame's");
    if (HW_HAS(&pose, hw_pose_output_t, covariance) && pose.covariance != nullptr) {
      std::ranges::copy_n(pose.covariance, 36, copy.covariance.emplace().begin());
      if (const char* problem = covariance_problem(*copy.covariance)) throw Malformed{problem};
    }
  } else {
    demand(pose.status == HW_POSE_LOST, "an unknown status");
  }
  outputs_.pose_ = copy;
  return HW_OK;
}

hw_status_t OutputCollector::copy_drive_command(const hw_drive_command_t& command) {
  demand(HW_HAS(&command, hw_drive_command_t, angular_rad_s), "a payload that is too small");
  demand(frame_ != nullptr, "it answers a frame, and this call has none");
  demand(!outputs_.drive_command_, "a second one in one call");
  const DriveCommand copy{command.linear_m_s, command.angular_rad_s, hw_lateral_m_s(&command)};
  demand(
      std::isfinite(copy.linear_m_s) && std::isfinite(copy.angular_rad_s) && std::isfinite(copy.lateral_m_s),
      "a speed that is not finite");
  outputs_.drive_command_ = copy;
  return HW_OK;
}

hw_status_t OutputCollector::copy_landmarks(const hw_landmarks_t& landmarks) {
  demand(HW_HAS(&landmarks, hw_landmarks_t, landmarks), "a payload that is too small");
  const Strided<hw_landmark_t> list(landmarks.landmarks, landmarks.count, landmarks.stride);
  demand(outputs_.landmarks_.size() + list.size() <= kMaxElements, "too many in one call");
  outputs_.landmarks_.reserve(outputs_.landmarks_.size() + list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const hw_landmark_t landmark = list[i];
    demand(landmark.id != HW_NO_LANDMARK, "the id HW_NO_LANDMARK");
    if (!is_finite(landmark.position)) {
      throw Malformed{fmt::format("landmark {} has a position that is not finite", landmark.id)};
    }
    if (landmark.status > HW_LANDMARK_DYNAMIC) {
      throw Malformed{fmt::format("landmark {} has the unknown status {}", landmark.id, landmark.status)};
    }
    outputs_.landmarks_.push_back(landmark);
  }
  const bool told = HW_HAS(&landmarks, hw_landmarks_t, covariances) && landmarks.covariances != nullptr;
  copy_landmark_covariances(told ? landmarks.covariances : nullptr, outputs_.landmarks_.size() - list.size());
  return HW_OK;
}

/// Takes the covariances of landmarks `first` and on; those of lists without any are zeros beside others that have them.
void OutputCollector::copy_landmark_covariances(const double* covariances, std::size_t first) {
  std::vector<LandmarkCovariance>& all = outputs_.landmark_covariances_;
  if (covariances == nullptr && all.empty()) return;
  all.resize(outputs_.landmarks_.size());
  for (std::size_t i = first; covariances != nullptr && i < all.size(); ++i) {
    LandmarkCovariance& copy = all[i];
    std::ranges::copy_n(covariances + 6 * (i - first), 6, copy.begin());
    const bool finite = std::ranges::all_of(copy, [](double x) { return std::isfinite(x); });
    if (!finite || copy[0] < 0 || copy[3] < 0 || copy[5] < 0) {
      throw Malformed{fmt::format("landmark {} has a covariance that is none", outputs_.landmarks_[i].id)};
    }
  }
}

std::uint64_t OutputCollector::elements_of(std::uint32_t sample) const {
  demand(frame_ != nullptr, "they belong to a frame, and this call has none");
  if (sample >= frame_->n_samples)
    throw Malformed{fmt::format("sample {} of a frame of {}", sample, frame_->n_samples)};
  const auto elements = count_elements(*frame_->samples[sample]);
  demand(elements.has_value(), "for a sample that has no elements");
  return *elements;
}

hw_status_t OutputCollector::copy_associations(const hw_associations_t& associations) {
  demand(HW_HAS(&associations, hw_associations_t, landmark_ids), "a payload that is too small");
  const std::uint64_t expected = elements_of(associations.sample);
  if (associations.count != expected) {
    throw Malformed{fmt::format("{} for a sample of {} points", associations.count, expected)};
  }
  const std::uint32_t index = sample_indices_[associations.sample];
  demand(!outputs_.associations(index), "a second time for one sample");
  const Strided<std::uint64_t> ids(associations.landmark_ids, associations.count, sizeof(std::uint64_t));
  const std::size_t first = outputs_.association_ids_.size();
  ids.append_to(outputs_.association_ids_);
  auto& ranges = outputs_.association_ranges_;
  ranges.insert(std::ranges::upper_bound(ranges, index, {}, &Outputs::AssociationRange::sample),
                {index, first, ids.size()});
  return HW_OK;
}

hw_status_t OutputCollector::copy_planes(const hw_planes_t& planes) {
  demand(HW_HAS(&planes, hw_planes_t, members), "a payload that is too small");
  const std::uint64_t elements = elements_of(planes.sample);
  outputs_.planes_.add(planes, sample_indices_[planes.sample], elements);
  return HW_OK;
}

hw_status_t OutputCollector::copy_mapped_planes(const hw_mapped_planes_t& planes) {
  demand(HW_HAS(&planes, hw_mapped_planes_t, corners), "a payload that is too small");
  outputs_.plane_landmarks_.add(planes);
  return HW_OK;
}

hw_status_t OutputCollector::copy_topology(const hw_topology_t& topology) {
  demand(HW_HAS(&topology, hw_topology_t, note), "a payload that is too small");
  demand(!outputs_.has_topology_, "a second one in one call");
  outputs_.topology_.set(topology, frame_);
  outputs_.has_topology_ = true;
  return HW_OK;
}

hw_status_t OutputCollector::copy_drawing(const hw_drawing_t& drawing) {
  demand(HW_HAS(&drawing, hw_drawing_t, points), "a payload that is too small");
  demand(frame_ != nullptr, "it belongs to a frame, and this call has none");
  demand(!outputs_.has_drawing_, "a second one in one call");
  outputs_.drawing_.set(drawing);
  outputs_.has_drawing_ = true;
  return HW_OK;
}

hw_status_t OutputCollector::copy_submaps(const hw_submaps_t& submaps) {
  demand(HW_HAS(&submaps, hw_submaps_t, members), "a payload that is too small");
  const Strided<hw_submap_t> list(submaps.submaps, submaps.count, submaps.stride);
  const Strided<std::uint64_t> members(submaps.members, submaps.n_members, sizeof(std::uint64_t));
  const std::size_t first_member = outputs_.submap_members_.size();
  for (std::size_t i = 0; i < list.size(); ++i) {
    hw_submap_t submap = list[i];
    if (const char* problem = pose_problem(submap.T_map_submap)) {
      throw Malformed{fmt::format("submap {} has {}", submap.id, problem)};
    }
    if (!lies_within(submap.first_member, submap.n_members, members.size())) {
      throw Malformed{fmt::format("submap {} has members beyond the list of members", submap.id)};
    }
    submap.first_member += first_member;
    outputs_.submaps_.push_back(submap);
  }
  members.append_to(outputs_.submap_members_);
  return HW_OK;
}

hw_status_t OutputCollector::copy_counters(const hw_counters_t& counters) {
  demand(HW_HAS(&counters, hw_counters_t, counters), "a payload that is too small");
  const Strided<hw_counter_t> list(counters.counters, counters.count, counters.stride);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const hw_counter_t counter = list[i];
    demand(counter.name != nullptr, "a name that is null");
    const std::size_t length = strnlen(counter.name, kMaxCounterName + 1);
    const bool plain = std::all_of(counter.name, counter.name + length, [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
    });
    demand(length >= 1 && length <= kMaxCounterName && plain,
           "a name that is not 1 to 64 letters a-z, digits and _");
    if (!std::isfinite(counter.value)) throw Malformed{fmt::format("{} is not finite", counter.name)};
    if (outputs_.n_counters_ == outputs_.counters_.size()) outputs_.counters_.emplace_back();
    Counter& copy = outputs_.counters_[outputs_.n_counters_++];
    copy.name.assign(counter.name, length);
    copy.value = counter.value;
  }
  return HW_OK;
}

hw_status_t OutputCollector::fault(hw_status_t status, std::string text) {
  fault_ = std::move(text);
  return status;
}

std::string OutputCollector::finish() {
  open_ = false;
  if (fault_.empty()) check_distinct_ids();
  return fault_;
}

void OutputCollector::check_distinct_ids() {
  const std::span<const hw_mapped_plane_t> planes = outputs_.plane_landmarks_.planes();
  sorted_ids_.clear();
  for (const hw_landmark_t& landmark : outputs_.landmarks_) sorted_ids_.push_back(landmark.id);
  for (const hw_mapped_plane_t& plane : planes) sorted_ids_.push_back(plane.id);
  std::ranges::sort(sorted_ids_);
  const auto twice = std::ranges::adjacent_find(sorted_ids_);
  if (twice == sorted_ids_.end()) return;
  fault_ = fmt::format("{}: two of them have the id {}",
                       planes.empty() ? "landmarks" : "landmarks and mapped_planes", *twice);
}

}  // namespace hallway::host
