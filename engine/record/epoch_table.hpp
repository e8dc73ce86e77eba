// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "base/spill_list.hpp"
#include "host/output/outputs.hpp"
#include "log/id_pairs.hpp"
#include "log/tum.hpp"

namespace hallway::record {

/// Which part of the map each pose is in, over all instances of the plugins: one that is started anew counts its parts from 0 again, and no part of it
/// is one of an earlier instance. Written as map_epochs.csv of a run folder, a row for each row of trajectory.tum, where there are several parts.
class EpochTable {
 public:
  /// @param folder  see SpillList, as all that throws
  explicit EpochTable(const std::filesystem::path& folder = {}) : rows_(folder) {}

  /// Takes the answer to a frame; iterations increase. @return the part that its pose is in; empty without a pose
  std::optional<std::uint64_t> add(std::uint32_t iteration, const host::Outputs& outputs);
  /// What is answered from now on is of a new instance with an empty map.
  void restart();
  /// The number here of part 0 of the present instance.
  std::uint64_t first() const { return first_; }
  /// @param joined  of the present instance's report, as it numbers them. Throws Error{kIo}.
  void write(const std::filesystem::path& folder, std::span<const log::IdPair> joined) const;

 private:
  struct Row {
    std::uint32_t iteration = 0;
    std::uint64_t epoch = 0;
  };
  SpillList<Row> rows_;
  std::uint64_t first_ = 0;
  std::uint64_t largest_ = 0;
  std::uint64_t own_ = 0;  ///< the present instance's last number
};

/// Takes the poses out of a run's trajectory that are not in the part with the most poses, of equal ones the first; none where the folder has no map_epochs.csv.
/// @return how many. Throws Error{kBadInput} where the table does not belong to the trajectory, Error{kIo}.
std::size_t keep_scored_part(const std::filesystem::path& folder, std::vector<log::StampedPose>& trajectory);

}  // namespace hallway::record
