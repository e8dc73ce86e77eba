// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "log/drawing.hpp"
#include "log/topology.hpp"
#include "watch/layers.hpp"

namespace hallway::watch {

/// The character of a place in a topological map; of each kind another one.
char32_t glyph_of(log::PlaceKind kind, Dots dots);

/// "12 nodes, loop closed".
std::string topology_text(const log::Topology& topology);

/// The texts of a drawing, with commas between them, at most 60 characters: plugins write what they do beside the robot.
std::string drawn_text(const log::Drawing& drawing);

/// Draws the topological map that holds at the moment: edges as lines, places as glyph_of(), steps of the wall as lines of their size within limits. A place
/// is where the robot was at the node's time (Past::place_of()); what has none is left out with its edges. O(nodes + edges + dots).
void draw_topology(const Subject& subject, const Drawing& drawing);

/// Draws what the plugin shows of itself at the moment, in the body's frame of the robot that is shown. Texts are cells from their place to the right,
/// or from beside the robot where the robot would cover a part of them.
void draw_drawing(const Subject& subject, const Drawing& drawing);

}  // namespace hallway::watch
