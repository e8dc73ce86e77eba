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
constexpr int kShortGap = 3;         // frames

std::ptrdiff_t matched_points(const std::vector<Observation>& frame) {
  return std::count_if(frame.begin(), frame.end(),
                       [](const Observation& observation) { return observation.landmark != kNone; });
}

}  // namespace

FramePlacer::FramePlacer(const Options& options, const SubmapGraph& graph, const SubmapSequence& submaps,
                         FrameMatcher& matcher, PlaceRecogniser& places)
    : options_(options),
      graph_(graph),
      submaps_(submaps),
      matcher_(matcher),
      places_(places),
      prediction_(options.smoothing, options.match_bound()) {}

void FramePlacer::begin(bool planar, bool followed) {
  planar_ = planar;
  followed_ = followed;
}

void FramePlacer::match(std::vector<Observation>& frame) {
  const int frames = std::min(frames_without_pose_, options_.bridge_frames) + 1;
  predicted_ = prediction_.after(last_T_submap_sensor_, frames);
  match_active_submap(frame);
  match_map(frame);
}

void FramePlacer::match_active_submap(std::vector<Observation>& frame) {
  fit_ = matcher_.match_active(graph_, submaps_.active(), predicted_, planar_, frame);
  if (fit_.solved || !followed_) return;
  Pose located;
  if (matcher_.locate_by_tracks(graph_, planar_, frame, located))
    fit_.T_submap_sensor = T_map_submap().inverse() * located;
}

void FramePlacer::match_map(std::vector<Observation>& frame) {
  // Where the active submap gave no fit, the prediction alone says where to look.
  const double local_bound = fit_.solved ? matcher_.agreement() : options_.match_bound();
  T_map_sensor_ = T_map_submap() * fit_.T_submap_sensor;
  matcher_.match_map(graph_, T_map_sensor_, submaps_.local_since(), local_bound, frame);
}

bool FramePlacer::fit(const std::vector<Observation>& frame) {
  agreeing_ = 0;
  fits_ = matcher_.fit_map(graph_, frame, planar_, T_map_sensor_);
  if (fits_) agreeing_ = matcher_.count_agreeing(graph_, frame, T_map_sensor_);
  if (!fit_.solved) fit_.T_submap_sensor = T_map_submap().inverse() * T_map_sensor_;
  searched_ = false;
  found_ = Placement();
  // A few points can agree by chance, so of few nearly all must.
  const auto comparable = static_cast<int>(comparable_points(frame));
  return agreeing_ >= std::min(comparable, kSurePoints) && agreeing_ >= kSureShare * comparable;
}

bool FramePlacer::search(bool by_place, std::vector<Observation>& frame) {
  if (by_place && recognise(frame)) return true;
  search_turn(frame);
  return false;
}

/// Looks for the frame by what it sees alone, in all of the map.
bool FramePlacer::recognise(std::vector<Observation>& frame) {
  Placement found;
  if (!places_.find_frame(graph_, frame, planar_, found)) return false;
  if (found.part == graph_.part() && look_from(found.T_map_points, frame)) return true;
  agreeing_ = 0;
  found_ = found;
  return true;
}

void FramePlacer::search_turn(std::vector<Observation>& frame) {
  if (options_.max_turn_rad <= 0.0) return;
  search_bases_.assign({T_map_submap() * predicted_, T_map_submap() * last_T_submap_sensor_});
  const double reach = std::min(options_.max_turn_rad * (1.0 + frames_without_pose_), std::numbers::pi);
  Pose found;
  if (matcher_.search_turn(graph_, search_bases_, reach, planar_, frame, found) <= agreeing_) return;
  look_from(found, frame);
}

/// Matches and fits the frame from a new guess. Whether it is placed then.
bool FramePlacer::look_from(const Pose& T_map_sensor, std::vector<Observation>& frame) {
  predicted_ = T_map_submap().inverse() * T_map_sensor;
  match_active_submap(frame);
  match_map(frame);
  fit(frame);
  searched_ = true;
  return is_placed(frame);
}

