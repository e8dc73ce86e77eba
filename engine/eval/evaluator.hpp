// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "base/spill_list.hpp"
#include "eval/association_score.hpp"
#include "eval/metrics.hpp"
#include "eval/motion_score.hpp"
#include "eval/path_parts.hpp"
#include "eval/plane_score.hpp"
#include "eval/refitted_path.hpp"
#include "geometry/se3.hpp"
#include "log/landmarks.hpp"
#include "log/map_landmarks.hpp"

namespace hallway::eval {

/// One iteration of a run, as the evaluator needs it. The spans are read during the call alone.
struct Iteration {
  std::optional<Pose> T_world_body{};  ///< the truth, where known
  bool orientation_known = true;       ///< false: of the truth only the position is meant
  std::optional<Pose> T_map_body{};    ///< the plugin's estimate; empty where it gave none (lost)
  double t_s = 0.0;                    ///< time of the frame
  /// Which connected part of its map the pose is in, where the plugin says so (`map_epoch`).
  std::optional<std::uint64_t> map_epoch{};
  /// Of the estimate's error, as hw_pose_output_t says; empty where it is not told.
  std::optional<Eigen::Matrix<double, 6, 6>> pose_covariance{};
  /// By observation: the landmark that the plugin took it for, kNoLandmark for none.
  std::span<const log::LandmarkId> associations{};
  /// By observation: the true landmark, kNoLandmark for none. As long as `associations`; empty where the input has no
  /// identities.
  std::span<const log::LandmarkId> identities{};
  /// By observation: where it was seen, body frame [m]. As long as `associations`; empty where that is not kept.
  std::span<const Vec3> points{};
  /// The plane observations that the plugin was given, by a sensor or by a plugin before it, and the points seen of true planes.
  std::span<const AssociatedPlane> planes{};
  std::span<const TruePlanePoint> true_plane_points{};
  std::optional<double> wall_ms{};  ///< what the plugins took
  std::optional<double> cpu_ms{};   ///< CPU time of the thread that called them
};

/// What is known beside the iterations: of the world, and of what the plugin has to answer.
struct Truth {
  bool has_identities = false;                          ///< the observations name their true landmarks
  std::optional<std::vector<log::Landmark>> landmarks;  ///< where the true landmarks are, each id once
  /// Where the true planes are, each id once; empty where the plugin maps no planes.
  std::optional<std::vector<log::TruePlane>> planes{};
  double noise_m = 0.0;  ///< of the sensor: the largest of its axes, standard deviation
  bool gives_poses =
      true;  ///< false: the plugin has no poses to give, so that the robot is not lost without them
};

/// Scores a run while it goes on. Memory grows with the landmarks and the different pairs (map landmark, true landmark) that observations have joined, and,
/// while metrics() runs, with 16 bytes an iteration. What grows with the iterations and the points given (see RefittedPath) is kept in a
/// folder, if there is one; of maps of planes it is in memory. O(1) per observation.
class Evaluator {
 public:
  /// @param folder  see SpillList, as all that throws
  explicit Evaluator(Truth truth, const std::filesystem::path& folder = {});

  /// Adds the next iteration. Throws Error{kInternal} if the truth has identities and the two spans differ in length.
  void add(const Iteration& iteration);

  /// Whether observations name their true landmarks.
  bool has_identities() const { return truth_.has_identities; }
  /// Which true landmark's observations were given to which landmark of the map.
  const AssociationScore& associations() const { return associations_; }

  /// Says that no more iterations come, and which parts of the map are one: poses in a frame of reference other than that of the map at
  /// the end have no errors on maps of planes.
  void finish(std::span<const JoinedEpoch> joined);

  /// The metrics of everything added so far.
  ///
  /// @param online   the map as the plugin left it after the last iteration, each id once
  /// @param refined  the map as re-solved at the end under the same ids; empty where the plugin does not do so
  /// @param joined   parts of the map that the plugin says at the end to be one
  Metrics metrics(std::span<const log::MapLandmark> online,
                  const std::optional<std::vector<log::MapLandmark>>& refined,
                  std::span<const JoinedEpoch> joined = {}) const;
  /// The same for maps of planes; null where the true planes are not known.
  const PlaneScore* planes() const { return planes_ ? &*planes_ : nullptr; }

 private:
  void add_planes(const Iteration& iteration);
  void score_refitted_path(const std::vector<log::MapLandmark>& refined, Metrics& metrics) const;
  /// @param first_pose  T_world_map by the first pose in the part that the map is of
  /// @return T_map_world by the landmarks of `online`, if they determine it
  std::optional<Pose> score_landmarks(std::span<const log::MapLandmark> online,
                                      const std::optional<std::vector<log::MapLandmark>>& refined,
                                      const std::optional<Pose>& first_pose, Metrics& metrics) const;
  /// Associated observations whose landmark a map does not have.
  std::uint64_t dropped_associations(std::span<const log::MapLandmark> map) const;
  /// @param T_map_world  of the map at the end, if that is determined
  void score_path(const PathParts::Summary& summary, const PartPath& path,
                  const std::optional<Pose>& T_map_world, Metrics& metrics) const;

  bool moves(log::LandmarkId landmark) const { return motion_ && motion_->moves(landmark); }

  Truth truth_;
  std::uint64_t iterations_ = 0;
  std::uint64_t lost_ = 0;
  AssociationScore associations_;
  std::optional<MotionScore> motion_;  ///< where the truth says what moves
  std::optional<PlaneScore> planes_;   ///< where the truth has planes
  PathParts path_;
  RefittedPath refitted_path_;
  SpillList<double> wall_ms_;
  SpillList<double> cpu_ms_;
};

}  // namespace hallway::eval
