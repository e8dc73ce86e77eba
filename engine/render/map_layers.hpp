// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "bsp/enclosure.hpp"
#include "bsp/portal_graph.hpp"
#include "bsp/tree.hpp"
#include "csg/surface.hpp"
#include "render/map_surfaces.hpp"
#include "render/picture.hpp"

namespace hallway::render {

/// The openings between clusters as glassy areas.
void add_portals(Picture& picture, const bsp::PortalGraph& portals);

/// The way from an occupant into the void as a bold line, with its narrowest opening.
/// @param occupant  what the label at its beginning says
void add_leak(Picture& picture, const bsp::Leak& leak, const std::string& occupant);

/// The edges of a world's faces as thin lines, each once.
/// @param inside  for each polygon whether it is one of those that Faces::kInside shows
void add_wireframe(Picture& picture, const csg::Surface& surface, const std::vector<bool>& inside,
                   Faces faces);

/// Colours that tell seen leaves (light) from hidden ones (dark), and what they mean in the legend.
/// @param seen  for each cluster whether it may be seen
LeafColour sight_colours(const bsp::Tree& tree, const std::vector<bool>& seen);
void add_sight_legend(Picture& picture, const std::vector<bool>& seen);

/// Colours of leaves by the number of nodes above them, and the same in the legend.
LeafColour depth_colours(const bsp::Tree& tree);
void add_depth_legend(Picture& picture, const bsp::Tree& tree);

/// A length as a message says it: "1.25 m", below 10 cm "12.0 mm".
std::string measure_text(double metres);

}  // namespace hallway::render
