// SPDX-License-Identifier: MIT
#pragma once

#include "study/plan.hpp"

namespace hallway::cli {

/// How slam_point bins points, for the study `binning`.
study::BinPoints slam_point_binning();

}  // namespace hallway::cli
