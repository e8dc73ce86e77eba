// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "import/recording.hpp"

namespace hallway::import {

struct VictoriaParkOptions {
  std::int64_t truth_within_ns =
      200'000'000;  ///< how far from a scan a satellite fix may lie (true_track.hpp)
};

/// The trees of the Victoria Park data set as a recording: a frame for each line of `scans.csv` (scan,t_s,n_trees), whose points are the scan's lines
/// of `observations.csv` (scan,t_s,range_m,bearing_rad) in the frame of the laser, z = 0; and positions from `gps.csv`
/// (t_s,east_lo_m,north_la_m), if it is there, which are those of the antenna. Throws Error{kBadInput} with file and line, also where the two tables do
/// not have the same trees, and Error{kIo}.
std::unique_ptr<Recording> open_victoria_park(const std::filesystem::path& folder,
                                              const VictoriaParkOptions& options);

}  // namespace hallway::import
