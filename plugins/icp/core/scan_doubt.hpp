// SPDX-License-Identifier: MIT
#pragma once

#include "icp/core/screw.hpp"

namespace hallway::icp {

/// What sensors of motion tell of it: nothing of ways, those on level ground, or all.
enum class Measured { nothing, level, all };

/// What a registration's own covariance knows nothing of: that the scanner moved within the scan otherwise than the scan was deskewed by. Covariances to add, of errors as in ScanFit.
/// The shares are bounds found on simulated scans, not derived.

/// Of a velocity that was wrong by so much over the scan. @param wrong  way, then turn, in the scanner's frame [m, rad]
/// @param turns  whether the turn counts; not where gyroscopes told it
Mat6 doubt_of_velocity(const Quat& q_map_scanner, const Vec6& wrong, bool turns);

/// Of a velocity that changed by so much since the scan before, so that it was hardly steady within this one.
Mat6 doubt_of_change(const Quat& q_map_scanner, const Vec6& changed, bool turns);

/// Of a scan that is registered as measured. @param motion  over the scan: as registered, which is short of it where skew hides a turn, and as predicted
Mat6 doubt_of_skew(const Pose& motion);

/// Of surfels that fit nothing where they usually do: a motion that was not steady, or a place that is another. @param overlap  shares of surfels that fit, now and usually
/// @param measured  of the motion within the scan: the more, the less a small loss tells
Mat6 doubt_of_overlap(double overlap, double usual, Measured measured, bool turns);

}  // namespace hallway::icp
