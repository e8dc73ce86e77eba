// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "host/output/outputs.hpp"
#include "log/map_answer.hpp"

namespace hallway::record {

/// A pipeline's map, copied out of buffers that the next call uses again.
using FinalMap = log::MapAnswer;

/// @param report  what the pipeline put in report(), or null: nothing is known of the map
FinalMap copy_map(const host::Outputs* report);

/// Writes landmarks.csv, landmarks.ply and submaps.csv into a folder; also mapped_planes.csv, submap_poses.csv, topology.json and topology.graphml where the map has such. Throws
/// Error{kIo}.
void write_map(const std::filesystem::path& folder, const FinalMap& map);

}  // namespace hallway::record
