// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "editor/state.hpp"

namespace hallway::editor {

/// A place that a thing has: a corner, the middle of a side, an end.
struct Anchor {
  std::string_view name{};
  std::string_view help{};
};

/// All anchors, in the order in which help lists them.
std::span<const Anchor> anchors();

/// The names of anchors with commas between them, for help and messages.
std::string anchor_names();

/// The place, metres, that an anchor of a thing means: `NAME.ANCHOR`, as it is typed behind `@`. NAME is a name or a number as WHAT has it; it may
/// contain dots. Corners and sides are those of the upright box around the thing, at its foot; of a `room`, those of its inside; all are the
/// origin where the thing has no extent. `start` and `end` are those of a `wall`, `arc`, `stairs`, `ramp` or path.
/// Throws Error{kUsage} for an unknown name (with the nearest one), an unknown anchor (with the list), and a thing that has no such place.
Vec3 anchor_place(const State& state, std::string_view text);

}  // namespace hallway::editor
