// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "bsp/tree.hpp"
#include "geom/polygon.hpp"

namespace hallway::render {

/// What of a face bounds one leaf.
struct LeafPiece {
  std::uint32_t leaf = 0;
  Polygon polygon{};
};

/// Divides a face of a world's boundary by the tree: each piece bounds the leaf that lies before it, on the side that its normal points
/// to. Exact to about a micrometre, which is enough for pictures. O(pieces x depth).
std::vector<LeafPiece> leaf_pieces(const bsp::Tree& tree, const Polygon& face);

/// For each leaf of a tree the number of nodes above it.
std::vector<std::uint32_t> leaf_depths(const bsp::Tree& tree);

}  // namespace hallway::render
