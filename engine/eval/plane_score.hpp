// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "eval/association_score.hpp"
#include "eval/plane_metrics.hpp"
#include "eval/refitted_planes.hpp"
#include "geometry/se3.hpp"
#include "log/plane_landmarks.hpp"
#include "log/pose_errors.hpp"
#include "log/true_planes.hpp"

namespace hallway::eval {

/// A point on a true plane that a sensor saw, body frame, with its noise.
struct TruePlanePoint {
  log::LandmarkId true_plane = log::kNoLandmark;
  Vec3 point = Vec3::Zero();
};

/// Scores maps of planes against the true planes; docs/metrics.md defines the numbers. Memory grows with the iterations, the true planes and the different
/// pairs (landmark, true plane), and, up to a bound, with the observations (see RefittedPlanes).
class PlaneScore {
 public:
  /// Frames that a true plane must have been seen in, with at least kLeastLength_m of it in each, to be asked for.
  static constexpr std::uint32_t kLeastFrames = 20;
  static constexpr double kLeastLength_m = 0.3;
  /// Share of the shorter of two landmarks of one true plane from which on they are one twice; below, they are parts of it.
  static constexpr double kDoubled = 0.5;

  /// @param planes  each id once
  explicit PlaneScore(std::span<const log::TruePlane> planes);

  /// Adds a frame's observations, and the points seen of true planes where the true pose is known. O(1) each.
  void add(std::span<const AssociatedPlane> observations, const std::optional<Pose>& T_world_body,
           std::span<const TruePlanePoint> points);
  /// Adds an iteration that has both poses, and its observations.
  void add_pose(std::uint32_t iteration, const Pose& T_world_body, const Pose& T_map_body,
                std::span<const AssociatedPlane> observations = {});

  /// Says which of the poses are in the frame of reference of the map at the end: the others have no error there. All are, where nothing
  /// is said. @param is_in_map  by iteration
  void keep_poses(const std::function<bool(std::uint32_t)>& is_in_map);

  /// @param online, refined  the maps after the last iteration and as re-solved, each id once
  PlaneMetrics metrics(std::span<const log::PlaneLandmark> online,
                       std::span<const log::PlaneLandmark> refined) const;

  /// Which true plane's observations were associated with which landmark.
  const AssociationScore& associations() const { return associations_; }

  /// The errors of the poses, where the alignment of a map puts them; empty where it has none.
  std::vector<log::PoseErrorRow> pose_errors(std::span<const log::PlaneLandmark> map) const;
  /// The same of the poses as re-fitted to the map, those that its planes determine.
  std::vector<log::PoseErrorRow> refitted_errors(std::span<const log::PlaneLandmark> map) const;

  /// How a map lies in the world: by the best fit of its certain ends to the true ones, if three of them not near one line are known, else by the
  /// first pose; heights are left alone. Where a normal is not level: by the planes, from where the first pose puts the map, if they determine it.
  std::optional<Pose> alignment(std::span<const log::PlaneLandmark> map) const;

 private:
  struct ScoredPlane {
    std::vector<Vec3> corners;  ///< four
    std::vector<Vec3> outline;  ///< the corners, or what it is within them
    Vec3 normal = Vec3::Zero();
    Vec3 along = Vec3::Zero();  ///< unit, from the first corner to the second
    double length_m = 0.0;
    double from_m = 0.0,
           to_m = 0.0;         ///< what was seen of it, along it from the first corner; to < from: nothing
    std::uint32_t frames = 0;  ///< with enough of it
  };
  struct Pair {
    const log::PlaneLandmark* plane;
    const ScoredPlane* truth;
  };
  struct TwoPoses {
    std::uint32_t iteration;
    Pose T_world_body, T_map_body;
    bool in_map = true;  ///< of the frame of reference of the map at the end
  };

  /// The first poses in the map; null without any.
  const TwoPoses* first_poses() const;
  /// T_world_map by them; empty without any.
  std::optional<Pose> first_pose_frame() const;
  bool is_asked_for(const ScoredPlane& truth) const { return truth.frames >= kLeastFrames; }
  /// Whether all planes are upright, as a map in 2 1/2-D has them.
  static bool are_level(const std::vector<Pair>& pairs);
  std::optional<Pose> spatial_alignment(const std::vector<Pair>& pairs, bool& by_planes) const;
  std::vector<Pair> pairs_of(std::span<const log::PlaneLandmark> map) const;
  std::optional<Pose> alignment(const std::vector<Pair>& pairs, bool& by_corners) const;
  PlaneMapMetrics score(std::span<const log::PlaneLandmark> map) const;
  void count(std::span<const log::PlaneLandmark> map, PlaneMapMetrics& metrics) const;
  static void score_extents(const std::vector<Pair>& pairs, const Pose& T_world_map,
                            PlaneMapMetrics& metrics);

  std::map<log::LandmarkId, ScoredPlane> true_planes_;
  AssociationScore associations_;
  std::vector<TwoPoses> poses_;
  RefittedPlanes refitted_;
};

}  // namespace hallway::eval
