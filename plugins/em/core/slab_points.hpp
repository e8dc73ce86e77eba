// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "em/core/box_tree.hpp"
#include "em/core/points.hpp"

namespace hallway::em {

/// Points with what a query wants to know of them and where they are.
struct PointField {
  const Points& points;
  const BoxTree& tree;
};

/// The points inside of a slab, in its frame.
struct SlabPoints {
  std::vector<std::uint32_t> place;  ///< in the list of points, ascending
  std::vector<double> a, b, height;  ///< coordinates in the frame, the last one signed

  std::size_t size() const { return place.size(); }
  void resize(std::size_t count) {
    place.resize(count);
    a.resize(count);
    b.resize(count);
    height.resize(count);
  }
};

/// Replaces `found` by the points of `field` inside of `slab`.
void collect(const PointField& field, const Slab& slab, SlabPoints& found);

/// As collect(), in a chunk of the points alone (BoxTree::visit_chunk()).
void collect_chunk(const PointField& field, std::size_t chunk, const Slab& slab, SlabPoints& found);

}  // namespace hallway::em
