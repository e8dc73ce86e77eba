// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "eval/metrics.hpp"
#include "link/messages.hpp"
#include "run/sources/source.hpp"

namespace hallway::run {

/// The poses that a robot program answered, and how near they come to the true ones. Memory grows with the frames.
class ServedPath {
 public:
  /// The next frame that was sent.
  void add_frame(const SourceFrame& frame);
  /// An answer to a frame that was sent. Of several to one frame the last counts.
  void add_answer(const link::Answer& answer);

  /// Writes trajectory.tum and metrics.json, as a run has them. The metrics are of the path alone: no map comes back, and no
  /// associations. Throws Error{kIo}. @return the metrics
  /// @param drive  of a robot that obeyed
  eval::Metrics write(const std::filesystem::path& folder, const Source& source,
                      const std::optional<sim::DriveCounts>& drive) const;

 private:
  struct Frame {
    std::int64_t t_ns = 0;
    std::optional<Pose> T_world_body;
    bool orientation_known = true;
  };

  std::vector<Frame> frames_;
  std::map<std::size_t, hw_pose_t> poses_;  ///< T_map_body, by frame; none where it was lost
};

}  // namespace hallway::run
