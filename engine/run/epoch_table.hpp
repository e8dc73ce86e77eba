// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "eval/path_parts.hpp"
#include "host/outputs.hpp"
#include "log/tum.hpp"

namespace hallway::run {

/// map_epochs.csv of a run folder: which part of the map each pose is in, a row for each row of trajectory.tum. It is written where there are several parts.
class EpochTable {
 public:
  /// The answer to a frame; iterations increase.
  void add(std::uint32_t iteration, const host::Outputs& outputs);
  /// Throws Error{kIo}.
  void write(const std::filesystem::path& folder, std::span<const eval::JoinedEpoch> joined) const;

 private:
  struct Row {
    std::uint32_t iteration = 0;
    std::uint64_t epoch = 0;
  };
  std::vector<Row> rows_;
};

/// Takes the poses out of a run's trajectory that are not in the part with the most poses, of equal ones the first; none where the folder has no map_epochs.csv.
/// @return how many. Throws Error{kBadInput} where the table does not belong to the trajectory, Error{kIo}.
std::size_t keep_scored_part(const std::filesystem::path& folder, std::vector<log::StampedPose>& trajectory);

}  // namespace hallway::run
