// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "base/spill_list.hpp"
#include "eval/metrics.hpp"
#include "link/messages.hpp"
#include "run/sources/source.hpp"

namespace hallway::run {

/// The poses and commands that a robot program answered, and how near the poses come to the true ones. Kept in the folder that is written until its end.
class ServedPath {
 public:
  /// @param folder  see SpillList, as all that throws
  explicit ServedPath(const std::filesystem::path& folder)
      : folder_(folder), frames_(folder), ends_(folder) {}

  /// The next frame that was sent.
  void add_frame(const SourceFrame& frame);
  /// An answer to a frame that was sent. Of several to one frame the last counts.
  void add_answer(const link::Answer& answer);

  /// Writes trajectory.tum and metrics.json, as a run has them, and commands.csv and pose_times.csv where there are any. The metrics are of the path alone: no map comes back, and no
  /// associations. Throws Error{kIo}. @return the metrics
  /// @param drive  of a robot that obeyed
  eval::Metrics write(const Source& source, const std::optional<sim::DriveCounts>& drive) const;

 private:
  using TruePose = std::array<double, 7>;  ///< orientation x, y, z, w, then position
  /// Where the body was when a sample ended at another time than its frame's.
  struct SampleEnd {
    std::int64_t t_ns = 0;
    TruePose T_world_body{};
  };
  struct Frame {
    std::int64_t t_ns = 0;
    std::int64_t pose_t_ns = 0;   ///< time that the answered pose is of; 0: the frame's
    std::uint64_t first_end = 0;  ///< in ends_, of its samples
    std::uint32_t n_ends = 0;
    TruePose T_world_body{};
    bool has_truth = false;
    bool orientation_known = true;
    bool has_pose = false;  ///< false: none came, or it was lost
    bool has_command = false;
    hw_pose_t T_map_body{};
    std::array<double, 3> command{};  ///< linear, angular, lateral
  };

  std::optional<Pose> true_pose(const Frame& frame) const;

  std::filesystem::path folder_;
  std::uint64_t answers_ = 0;  ///< of calls that did not fail
  std::uint64_t poses_ = 0;    ///< answers with a pose, also one that is lost
  SpillList<Frame> frames_;
  SpillList<SampleEnd> ends_;
};

}  // namespace hallway::run
