// SPDX-License-Identifier: MIT
#include "slam_point/core/submaps/submap_sequence.hpp"

#include <algorithm>

namespace hallway::slam_point {

SubmapSequence::SubmapSequence(const Options& options, SubmapGraph& graph, FrameMatcher& matcher)
    : options_(options),
      graph_(graph),
      matcher_(matcher),
      active_(graph, std::max(options.match_bound(), options.agreement()),
              static_cast<IndexKind>(options.index)),
      segments_(options.is_directional()),
      schedule_(options) {}

bool SubmapSequence::is_over(const Observations& frame) const {
  return SubmapOverlap::with_active(graph_, frame) < options_.overlap ||
         active_.frames() >= static_cast<std::size_t>(options_.max_submap_frames);
}

std::size_t SubmapSequence::close(MotionFilter& motion_filter, Frame& frame) {
  const Index closed = graph_.active();
  active_.realign(options_.sweeps, matcher_.rules());
  graph_.deactivate();
  schedule_.submap_closed(graph_, closed);
  // A sensor that follows two points says that they are two.
  if (frame.followed) return 0;
  return merge_duplicates(closed, motion_filter, frame.observations);
}

/// Of each member and the nearest other landmark, if that is near, the older one stays (thesis 6.5.2). Two that were seen together are two, so a
/// moving point that passes a landmark never becomes it.
std::size_t SubmapSequence::merge_duplicates(Index submap, MotionFilter& motion_filter, Observations& frame) {
  std::size_t merged = 0;
  matcher_.mark(frame);
  for (const Member& member : graph_.submaps[submap].members) {
    if (member.count == 0) continue;
    const Index landmark = member.landmark;
    const Index duplicate = graph_.find_duplicate(landmark, options_.separation(), [&](Index other) {
      return (matcher_.is_marked(other) && matcher_.is_marked(landmark)) ||
             motion_filter.are_two(landmark, other);
    });
    if (duplicate == kNone) continue;
    const Index into = std::min(landmark, duplicate);
    const Index from = std::max(landmark, duplicate);
    graph_.merge(into, from);
    motion_filter.merged(from, into);
    for (Observation& observation : frame) {
      if (observation.landmark == from) observation.landmark = into;
    }
    matcher_.mark(frame);
    ++merged;
  }
  return merged;
}

SubmapSequence::Taken SubmapSequence::take_up(const Observations& frame, const Pose& T_map_sensor) {
  const Index old = overlap_.best(graph_, frame, options_.overlap);
  if (old != kNone) {
    Pose T = graph_.poses[old].inverse() * T_map_sensor;
    if (matcher_.fit_submap(old, frame, T)) {
      ++activation_;
      active_.open(old);
      return {T, true};
    }
  }
  open_new(T_map_sensor);
  return {Pose{}, false};
}

void SubmapSequence::open_new(const Pose& T_map_sensor) {
  ++activation_;
  active_.open(graph_.add_submap(T_map_sensor));
  first_of_submap_ = true;
}

std::size_t SubmapSequence::integrate(const Observations& frame, const Pose& T_submap_sensor) {
  std::size_t seen = 0;
  active_.begin_frame(T_submap_sensor);
  sightings_.clear();
  for (const Observation& observation : frame) {
    if (observation.landmark == kNone) continue;
    sightings_.push_back({observation.landmark, observation.point, observation.weight, observation.across});
    const LandmarkRecord& landmark = graph_.landmarks[observation.landmark];
    if (landmark.last_activation + static_cast<std::uint64_t>(options_.window) < activation_)
      schedule_.saw_old_ground();
    const Index member = landmark.active_member;
    ++seen;
    if (member == kNone) {
      active_.join(observation.landmark, observation.point, first_of_submap_, activation_,
                   observation.weights());
    } else {
      active_.observe(member, observation.point, activation_, observation.weights());
    }
  }
  first_of_submap_ = false;
  segments_.add_frame(graph_.active(), T_submap_sensor, matcher_.rules(), sightings_);
  return seen;
}

std::uint64_t SubmapSequence::local_since() const {
  const std::uint64_t window = static_cast<std::uint64_t>(options_.window);
  return activation_ > window ? activation_ - window : 0;
}

void SubmapSequence::clear() {
  active_.clear();
  segments_.clear();
  schedule_ = StepSchedule(options_);
}

}  // namespace hallway::slam_point
