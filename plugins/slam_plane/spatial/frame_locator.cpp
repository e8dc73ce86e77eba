// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/frame_locator.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::slam_plane::spatial {
namespace {

constexpr std::uint64_t kRecent = 15;  // frames for which a face counts as seen just before
constexpr double kStraySigmas = 6.0;   // and kStray_m: beside the face that it should be
constexpr double kStray_m = 0.05;
constexpr double kDoubt_m = 0.002;    // by how much a predicted place may be wrong: a frame,
constexpr double kDoubtShare = 0.05;  // and of the way
constexpr double kStray_rad = 0.05;   // likewise, of its direction
constexpr int kPatience = 10;         // frames without a pose after which the map is searched,
constexpr int kSearchEvery = 5;       // of so many one
constexpr double kOneStep_m = 0.5;    // that a robot may move from frame to frame
constexpr double kOneStep_rad = 0.4;

}  // namespace

std::vector<Index> Frame::faces() const {
  std::vector<Index> faces;
  for (const Sighting& sighting : sightings) {
    if (sighting.face != kNone) faces.push_back(sighting.face);
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

FrameLocator::FrameLocator(const Options& options)
    : matcher_(options),
      search_(options),
      fit_(options),
      smoothing_(options.smoothing),
      worst_doubt_m_(options.map_bound_m) {}

Lost FrameLocator::locate(const FaceMap& map, Frame& frame) {
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
Lost FrameLocator::follow(const FaceMap& map, Frame& frame) {
  predict(map, frame);
  associate(map, frame);
  Pose3 T = frame.T_map_robot;
  frame.known = fit(map, frame, T);
  if (drop_strays(map, T, frame)) {
    T = frame.T_map_robot;
    frame.known = fit(map, frame, T);
  }
  frame.T_map_robot = T;
  const bool none = std::none_of(frame.sightings.begin(), frame.sightings.end(),
                                 [](const Sighting& s) { return s.face != kNone && !s.stray; });
  if (none) return Lost::nothing_known;
  return frame.known.determined() && doubt_m_ <= worst_doubt_m_ ? Lost::no : Lost::undetermined;
}

/// Believes what two frames, one after the other, are found at.
bool FrameLocator::search(const FaceMap& map, Frame& frame) {
  if (!suspected_ && frames_lost_ % kSearchEvery != 0) return false;
  const std::optional<Pose3> before = suspected_;
  suspected_.reset();
  if (!own_information(frame).determined()) return false;
  suspected_ = search_.find(map, frame.sightings);
  if (!before || !suspected_ || (before->t - suspected_->t).norm() > kOneStep_m ||
      before->q.angularDistance(suspected_->q) > kOneStep_rad)
    return false;
  Pose3 T = *suspected_;
  for (Sighting& sighting : frame.sightings) {
    sighting.face = kNone;
    sighting.stray = false;
  }
  matcher_.match_map(map, T, frame.sightings);
  const PoseInformation known = fit(map, frame, T);
  if (!known.determined()) return false;
  drop_strays(map, T, frame);
  frame.known = fit(map, frame, T);
  frame.T_map_robot = T;
  suspected_.reset();
  frames_lost_ = 0;
  motion_.setZero();
  moving_ = false;
  return frame.known.determined();
}

void FrameLocator::predict(const FaceMap& map, Frame& frame) const {
  const Pose3 motion{rotation_by(motion_.tail<3>()), motion_.head<3>()};
  frame.T_submap_robot = frame.T_submap_robot * motion;
  frame.T_map_robot = map.submaps[map.active()].T_map_submap * frame.T_submap_robot;
}

/// Where the prediction is a little wrong, a narrow face may be taken for its neighbour: what is matched by it only corrects it.
void FrameLocator::associate(const FaceMap& map, Frame& frame) {
  Pose3 T = frame.T_map_robot;
  const std::uint64_t since = frame.iteration > kRecent ? frame.iteration - kRecent : 0;
  matcher_.match_recent(map, since, T, frame.sightings);
  fit(map, frame, T);
  for (Sighting& sighting : frame.sightings) {
    sighting.face = kNone;
    sighting.stray = false;
  }
  matcher_.match_recent(map, since, T, frame.sightings);
  matcher_.match_map(map, T, frame.sightings);
}

PoseInformation FrameLocator::fit(const FaceMap& map, const Frame& frame, Pose3& T) {
  const Pose3 predicted = T;
  PoseInformation information;
  for (const bool all_edges : {false, true}) {
    T = predicted;
    fit_.clear();
    for (const Sighting& sighting : frame.sightings) {
      if (sighting.face != kNone && !sighting.stray)
        fit_.add(sighting, map.faces[sighting.face].plane, map.lines(sighting.face, all_edges));
    }
    information = fit_.solve(T);
    if (information.determined()) break;
  }
  return information;
}

/// Finds what lies beside its face, unless so much does that the pose must be wrong.
bool FrameLocator::drop_strays(const FaceMap& map, const Pose3& T, Frame& frame) const {
  std::vector<Sighting*> strays;
  std::size_t matched = 0;
  for (Sighting& sighting : frame.sightings) {
    if (sighting.face == kNone || sighting.stray) continue;
    ++matched;
    const Feature& plane = map.faces[sighting.face].plane;
    const bool beside = std::abs(plane.distance(T * sighting.centre)) > kStray_m ||
                        plane.normal().cross(T.q * sighting.normal).norm() > kStray_rad;
    if (beside && fit_.distance2(sighting, plane, T) > kStraySigmas * kStraySigmas)
      strays.push_back(&sighting);
  }
  if (strays.empty() || 2 * strays.size() >= matched) return false;
  for (Sighting* sighting : strays) sighting->stray = true;
  return true;
}

void FrameLocator::note_motion(const FaceMap& map, Frame& frame) {
  if (T_before_) {
    const Pose3 moved = T_before_->inverse() * frame.T_map_robot;
    Vec6 now;
    now << moved.t, rotation_vector(moved.q);
    motion_ += (moving_ ? smoothing_ : 1.0) * (now - motion_);
    moving_ = true;
  }
  T_before_ = frame.T_map_robot;
  frame.T_submap_robot = map.submaps[map.active()].T_map_submap.inverse() * frame.T_map_robot;
  doubt_m_ = 0.0;
}

void FrameLocator::drift(const FaceMap& map, Frame& frame) {
  frame.T_submap_robot = map.submaps[map.active()].T_map_submap.inverse() * frame.T_map_robot;
  doubt_m_ += kDoubt_m + kDoubtShare * motion_.head<3>().norm();
  T_before_.reset();
  for (Sighting& sighting : frame.sightings) sighting.face = kNone;
}

void FrameLocator::carry(const Pose3& T_map_before) {
  if (T_before_) T_before_ = T_map_before * *T_before_;
}

}  // namespace hallway::slam_plane::spatial
