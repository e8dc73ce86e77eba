// SPDX-License-Identifier: MIT
#include "slam_point/core/submaps/submap_sequence.hpp"

#include <algorithm>

#include "slam_point/core/submaps/landmark_merging.hpp"

namespace hallway::slam_point {

SubmapSequence::SubmapSequence(const Options& options, SubmapGraph& graph, FrameMatcher& matcher)
    : options_(options),
      graph_(graph),
      matcher_(matcher),
      active_(std::max(options.match_bound(), matcher.agreement()), static_cast<IndexKind>(options.index)),
      segments_(options.is_directional()),
      schedule_(options) {}

bool SubmapSequence::is_over(const std::vector<Observation>& frame) const {
  return SubmapOverlap::with_active(graph_, frame) < options_.overlap ||
         active_.frames() >= static_cast<std::size_t>(options_.max_submap_frames);
}

std::size_t SubmapSequence::close(MotionFilter& motion_filter, bool planar, bool followed,
                                  std::vector<Observation>& frame) {
  const Index closed = graph_.active();
  active_.realign(graph_, options_.sweeps, planar, matcher_.rules(planar).min_spread_m2);
  graph_.deactivate();
  schedule_.submap_closed(graph_, closed);
  // Who follows two points says that they are two.
  if (followed) return 0;
  return merge_landmarks(graph_, closed, options_.separation(), matcher_, motion_filter, frame);
}

SubmapSequence::Taken SubmapSequence::take_up(const std::vector<Observation>& frame, bool planar,
                                              const Pose& T_map_sensor) {
  const Index old = overlap_.best(graph_, frame, options_.overlap);
  if (old != kNone) {
    Pose T = graph_.poses[old].inverse() * T_map_sensor;
    if (reopen(old, frame, planar, T)) return {T, true};
  }
  open_new(T_map_sensor);
  return {Pose{}, false};
}

bool SubmapSequence::reopen(Index submap, const std::vector<Observation>& frame, bool planar,
                            Pose& T_submap_sensor) {
  if (!matcher_.fit_submap(graph_, submap, frame, planar, T_submap_sensor)) return false;
  ++activation_;
  active_.open(graph_, submap);
  return true;
}

void SubmapSequence::open_new(const Pose& T_map_sensor) {
  ++activation_;
  active_.open(graph_, graph_.add_submap(T_map_sensor));
  first_of_submap_ = true;
}

std::size_t SubmapSequence::integrate(const std::vector<Observation>& frame, const Pose& T_submap_sensor,
                                      bool planar) {
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
      active_.join(graph_, observation.landmark, observation.point, first_of_submap_, activation_,
                   observation.weights());
    } else {
      active_.observe(graph_, member, observation.point, activation_, observation.weights());
    }
  }
  first_of_submap_ = false;
  segments_.add_frame(graph_.active(), T_submap_sensor, planar, matcher_.rules(planar).min_spread_m2,
                      sightings_);
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
