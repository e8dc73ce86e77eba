// SPDX-License-Identifier: MIT
#include "geom/box_tree.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace hallway {

BoxTree::BoxTree(const std::vector<Box>& boxes) {
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (!boxes[i].isEmpty()) items_.push_back(i);
  }
  if (!items_.empty()) build(boxes, 0, static_cast<std::uint32_t>(items_.size()));
  for (const std::uint32_t item : items_) boxes_.push_back(boxes[item]);
}

void BoxTree::build(const std::vector<Box>& boxes, std::uint32_t first, std::uint32_t last) {
  constexpr std::uint32_t kLeaf = 4;
  const std::size_t node = nodes_.size();
  nodes_.push_back({Box(), first, last - first, 0});
  Box centres;
  for (std::uint32_t i = first; i < last; ++i) {
    nodes_[node].box.extend(boxes[items_[i]]);
    centres.extend(Vec3(boxes[items_[i]].center()));
  }
  if (last - first <= kLeaf) return;
  Eigen::Index axis = 0;
  centres.sizes().maxCoeff(&axis);
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(items_.begin() + first, items_.begin() + middle, items_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const auto key = [&](std::uint32_t i) {
                       return std::pair(boxes[i].min()[axis] + boxes[i].max()[axis], i);
                     };
                     return key(a) < key(b);
                   });
  nodes_[node].count = 0;
  build(boxes, first, middle);
  nodes_[node].right = static_cast<std::uint32_t>(nodes_.size());
  build(boxes, middle, last);
}

void BoxTree::find(const Box& box, std::vector<std::uint32_t>& found) const {
  found.clear();
  std::array<std::uint32_t, 64> open;  // halves of halves: never deeper than 32
  std::size_t count = 0;
  if (!nodes_.empty()) open[count++] = 0;
  while (count > 0) {
    const std::uint32_t at = open[--count];
    const Node& node = nodes_[at];
    if (!node.box.intersects(box)) continue;
    if (node.count == 0) {
      open[count++] = node.right;
      open[count++] = at + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (boxes_[i].intersects(box)) found.push_back(items_[i]);
    }
  }
  std::sort(found.begin(), found.end());
}

}  // namespace hallway
