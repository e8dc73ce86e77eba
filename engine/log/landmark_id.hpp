// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace hallway::log {

/// A landmark's number: of a true landmark, or of one that a plugin keeps. The two are unrelated.
using LandmarkId = std::uint64_t;

/// "No landmark": an observation whose truth is unknown or is none, or that a plugin took for none. Written as -1.
inline constexpr LandmarkId kNoLandmark = ~LandmarkId{0};

}  // namespace hallway::log
