// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "icp/core/align.hpp"

namespace hallway::cli {

/// A cloud as it was read.
struct AlignedCloud {
  std::string file{};  ///< for people
  icp::Points points{};
  std::uint64_t not_finite = 0;  ///< points that were left out
};

/// The pose of x, y, z in metres and yaw, pitch, roll in degrees (turns about z, then the new y, then the new x).
Pose pose_of(const std::array<double, 6>& values);
/// The inverse of pose_of(); pitch in [-90, 90].
std::array<double, 6> values_of(const Pose& pose);

/// What `hallway align` prints.
std::string alignment_text(const AlignedCloud& a, const AlignedCloud& b, const icp::Alignment& found);
/// The same as a document, hallway.align/1.
nlohmann::ordered_json to_json(const AlignedCloud& a, const AlignedCloud& b, const icp::Alignment& found,
                               const std::string& method, const std::string& weights);

/// All points of `b`, moved to fit `a`, as a PLY file.
std::string print_moved_ply(const AlignedCloud& b, const icp::Alignment& found);
/// Both clouds from above, as a PNG file.
std::string draw_alignment(const AlignedCloud& a, const AlignedCloud& b, const icp::Alignment& found);

}  // namespace hallway::cli
