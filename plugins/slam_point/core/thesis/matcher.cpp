// SPDX-License-Identifier: MIT
#include "slam_point/core/thesis/matcher.hpp"

#include <algorithm>

namespace hallway::slam_point::thesis {
namespace {

constexpr double kRefitNoises =
    8.0;  // two observations and the fit: beyond this a match after the fit is none
constexpr double kMotionInlierNoises = 6.0;

}  // namespace

Matcher::Matcher(const slam_point::Options& common, const Options& options)
    : common_(common),
      options_(options),
      grid_(static_cast<IndexKind>(common.index),
            std::max(common.match_bound(), kRefitNoises * common.noise_m)) {}

void Matcher::match_recent(Tracks& tracks, Iteration now, const Pose& moved, Observations& frame) {
  const bool predicted = options_.matching == static_cast<int>(Matching::predicted);
  Pose motion = predicted ? moved : Pose{};
  list_recent(tracks, now, motion);
  match_to_recent(common_.match_bound(), motion, frame);
  if (!predicted || !fit_motion(frame, motion)) return;
  for (Observation& observation : frame) observation.landmark = kNone;
  match_to_recent(kRefitNoises * common_.noise_m, motion, frame);
}

void Matcher::list_recent(Tracks& tracks, Iteration now, const Pose& moved) {
  const auto back = static_cast<Iteration>(options_.match_iterations);
  grid_.clear();
  recent_points_.clear();
  recent_ = tracks.seen_between(now > back ? now - back : 0, now - 1);
  place_of_.resize(tracks.size(), kNone);
  const Pose to_last = moved.inverse();
  for (Index r = 0; r < recent_.size(); ++r) {
    const Sighting& newest = tracks[recent_[r]].history.last();
    Vec3 point = newest.point;
    for (Iteration i = newest.iteration; i + 1 < now; ++i) point = to_last * point;
    grid_.add(point);
    recent_points_.push_back(point);
    place_of_[recent_[r]] = r;
  }
}

void Matcher::match_to_recent(double bound_m, const Pose& moved, Observations& frame) {
  const Mat3 rotation = moved.q.toRotationMatrix();
  const double bound2 = bound_m * bound_m;
  pairings_.clear();
  for (Index o = 0; o < frame.size(); ++o) {
    const Vec3 p = rotation * frame[o].point + moved.t;
    grid_.visit_near(p, [&](Index r) {
      const double d2 = (recent_points_[r] - p).squaredNorm();
      if (d2 <= bound2) pairings_.push_back({d2, o, recent_[r]});
    });
  }
  take_nearest_first(frame, static_cast<Index>(place_of_.size()));
}

bool Matcher::fit_motion(const Observations& frame, Pose& moved) {
  pairs_.clear();
  for (const Observation& observation : frame) {
    if (observation.landmark != kNone)
      pairs_.push_back({recent_points_[place_of_[observation.landmark]], observation.point, 1.0});
  }
  const double spread = common_.noise_m;
  return robust_fit(pairs_, {false, spread * spread, kMotionInlierNoises * common_.noise_m}, moved);
}

void Matcher::match_map(const Tracks& tracks, const Pose& T_map_sensor, Observations& frame) {
  const Mat3 rotation = T_map_sensor.q.toRotationMatrix();
  const double bound2 = common_.map_bound() * common_.map_bound();
  pairings_.clear();
  for (Index o = 0; o < frame.size(); ++o) {
    if (frame[o].landmark != kNone) continue;
    const Vec3 p = rotation * frame[o].point + T_map_sensor.t;
    tracks.visit_near(p, [&](Index track) {
      const double d2 = (tracks[track].position - p).squaredNorm();
      if (d2 <= bound2 && tracks[track].is_mapped()) pairings_.push_back({d2, o, track});
    });
  }
  take_nearest_first(frame, tracks.size());
}

void Matcher::take_nearest_first(Observations& frame, Index tracks) {
  taken_.assign(tracks, 0);
  for (const Observation& observation : frame) {
    if (observation.landmark != kNone) taken_[observation.landmark] = 1;
  }
  std::sort(pairings_.begin(), pairings_.end());
  for (const auto& [d2, point, track] : pairings_) {
    if (frame[point].landmark != kNone || taken_[track] != 0) continue;
    frame[point].landmark = track;
    taken_[track] = 1;
  }
}

}  // namespace hallway::slam_point::thesis
