// SPDX-License-Identifier: MIT
#include "icp/core/localiser.hpp"

#include <algorithm>

#include "icp/core/cloud_scale.hpp"

namespace hallway::icp {
namespace {

constexpr double kTurnStep_rad = 0.05;

Pose turned(const Pose& pose, double yaw) {
  return {(pose.q * Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vec3::UnitZ()))).normalized(), pose.t};
}

double range_of(const Points& points) {
  double range = 0.0;
  for (const Vec3& p : points) {
    if (usable(p)) range = std::max(range, p.norm());
  }
  return range;
}

}  // namespace

const Answer& Localiser::process(const Points& points) {
  const bool follows = answer_.has_pose;
  answer_.has_pose = false;
  answer_.associations.clear();
  if (options_.against == Against::map) answer_.associations.assign(points.size(), kNoLandmark);
  if (!reference_) {
    start(points);
  } else {
    T_map_predicted_ = T_map_predicted_ * motion_;
    if (options_.against == Against::map) prepare_map_reference(points);
    const Registration registration = locate(sample_of(points));
    answer_.counters.iterations = registration.iterations;
    answer_.counters.residual_m = registration.residual_m;
    answer_.counters.overlap = registration.overlap;
    if (accepted(registration)) {
      const Pose T_map_sensor = reference_->T_map_target * registration.T_target_source;
      if (follows) motion_ = T_map_last_.inverse() * T_map_sensor;
      T_map_last_ = T_map_predicted_ = answer_.T_map_sensor = T_map_sensor;
      keep(points, registration);
    } else if (frames_ == 1) {
      start(points);  // the only frame so far may have been a false one
    }
  }
  if (!answer_.has_pose) ++answer_.counters.lost;
  return answer_;
}

/// What of a frame is registered.
Points Localiser::sample_of(const Points& points) const {
  return sampled(usable_points(points), static_cast<std::size_t>(options_.max_points));
}

Localiser::Reference Localiser::make_reference(const Points& points, const Pose& T_map_target) const {
  const bool planes = options_.metric == Metric::point_to_plane;
  Reference reference{
      Target(points, planes ? static_cast<std::size_t>(options_.normal_neighbours) : 0), {}, T_map_target};
  reference.rules =
      options_.rules_for(spacing_of(sample_of(reference.target.points()), reference.target.tree()));
  return reference;
}

/// Begins with this frame, if it can be registered with itself: then it determines a pose.
bool Localiser::start(const Points& points) {
  Reference first = make_reference(points, Pose());
  if (register_cloud(first.target, sample_of(points), Pose(), first.rules).outcome != Outcome::converged)
    return false;
  if (reference_) ++answer_.epoch;
  reference_.emplace(std::move(first));
  T_map_predicted_ = T_map_last_ = motion_ = answer_.T_map_sensor = Pose();
  last_points_.clear();
  frames_ = 1;
  answer_.has_pose = true;
  answer_.counters.keyframes += options_.against == Against::keyframe ? 1 : 0;
  if (options_.against == Against::map) {
    map_.emplace(reference_->rules.max_distance_m);
    add_to_map(points);
  }
  return true;
}

/// The part of the map that this frame may see.
void Localiser::prepare_map_reference(const Points& points) {
  const double radius_m = range_of(points) + reference_->rules.reach_m;
  const Rules rules = reference_->rules;
  reference_.emplace(make_reference(map_->near(T_map_predicted_.t, radius_m), Pose()));
  reference_->rules = rules;  // of the first frame, as the map's separation is
}

/// Registers a frame from where it is predicted, or turned from there.
Registration Localiser::locate_from(const Points& sample, double turn) const {
  const Pose guess = reference_->T_map_target.inverse() * turned(T_map_predicted_, turn);
  return register_cloud(reference_->target, sample, guess, reference_->rules);
}

/// The last frame becomes the keyframe.
void Localiser::pass_keyframe_on() {
  reference_.emplace(make_reference(last_points_, T_map_last_));
  last_points_.clear();
  ++answer_.counters.keyframes;
}

/// Registers a frame from where it is predicted; where that fails, from turns to either side, and the one with most overlap counts.
Registration Localiser::locate(const Points& sample) {
  Registration best = locate_from(sample, 0.0);
  if (!accepted(best) && !last_points_.empty()) {
    pass_keyframe_on();
    best = locate_from(sample, 0.0);
  }
  if (accepted(best) || options_.max_turn_rad == 0.0) return best;
  ++answer_.counters.searches;
  const int steps = static_cast<int>(options_.max_turn_rad / kTurnStep_rad + 0.5);
  for (int step = 1; step <= steps; ++step) {
    for (const double side : {1.0, -1.0}) {
      const Registration next = locate_from(sample, side * step * kTurnStep_rad);
      if (next.outcome != Outcome::converged) continue;
      if (best.outcome != Outcome::converged || next.overlap > best.overlap) best = next;
    }
  }
  return best;
}

bool Localiser::accepted(const Registration& registration) const {
  return registration.outcome == Outcome::converged && registration.overlap >= options_.min_overlap;
}

/// Takes the frame as what later ones are registered with, as far as it is.
void Localiser::keep(const Points& points, const Registration& registration) {
  ++frames_;
  answer_.has_pose = true;
  switch (options_.against) {
    case Against::map:
      add_to_map(points);
      break;
    case Against::keyframe:
      last_points_ = points;
      if (registration.overlap < options_.keyframe_overlap) pass_keyframe_on();
      break;
    case Against::previous:
      reference_.emplace(make_reference(points, answer_.T_map_sensor));
      break;
  }
}

void Localiser::add_to_map(const Points& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (usable(points[i])) answer_.associations[i] = map_->add(answer_.T_map_sensor * points[i]);
  }
  answer_.counters.landmarks = map_->landmarks().size();
}

std::vector<Landmark> Localiser::landmarks() const {
  return map_ ? map_->landmarks() : std::vector<Landmark>();
}

}  // namespace hallway::icp
