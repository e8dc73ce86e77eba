// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "eval/path_parts.hpp"
#include "host/output/outputs.hpp"

namespace hallway::run {

/// The parts of the map that a report says to be joined, for the evaluation, which knows no plugins; none for no report. `first`: what the plugin's
/// part 0 is called there.
inline std::vector<eval::JoinedEpoch> joined_epochs_of(const host::Outputs* report, std::uint64_t first = 0) {
  std::vector<eval::JoinedEpoch> joined;
  if (report == nullptr) return joined;
  for (const host::JoinedEpoch& one : report->joined_epochs())
    joined.push_back({first + one.epoch, first + one.into});
  return joined;
}

}  // namespace hallway::run
