// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "base/spill_list.hpp"
#include "eval/path_verdict.hpp"
#include "eval/pose_pairs.hpp"
#include "eval/sequence.hpp"
#include "eval/trajectory_score.hpp"
#include "geometry/se3.hpp"

namespace hallway::eval {

/// Poses that were answered under `epoch` are in the frame of reference of the part `into` of the map.
struct JoinedEpoch {
  std::uint64_t epoch = 0;
  std::uint64_t into = 0;
};

/// The number of the part that poses answered under `epoch` are in.
std::uint64_t final_epoch(std::uint64_t epoch, std::span<const JoinedEpoch> joined);

/// One frame of a run, as far as its path goes.
struct PathFrame {
  double t_s = 0.0;
  std::optional<Pose> T_world_body{};  ///< the truth, where known
  bool orientation_known = true;       ///< false: of the truth only the position is meant
  std::optional<Pose> T_map_body{};    ///< the estimate; empty where there is none
  std::optional<Eigen::Matrix<double, 6, 6>> covariance{};  ///< of the estimate's error
  /// Which connected part of its map the plugin says the pose is in; empty: as in the last frame with a pose, 0 at first.
  std::optional<std::uint64_t> map_epoch{};
};

/// The path of one connected part of a map. It is there as long as the PathParts that it is of, which does not change meanwhile.
struct PartPath {
  TrajectoryScore score{};
  Sequence<PosePair> pairs{};             ///< where truth and estimate are known
  Sequence<std::uint64_t> pair_frames{};  ///< by pair: the number of its frame

  /// O(pairs).
  std::uint64_t frame_of(std::size_t pair) const;
};

/// A path of poses that need not be in one frame of reference: a map that was started anew has parts that nothing connects, which are
/// never scored as one. It is kept in a folder, if there is one; memory then grows with the parts alone.
class PathParts {
 public:
  /// @param folder  see SpillList, as all that throws
  explicit PathParts(const std::filesystem::path& folder = {})
      : entries_(folder), covariances_(folder), true_path_(folder) {}

  /// Adds the next frame. O(log parts).
  void add(const PathFrame& frame);

  /// What the whole comes to.
  struct Summary {
    std::uint64_t parts = 0;     ///< with a pose, parts that were joined counted as one
    std::uint64_t restarts = 0;  ///< how often a pose was in a part that was not there before
    std::uint64_t scored =
        0;  ///< the number of the part with the most poses, of equal ones the one that came first
    std::uint64_t last = 0;  ///< the number of the part with the last pose
    PoseCount poses{};
  };
  Summary summary(std::span<const JoinedEpoch> joined) const;
  /// The path of the part of that number. O(frames).
  PartPath path_of(std::uint64_t part, std::span<const JoinedEpoch> joined) const;
  /// The frames with both poses in the part that the last pose is in, in order: those in the frame of reference of the map at the end.
  std::vector<std::uint64_t> frames_of_map(std::span<const JoinedEpoch> joined) const;
  /// The true positions of all frames, with and without an estimate.
  Sequence<Vec3> true_path() const;
  /// Whether orientations are known of all true poses that stand beside an estimate.
  bool orientations_known() const { return orientations_known_; }

 private:
  using Position = std::array<double, 3>;
  /// Orientation x, y, z, w, then position.
  using PoseRecord = std::array<double, 7>;
  using Covariance = std::array<double, 36>;
  /// A frame with both poses.
  struct Entry {
    std::uint64_t frame = 0;
    std::uint64_t epoch = 0;
    PoseRecord T_world_body{};
    PoseRecord T_map_body{};
    double t_s = 0.0;
    double travelled_m = 0.0;
    std::uint64_t covariance = 0;  ///< index in covariances_ plus one; 0 for none
    bool orientation_known = true;
  };
  struct Epoch {
    std::uint64_t poses = 0;
    std::uint64_t first = 0;  ///< frame
    std::uint64_t last = 0;
  };

  class EntryReader;

  static PoseRecord record_of(const Pose& pose);
  static Pose pose_of(const PoseRecord& record);
  Sequence<StatedCovariance> stated_in(const std::vector<std::uint64_t>& epochs, std::size_t size) const;
  std::vector<std::uint64_t> epochs_in(std::uint64_t part, std::span<const JoinedEpoch> joined) const;

  SpillList<Entry> entries_;
  SpillList<Covariance> covariances_;
  std::map<std::uint64_t, Epoch> epochs_;  ///< with a pose
  std::uint64_t frames_ = 0;
  std::uint64_t epoch_ = 0;  ///< of the last frame with a pose
  double travelled_m_ = 0.0;
  SpillList<Position> true_path_;
  Vec3 last_true_ = Vec3::Zero();  ///< of true_path_
  bool orientations_known_ = true;
};

}  // namespace hallway::eval
