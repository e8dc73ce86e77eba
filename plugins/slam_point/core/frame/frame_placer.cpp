// SPDX-License-Identifier: MIT
#include "slam_point/core/frame/frame_placer.hpp"

#include <algorithm>
#include <numbers>

namespace hallway::slam_point {
namespace {

constexpr double kSureShare = 0.5;   // of the comparable points, below which a better pose is searched
constexpr int kSurePoints = 6;       // or all there are, likewise
constexpr double kLeastShare = 0.4;  // below which there is no pose
constexpr int kLeastAgreeing = 3;    // points: likewise, where the sensor was expected
constexpr int kLeastInPlane = 2;     // likewise, of points in a plane
constexpr int kLeastAfterLoss = 4;   // after a frame without a pose
constexpr int kLeastAfterGap = 5;    // after more than a short gap

}  // namespace

Placement FramePlacer::place(Frame& frame) {
  Placement placement = look_from(tracking_.predicted(), frame);
  // A few points can agree by chance, so of few nearly all must.
  const int comparable = comparable_points(frame);
  placement.is_sure = placement.agreeing >= std::min(comparable, kSurePoints) &&
                      placement.agreeing >= kSureShare * comparable;
  // Tracks need no prediction.
  if (!placement.is_sure && !frame.followed) placement = search(placement, frame);
  placement.has_pose = is_placed(placement, frame);
  if (placement.has_pose) {
    matcher_.drop_outliers(placement.T_map_sensor, submaps_.local_since(), frame.observations);
  } else {
    give_up(frame, placement);
  }
  return placement;
}

Placement FramePlacer::place_at(const Pose& T_map_sensor, Frame& frame) {
  Placement placement;
  placement.has_pose = true;
  placement.T_map_sensor = T_map_sensor;
  // Nothing says how the place found drifted against where the sensor was: all of it is old.
  const std::uint64_t never = ~std::uint64_t{0};
  matcher_.mark(frame.observations);
  matcher_.match_map(placement.T_map_sensor, never, options_.map_bound(), frame.observations);
  matcher_.fit_map(frame.observations, placement.T_map_sensor);
  matcher_.drop_outliers(placement.T_map_sensor, never, frame.observations);
  return placement;
}

/// Associates and fits the frame from a guess of T_submap_sensor.
Placement FramePlacer::look_from(const Pose& predicted, Frame& frame) {
  Placement placement;
  const bool is_in_submap = associate(predicted, frame, placement);
  fit(is_in_submap, frame, placement);
  return placement;
}

/// Matches to the active submap, and what is left to the map. Whether the submap determines T_submap_sensor.
bool FramePlacer::associate(const Pose& predicted, Frame& frame, Placement& placement) {
  const StageClock::Scope timing(clock_, Stage::matching);
  FrameMatcher::Fit fit = matcher_.match_active(submaps_.active(), predicted, frame.observations);
  Pose located;
  if (!fit.solved && frame.followed && matcher_.locate_by_tracks(frame.observations, located))
    fit.T_submap_sensor = T_map_submap().inverse() * located;
  placement.T_submap_sensor = fit.T_submap_sensor;
  placement.T_map_sensor = T_map_submap() * fit.T_submap_sensor;
  // Where the active submap gave no fit, the prediction alone says where to look.
  const double local_bound = fit.solved ? options_.agreement() : options_.match_bound();
  matcher_.match_map(placement.T_map_sensor, submaps_.local_since(), local_bound, frame.observations);
  return fit.solved;
}

/// Fits to the map.
void FramePlacer::fit(bool is_in_submap, const Frame& frame, Placement& placement) {
  const StageClock::Scope timing(clock_, Stage::fitting);
  placement.is_observable = matcher_.fit_map(frame.observations, placement.T_map_sensor);
  if (placement.is_observable)
    placement.agreeing = matcher_.count_agreeing(frame.observations, placement.T_map_sensor);
  if (!is_in_submap) placement.T_submap_sensor = T_map_submap().inverse() * placement.T_map_sensor;
}

/// Looks for a frame that is not where the prediction led: by its constellations, in all of the map, then for a rotation about the z axis.
Placement FramePlacer::search(const Placement& tracked, Frame& frame) {
  const StageClock::Scope timing(clock_, Stage::fitting);
  Relocalisation found;
  // What is being joined lies in two frames.
  if (!parts_.is_joining() && places_.find_frame(frame.observations, found))
    return recognised(found, tracked, frame);
  return search_turn(tracked, frame);
}

Placement FramePlacer::recognised(const Relocalisation& found, const Placement& tracked, Frame& frame) {
  const bool is_here = found.part == graph_.part();
  Placement placement = is_here ? look_elsewhere(found.T_map_points, frame) : tracked;
  placement.is_recognised = true;
  if (is_here && is_placed(placement, frame)) return placement;
  placement.agreeing = 0;
  placement.elsewhere = found;
  return placement;
}

Placement FramePlacer::search_turn(const Placement& tracked, Frame& frame) {
  if (options_.max_turn_rad <= 0.0) return tracked;
  const double reach =
      std::min(options_.max_turn_rad * (1.0 + tracking_.frames_without_pose()), std::numbers::pi);
  Pose found;
  const int agreeing = matcher_.search_turn(
      {T_map_submap() * tracking_.predicted(), T_map_submap() * tracking_.last_T_submap_sensor()}, reach,
      frame.observations, found);
  return agreeing > tracked.agreeing ? look_elsewhere(found, frame) : tracked;
}

Placement FramePlacer::look_elsewhere(const Pose& T_map_sensor, Frame& frame) {
  Placement placement = look_from(T_map_submap().inverse() * T_map_sensor, frame);
  placement.is_searched = true;
  return placement;
}

bool FramePlacer::is_placed(const Placement& placement, const Frame& frame) {
  return placement.agreeing >= least_agreeing(placement, frame) &&
         placement.agreeing >= kLeastShare * comparable_points(frame) &&
         (is_expected(placement) || !places_.may_be_chance(frame.observations, placement.T_map_sensor));
}

/// How many points must agree. The less is known of where the sensor may be, the more places there are where a few agree by chance.
int FramePlacer::least_agreeing(const Placement& placement, const Frame& frame) const {
  if (!is_expected(placement)) return tracking_.is_long_lost() ? kLeastAfterGap : kLeastAfterLoss;
  // Two determine the pose in a plane; but a frame of no more than these has nothing to check them by.
  const bool few_will_do =
      frame.planar && frame.observations.size() >= kLeastAgreeing && !placement.is_searched;
  return few_will_do ? kLeastInPlane : kLeastAgreeing;
}

/// Whether the sensor is where the prediction has it as surely as after a frame with a pose.
bool FramePlacer::is_expected(const Placement& placement) const {
  return tracking_.frames_without_pose() == 0 || (tracking_.is_bridged() && !placement.is_searched);
}

/// A view that opens shows much that is new, one that closes little of what was seen: the smaller of both must agree.
int FramePlacer::comparable_points(const Frame& frame) const {
  return static_cast<int>(std::min(frame.observations.size(), tracking_.last_seen()));
}

/// Leaves a frame without a pose, and says what it shows all the same.
void FramePlacer::give_up(Frame& frame, Placement& placement) const {
  for (Observation& observation : frame.observations) {
    if (observation.landmark != kNone) ++placement.associated;
    observation.landmark = kNone;
  }
  placement.contradicts_prediction = placement.is_observable || placement.associated < kSurePoints ||
                                     placement.associated < kSureShare * comparable_points(frame);
  // What fits and yet does not agree determines nothing, nor does what was expected long ago.
  if (placement.is_observable || placement.associated == 0 ||
      tracking_.frames_without_pose() >= options_.bridge_frames)
    return;
  placement.determined = frame.planar ? 2 : placement.associated == 1 ? 3 : 5;
}

}  // namespace hallway::slam_point
