// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "bsp/build_options.hpp"
#include "geom/facet.hpp"

namespace hallway::bsp {

/// What a facet does to the tree.
enum class FacetKind : std::uint8_t {
  kStructure,  ///< bounds the structure: divides space first
  kHint,       ///< bounds nothing: divides space with the structure
  kSurface,    ///< bounds the whole world, detail included: divides what the structure leaves
};

/// The polygon of a facet that belongs to none.
inline constexpr std::uint32_t kNoPolygon = ~0u;

/// A facet that the tree is made from; map units.
struct TreeFacet {
  Facet facet;
  std::uint32_t polygon =
      0;  ///< of kSurface, or kStructure alone: index in csg::Surface::polygons, or kNoPolygon
  FacetKind kind = FacetKind::kStructure;
  bool flipped = false;  ///< the empty side is behind the facet's plane
};

enum class Label : std::uint8_t { kUnknown, kEmpty, kSolid };

struct ExactNode {
  std::uint32_t plane = 0;              ///< in the PlaneSet
  std::array<std::int32_t, 2> child{};  ///< in front, behind; at least 0: node, negative: leaf ~child
  std::int32_t cell = -1;               ///< its number, where it is the root of a cell
};

struct ExactLeaf {
  std::uint32_t cell = 0;
  Label label = Label::kUnknown;
  std::vector<TreeFacet> surface;  ///< pieces that bound it, it being on their empty side
};

/// A region that the structure does not divide: a leaf, or a subtree whose planes are those of detail.
struct Cell {
  std::int32_t root = 0;  ///< node, or ~leaf
  Label label = Label::kUnknown;
  std::vector<TreeFacet> structure;  ///< pieces of structure that bound it, it being on their empty side
};

/// A tree in exact form. Labels are set where a facet tells them; the others are found through portals.
struct ExactTree {
  std::vector<ExactNode> nodes;
  std::vector<ExactLeaf> leaves;
  std::vector<Cell> cells;

  std::int32_t root() const { return nodes.empty() ? ~0 : 0; }
};

/// Builds the tree. The kStructure facets must be the whole boundary of a solid, and so must the kSurface facets, whose planes divide cells
/// only. If `structure_is_surface`, as in a world without detail, there are none of them: the kStructure facets are
/// the surface too. O(n log n) for n facets that divide evenly; deterministic.
ExactTree build_tree(const PlaneSet& planes, std::vector<TreeFacet> facets, bool structure_is_surface,
                     const BuildOptions& options);

/// The leaf that holds a point given in map units. O(depth).
std::uint32_t leaf_at(const PlaneSet& planes, const ExactTree& tree, const Vec3& point);

}  // namespace hallway::bsp
