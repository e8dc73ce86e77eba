// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "host/outputs.hpp"
#include "log/id_pairs.hpp"
#include "log/map_landmarks.hpp"

namespace hallway::record {

/// A pipeline's map, copied out of buffers that the next call uses again.
struct FinalMap {
  std::vector<log::MapLandmark> landmarks;
  std::vector<log::IdPair> submap_members;  ///< submap, landmark
  std::uint64_t submaps = 0;
};

/// @param report  what the pipeline put in report(), or null: nothing is known of the map
FinalMap copy_map(const host::Outputs* report);

/// Writes landmarks.csv, landmarks.ply and submaps.csv into a folder. Throws Error{kIo}.
void write_map(const std::filesystem::path& folder, const FinalMap& map);

}  // namespace hallway::record
