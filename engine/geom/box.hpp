// SPDX-License-Identifier: MIT
#pragma once

#include "geom/pose.hpp"

namespace hallway {

/// An axis-aligned box in metres; empty (low above high) until extended.
using Box = Eigen::AlignedBox3d;

}  // namespace hallway
