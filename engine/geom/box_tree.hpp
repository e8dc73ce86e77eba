// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "geom/box.hpp"

namespace hallway {

/// Finds boxes that touch a box in O(log n + found) on average.
class BoxTree {
 public:
  /// Empty boxes are never found. O(n log n).
  explicit BoxTree(const std::vector<Box>& boxes);

  /// Replaces `found` by the indices of the boxes that touch `box`, rising.
  void find(const Box& box, std::vector<std::uint32_t>& found) const;

 private:
  struct Node {
    Box box{};
    std::uint32_t first = 0;  ///< of a leaf: in items_
    std::uint32_t count = 0;  ///< of a leaf: how many; 0 for an inner node
    std::uint32_t right = 0;  ///< of an inner node: its second child; the first follows the node
  };

  void build(const std::vector<Box>& boxes, std::uint32_t first, std::uint32_t last);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> items_;
  std::vector<Box> boxes_;  ///< in the order of items_
};

}  // namespace hallway
