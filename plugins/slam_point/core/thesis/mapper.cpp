// SPDX-License-Identifier: MIT
#include "slam_point/core/thesis/mapper.hpp"

#include <algorithm>

#include "slam_point/core/frame/frame_intake.hpp"

namespace hallway::slam_point::thesis {
namespace {

constexpr double kBasisNoises =
    5.0;  // distance of the third basis point from the line through the others, at least
constexpr double kLeastAgreeingShare = 0.4;  // of the points that can be compared with the map

const slam_point::Options& checked_common(const slam_point::Options& common, const Options& options) {
  common.validate();
  options.validate();
  return common;
}

Tracks make_tracks(const slam_point::Options& common, const Options& options) {
  return Tracks(Grouping::kept_iterations(options), std::max(common.map_bound(), common.separation()),
                static_cast<IndexKind>(common.index));
}

}  // namespace

Mapper::Mapper(const slam_point::Options& common, const Options& options)
    : common_(checked_common(common, options)),
      options_(options),
      tracks_(make_tracks(common, options)),
      matcher_(common, options),
      grouping_(options, kBasisNoises * common.noise_m) {}

const Answer& Mapper::process(std::span<const Vec3> points) {
  place(points);
  return answer();
}

void Mapper::place(std::span<const Vec3> points) {
  take_points(points);
  if (!started_) {
    has_pose_ = can_start();
    if (has_pose_) start();
    return;
  }
  const Pose before = T_map_sensor_;
  matcher_.match_recent(tracks_, iteration_ + 1, moved_, frame_.observations);
  fit();
  matcher_.match_map(tracks_, T_map_sensor_, frame_.observations);
  has_pose_ = fit() && is_placed();
  if (!has_pose_) {
    T_map_sensor_ = before;
    for (Observation& observation : frame_.observations) observation.landmark = kNone;
    has_pose_ = start_over();
    return;
  }
  ++iteration_;
  chart();
  grouping_.compute(tracks_);
  grouping_.create(tracks_);
  merge_new();
  fit();  // the map has moved
  moved_ = before.inverse() * T_map_sensor_;
  last_comparable_ = pairs_.size();
}

void Mapper::take_points(std::span<const Vec3> points) {
  frame_.observations.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!FrameIntake::is_usable(points[i])) continue;
    if (points[i].z() != 0.0) frame_.planar = false;
    frame_.observations.push_back({points[i], i});
  }
  answer_.associations.assign(points.size(), kNoLandmark);
  ++answer_.counters.iterations;
}

bool Mapper::can_start() const {
  Alignment own(Pose{});
  for (const Observation& observation : frame_.observations)
    own.add(observation.point, observation.point, 1.0);
  Pose unused;
  return own.pairs() >= rules().least_pairs() && own.solve(rules(), unused);
}

void Mapper::start() {
  started_ = true;
  iteration_ = 0;
  T_map_sensor_ = Pose{};
  moved_ = Pose{};
  chart();
  last_comparable_ = frame_.observations.size();
}

bool Mapper::start_over() {
  // A map of one frame that the next frames do not find again is a false start: it knows nothing to keep.
  if (iteration_ > 0 || !can_start()) return false;
  first_id_ += tracks_.size();
  ++answer_.epoch;
  tracks_ = make_tracks(common_, options_);
  grouping_ = Grouping(options_, kBasisNoises * common_.noise_m);
  matcher_ = Matcher(common_, options_);
  to_compare_.clear();
  start();
  return true;
}

bool Mapper::fit() {
  pairs_.clear();
  for (const Observation& observation : frame_.observations) {
    if (observation.landmark == kNone || !tracks_[observation.landmark].is_mapped()) continue;
    pairs_.push_back({tracks_[observation.landmark].position, observation.point, 1.0});
  }
  return robust_fit(pairs_, rules(), T_map_sensor_);
}

