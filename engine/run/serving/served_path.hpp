// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

#include "base/spill_list.hpp"
#include "eval/metrics.hpp"
#include "link/messages.hpp"
#include "run/sources/source.hpp"

namespace hallway::run {

/// The poses and commands that a robot program answered, and how near the poses come to the true ones. Kept in the folder that is written until its end.
class ServedPath {
 public:
  /// @param folder  see SpillList, as all that throws
  explicit ServedPath(const std::filesystem::path& folder) : folder_(folder), frames_(folder) {}

  /// The next frame that was sent.
  void add_frame(const SourceFrame& frame);
  /// An answer to a frame that was sent. Of several to one frame the last counts.
  void add_answer(const link::Answer& answer);

  /// Writes trajectory.tum and metrics.json, as a run has them, and commands.csv where there are any. The metrics are of the path alone: no map comes back, and no
  /// associations. Throws Error{kIo}. @return the metrics
  /// @param drive  of a robot that obeyed
  eval::Metrics write(const Source& source, const std::optional<sim::DriveCounts>& drive) const;

 private:
  struct Frame {
    std::int64_t t_ns = 0;
    std::array<double, 7> T_world_body{};  ///< orientation x, y, z, w, then position
    bool has_truth = false;
    bool orientation_known = true;
    bool has_pose = false;  ///< false: none came, or it was lost
    bool has_command = false;
    hw_pose_t T_map_body{};
    std::array<double, 3> command{};  ///< linear, angular, lateral
  };

  std::filesystem::path folder_;
  SpillList<Frame> frames_;
};

}  // namespace hallway::run