bool FramePlacer::is_placed(const std::vector<Observation>& frame) {
  const int least = least_agreeing(frame.size());
  const bool may_be_chance =
      !is_expected() && agreeing_ >= least && places_.may_be_chance(graph_, frame, T_map_sensor_, planar_);
  return !may_be_chance && agreeing_ >= least &&
         static_cast<double>(agreeing_) >= kLeastShare * static_cast<double>(comparable_points(frame));
}

/// How many points must agree. The less is known of where the sensor may be, the more places there are where a few agree by chance.
int FramePlacer::least_agreeing(std::size_t points) const {
  if (!is_expected()) return frames_without_pose_ > kShortGap ? kLeastAfterGap : kLeastAfterLoss;
  // Two determine the pose in a plane; but a frame of no more than these has nothing to check them by.
  const bool few_will_do = planar_ && points >= kLeastAgreeing && !searched_;
  return few_will_do ? kLeastInPlane : kLeastAgreeing;
}

/// Whether the sensor is where the prediction has it as surely as after a frame with a pose.
bool FramePlacer::is_expected() const {
  return frames_without_pose_ == 0 || (!contradicted_ && !searched_ && frames_without_pose_ <= kShortGap);
}

/// Whether this frame, which has no pose, tells that the prediction is wrong. One that shows what was expected
/// and does not determine a pose, as points of much noise do not, speaks for the prediction.
bool FramePlacer::contradicts(const std::vector<Observation>& frame) const {
  const auto matched = static_cast<int>(matched_points(frame));
  return fits_ || matched < kSurePoints ||
         matched < kSureShare * static_cast<double>(comparable_points(frame));
}

std::size_t FramePlacer::comparable_points(const std::vector<Observation>& frame) const {
  // A view that opens shows much that is new, one that closes little of what was seen: the smaller of both must agree.
  return std::min(frame.size(), last_seen_);
}

/// Degrees of freedom that points near where they were expected determine, when these are too few or on a line.
int FramePlacer::determined_by_few(const std::vector<Observation>& frame) const {
  // What fits and yet does not agree tells nothing, nor does what was expected long ago.
  if (fits_ || frames_without_pose_ >= options_.bridge_frames) return 0;
  const std::ptrdiff_t matched = matched_points(frame);
  if (matched == 0) return 0;
  if (planar_) return 2;
  return matched == 1 ? 3 : 5;
}

void FramePlacer::accept(std::vector<Observation>& frame) {
  matcher_.drop_strays(graph_, T_map_sensor_, submaps_.local_since(), frame);
  const Pose moved = last_T_submap_sensor_.inverse() * fit_.T_submap_sensor;
  prediction_.learn(moved, frames_without_pose_ + 1, searched_);
  frames_without_pose_ = 0;
  last_T_submap_sensor_ = fit_.T_submap_sensor;
}

int FramePlacer::lose(std::vector<Observation>& frame) {
  const int determined = determined_by_few(frame);
  contradicted_ = contradicts(frame) || (frames_without_pose_ > 0 && contradicted_);
  for (Observation& observation : frame) observation.landmark = kNone;
  ++frames_without_pose_;
  return determined;
}

void FramePlacer::restart(const Pose& T_map_sensor) {
  frames_without_pose_ = 0;
  T_map_sensor_ = T_map_sensor;
}

void FramePlacer::enter(const Pose& T_map_sensor, std::vector<Observation>& frame) {
  restart(T_map_sensor);
  matcher_.mark(graph_, frame);
  // Nothing says how the place found drifted against where the sensor was: all of it is old.
  const std::uint64_t never = ~std::uint64_t{0};
  matcher_.match_map(graph_, T_map_sensor_, never, options_.map_bound(), frame);
  matcher_.fit_map(graph_, frame, planar_, T_map_sensor_);
  matcher_.drop_strays(graph_, T_map_sensor_, never, frame);
}

void FramePlacer::enter_submap(const Pose& T_submap_sensor) {
  fit_.T_submap_sensor = T_submap_sensor;
  last_T_submap_sensor_ = T_submap_sensor;
}

void FramePlacer::refit(const std::vector<Observation>& frame) {
  matcher_.fit_map(graph_, frame, planar_, T_map_sensor_);
}

}  // namespace hallway::slam_point
