// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/frame_locator.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::slam_plane::spatial {
namespace {

constexpr std::uint64_t kRecent = 15;   // frames for which a plane counts as seen just before
constexpr double kOutlierSigmas = 6.0;  // and kStray_m: beside the plane that it should be
constexpr double kOutlier_m = 0.05;
constexpr double kDoubt_m = 0.002;     // by how much a predicted place may be wrong: a frame,
constexpr double kDoubtShare = 0.05;   // and of the way
constexpr double kOutlier_rad = 0.05;  // likewise, of its direction
constexpr int kPatience = 10;          // frames without a pose after which the map is searched,
constexpr int kSearchEvery = 5;        // of so many one
constexpr double kOneStep_m = 0.5;     // that a robot may move from frame to frame
constexpr double kOneStep_rad = 0.4;

}  // namespace

std::vector<Index> Frame::landmarks() const {
  std::vector<Index> landmarks;
  for (const AssociatedObservation& observation : observations) {
    if (observation.landmark != kNone) landmarks.push_back(observation.landmark);
  }
  make_set(landmarks);
  return landmarks;
}

FrameLocator::FrameLocator(const Options& options)
    : matcher_(options),
      search_(options),
      fit_(options),
      smoothing_(options.smoothing),
      worst_doubt_m_(options.map_bound_m) {}

Lost FrameLocator::locate(const PlaneMap& map, Frame& frame) {
  found_again_ = false;
  const Lost lost = follow(map, frame);
  if (lost == Lost::no) {
    frames_lost_ = 0;
    suspected_.reset();
    return lost;
  }
  ++frames_lost_;
  if (doubt_m_ <= worst_doubt_m_ && frames_lost_ < kPatience) return lost;
  found_again_ = search(map, frame);
  return found_again_ ? Lost::no : lost;
}

/// From where it is predicted to be.
Lost FrameLocator::follow(const PlaneMap& map, Frame& frame) {
  predict(map, frame);
  associate(map, frame);
  Pose T = frame.T_map_robot;
  frame.known = fit(map, frame, T);
  if (drop_outliers(map, T, frame)) {
    T = frame.T_map_robot;
    frame.known = fit(map, frame, T);
  }
  frame.T_map_robot = T;
  if (std::ranges::none_of(frame.observations, &AssociatedObservation::is_evidence))
    return Lost::nothing_known;
  return frame.known.determined() && doubt_m_ <= worst_doubt_m_ ? Lost::no : Lost::unobservable;
}

/// Believes what two frames, one after the other, are found at.
bool FrameLocator::search(const PlaneMap& map, Frame& frame) {
  if (!suspected_ && frames_lost_ % kSearchEvery != 0) return false;
  const std::optional<Pose> before = suspected_;
  suspected_.reset();
  if (!own_information(frame).determined()) return false;
  suspected_ = search_.find(map, frame.observations);
  if (!before || !suspected_ || (before->t - suspected_->t).norm() > kOneStep_m ||
      before->q.angularDistance(suspected_->q) > kOneStep_rad)
    return false;
  Pose T = *suspected_;
  dissociate(frame.observations);
  matcher_.match_map(map, T, frame.observations);
  const PoseInformation known = fit(map, frame, T);
  if (!known.determined()) return false;
  drop_outliers(map, T, frame);
  frame.known = fit(map, frame, T);
  frame.T_map_robot = T;
  suspected_.reset();
  frames_lost_ = 0;
  motion_.setZero();
  moving_ = false;
  return frame.known.determined();
}

void FrameLocator::predict(const PlaneMap& map, Frame& frame) const {
  const Pose motion{rotation_by(motion_.tail<3>()), motion_.head<3>()};
  frame.T_submap_robot = frame.T_submap_robot * motion;
  frame.T_map_robot = map.submaps[map.active()].T_map_submap * frame.T_submap_robot;
}

/// Where the prediction is a little wrong, a narrow plane may be taken for its neighbour: what is matched by it only corrects it.
void FrameLocator::associate(const PlaneMap& map, Frame& frame) {
  Pose T = frame.T_map_robot;
  const std::uint64_t since = frame.iteration > kRecent ? frame.iteration - kRecent : 0;
  matcher_.match_recent(map, since, T, frame.observations);
  fit(map, frame, T);
  dissociate(frame.observations);
  matcher_.match_recent(map, since, T, frame.observations);
  matcher_.match_map(map, T, frame.observations);
}

PoseInformation FrameLocator::fit(const PlaneMap& map, const Frame& frame, Pose& T) {
  const Pose predicted = T;
  PoseInformation information;
  for (const bool all_edges : {false, true}) {
    T = predicted;
    fit_.clear();
    for (const AssociatedObservation& observation : frame.observations) {
      if (observation.is_evidence())
        fit_.add(observation, map.landmarks[observation.landmark].plane,
                 map.lines(observation.landmark, all_edges));
    }
    information = fit_.solve(T);
    if (information.determined()) break;
  }
  return information;
}

/// Finds what lies beside its plane, unless so much does that the pose must be wrong.
bool FrameLocator::drop_outliers(const PlaneMap& map, const Pose& T, Frame& frame) const {
  std::vector<AssociatedObservation*> outliers;
  std::size_t matched = 0;
  for (AssociatedObservation& observation : frame.observations) {
    if (!observation.is_evidence()) continue;
    ++matched;
    const Feature& plane = map.landmarks[observation.landmark].plane;
    const bool beside = std::abs(plane.distance(T * observation.centre)) > kOutlier_m ||
                        plane.normal().cross(T.q * observation.normal).norm() > kOutlier_rad;
    if (beside && fit_.distance2(observation, plane, T) > kOutlierSigmas * kOutlierSigmas)
      outliers.push_back(&observation);
  }
  if (outliers.empty() || 2 * outliers.size() >= matched) return false;
  for (AssociatedObservation* observation : outliers) observation->outlier = true;
  return true;
}

void FrameLocator::note_motion(const PlaneMap& map, Frame& frame) {
  if (T_before_) {
    const Pose moved = T_before_->inverse() * frame.T_map_robot;
    Vec6 now;
    now << moved.t, rotation_vector(moved.q);
    motion_ += (moving_ ? smoothing_ : 1.0) * (now - motion_);
    moving_ = true;
  }
  T_before_ = frame.T_map_robot;
  frame.T_submap_robot = map.submaps[map.active()].T_map_submap.inverse() * frame.T_map_robot;
  doubt_m_ = 0.0;
}

void FrameLocator::drift(const PlaneMap& map, Frame& frame) {
  frame.T_submap_robot = map.submaps[map.active()].T_map_submap.inverse() * frame.T_map_robot;
  doubt_m_ += kDoubt_m + kDoubtShare * motion_.head<3>().norm();
  T_before_.reset();
  for (AssociatedObservation& observation : frame.observations) observation.landmark = kNone;
}

void FrameLocator::carry(const Pose& T_map_before) {
  if (T_before_) T_before_ = T_map_before * *T_before_;
}

}  // namespace hallway::slam_plane::spatial
