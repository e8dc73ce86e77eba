// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/se3.hpp"

namespace hallway {

/// An axis-aligned box in metres; empty (low above high) until extended.
using Box = Eigen::AlignedBox3d;

}  // namespace hallway
