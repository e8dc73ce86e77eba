// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "planes/cloud.hpp"
#include "planes/finder.hpp"
#include "planes/score.hpp"

namespace hallway::planes {

/// Planes as documents have them: id, normal, offset, centroid, corners, points, rms, exclusive_share, hull, members (rows of the cloud's file, from 0).
nlohmann::ordered_json planes_json(const Cloud& cloud, const std::vector<PlaneObservation>& found);

/// A score as documents have it (docs/metrics.md); planes are named by their label and, the found ones, by their place in the list, from 0.
nlohmann::ordered_json score_json(const Score& score, const Truth& truth);

/// Scores of several clouds in one: numbers of planes and faults are sums, errors are over all pairs.
nlohmann::ordered_json scores_json(const std::vector<Score>& scores);

/// The points as binary little-endian PLY: x, y, z (double), red, green, blue (uchar), plane (int: place in the list, -1 for none).
std::string print_ply(const Cloud& cloud, const std::vector<PlaneObservation>& found);

/// For each point the place of the first plane that has it, or -1.
std::vector<std::int64_t> plane_of_points(std::size_t points, const std::vector<PlaneObservation>& found);

/// A fault in a few words: "missing 7", "merged 3+5", "stolen 40 of 3".
std::string fault_text(const Fault& fault, const Truth& truth);

}  // namespace hallway::planes