bool Mapper::is_placed() const {
  const double bound2 = common_.map_bound() * common_.map_bound();
  std::size_t agreeing = 0;
  for (const Pair& pair : pairs_) {
    if ((T_map_sensor_ * pair.point - pair.reference).squaredNorm() <= bound2) ++agreeing;
  }
  const std::size_t comparable = std::min(frame_.observations.size(), last_comparable_);
  return agreeing >= rules().least_pairs() &&
         static_cast<double>(agreeing) >= kLeastAgreeingShare * static_cast<double>(comparable);
}

void Mapper::chart() {
  tracks_.begin_iteration(iteration_, frame_.planar);
  for (Observation& observation : frame_.observations) {
    if (observation.landmark == kNone) {
      observation.landmark = tracks_.add(T_map_sensor_ * observation.point);
      grouping_.add(observation.landmark);
      if (options_.merge_after > 0 && iteration_ > 0) to_compare_.push_back(observation.landmark);
    }
    tracks_.see(observation.landmark, observation.point);
  }
}

void Mapper::merge_new() {
  const auto age = static_cast<Iteration>(options_.merge_after);
  while (!to_compare_.empty() && tracks_[to_compare_.front()].first + age <= iteration_) {
    const Index from = to_compare_.front();
    to_compare_.pop_front();
    if (tracks_[from].merged_into != kNone || !tracks_[from].is_mapped()) continue;
    const Index into = find_duplicate(from);
    if (into == kNone || !grouping_.can_merge(tracks_, from)) continue;
    grouping_.merge(tracks_, into, from);
    ++answer_.counters.merged;
    for (Observation& observation : frame_.observations) {
      if (observation.landmark == from) observation.landmark = into;
    }
  }
}

Index Mapper::find_duplicate(Index track) const {
  const Vec3& place = tracks_[track].position;
  double nearest2 = common_.separation() * common_.separation();
  Index duplicate = kNone;
  tracks_.visit_near(place, [&](Index other) {
    const double d2 = (tracks_[other].position - place).squaredNorm();
    if (other >= track || !tracks_[other].is_mapped() || d2 > nearest2) return;
    if (d2 == nearest2 && other > duplicate) return;
    // Seen together, they are two.
    const auto given = tracks_[track].history.between(0, iteration_);
    const bool together = std::any_of(given.begin(), given.end(), [&](const Sighting& sighting) {
      return tracks_[other].history.find(sighting.iteration) != nullptr;
    });
    if (together) return;
    nearest2 = d2;
    duplicate = other;
  });
  return duplicate;
}

const Answer& Mapper::answer() {
  answer_.has_pose = has_pose_;
  if (has_pose_) {
    answer_.T_map_sensor = without_negative_zeros(T_map_sensor_);
  } else {
    ++answer_.counters.lost;
  }
  for (const Observation& observation : frame_.observations) {
    if (observation.landmark != kNone)
      answer_.associations[observation.given] = first_id_ + observation.landmark;
  }
  answer_.counters.landmarks = tracks_.size() - answer_.counters.merged;
  answer_.counters.submaps = grouping_.standing();
  answer_.counters.closes = grouping_.made();
  return answer_;
}

Map Mapper::map() const {
  Map map;
  for (Index t = 0; t < tracks_.size(); ++t) {
    const Track& track = tracks_[t];
    if (track.merged_into != kNone) continue;
    Landmark landmark;
    landmark.id = first_id_ + t;
    landmark.position = track.position;
    landmark.observations = track.observations;
    const bool enough = track.observations >= static_cast<std::uint32_t>(common_.min_observations);
    if (enough && track.level >= std::min(options_.levels, 2)) landmark.status = LandmarkStatus::mapped;
    map.landmarks.push_back(landmark);
  }
  grouping_.visit([&](Index g, const Group& group) {
    Submap submap;
    submap.id = g;
    submap.T_map_submap = group.T_map_group();
    for (const Index track : group.points()) submap.members.push_back(first_id_ + track);
    map.submaps.push_back(std::move(submap));
  });
  return map;
}

}  // namespace hallway::slam_point::thesis
