// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "editor/commands/making.hpp"

namespace hallway::editor {

// What each command of the topic "shapes" makes of its arguments. All throw Error{kUsage} for what makes no body. Places are metres in the
// arguments, map units in the parts.
Parts box_parts(const Edit& edit, const Arguments& arguments);
Parts wedge_parts(const Edit& edit, const Arguments& arguments);
Parts cylinder_parts(const Edit& edit, const Arguments& arguments);
Parts prism_parts(const Edit& edit, const Arguments& arguments);
Parts wall_parts(const Edit& edit, const Arguments& arguments);
Parts arc_parts(const Edit& edit, const Arguments& arguments);
Parts room_parts(const Edit& edit, const Arguments& arguments);
Parts stairs_parts(const Edit& edit, const Arguments& arguments);
Parts ramp_parts(const Edit& edit, const Arguments& arguments);
Parts terrain_parts(const Edit& edit, const Arguments& arguments);

/// A stretch of wall: its plan between its two ends, map units.
struct WallStretch {
  Vec3 from = Vec3::Zero();     ///< on the middle line, at the foot
  Vec3 to = Vec3::Zero();       ///< at the height of `from`
  std::vector<Vec3> outline{};  ///< counter-clockwise from above, at the foot
};

/// The stretches of an `arc`, in the order of its angles; neighbours share the two corners where they meet.
std::vector<WallStretch> arc_stretches(const Edit& edit, const Arguments& arguments);
/// The one stretch of a `wall`.
WallStretch wall_stretch(const Edit& edit, const Arguments& arguments);

/// The inside of a `room`, map units.
Box room_inside(const Edit& edit, const Arguments& arguments);

}  // namespace hallway::editor
