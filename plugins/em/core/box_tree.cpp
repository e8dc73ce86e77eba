// SPDX-License-Identifier: MIT
#include "em/core/box_tree.hpp"

namespace hallway::em {
namespace {

Box box_of(const Vec3& low, const Vec3& high) {
  return {0.5 * (low + high), 0.5 * (high - low)};
}

Box around_points(const Points& points, std::size_t begin, std::size_t end) {
  Vec3 low = points.at(begin);
  Vec3 high = low;
  for (std::size_t i = begin + 1; i < end; ++i) {
    low = low.cwiseMin(points.at(i));
    high = high.cwiseMax(points.at(i));
  }
  return box_of(low, high);
}

Box around_boxes(const std::vector<Box>& boxes, std::size_t begin, std::size_t end) {
  Vec3 low = boxes[begin].middle - boxes[begin].half;
  Vec3 high = boxes[begin].middle + boxes[begin].half;
  for (std::size_t i = begin + 1; i < end; ++i) {
    low = low.cwiseMin(boxes[i].middle - boxes[i].half);
    high = high.cwiseMax(boxes[i].middle + boxes[i].half);
  }
  return box_of(low, high);
}

}  // namespace

BoxTree::BoxTree(const Points& points, Workers& workers) {
  if (points.count == 0) return;
  static_assert(Workers::kPart % kBlockSize == 0);
  std::vector<Box> blocks(points.blocks());
  workers.run_parts(points.count, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t begin = first; begin < last; begin += kBlockSize) {
      blocks[begin / kBlockSize] = around_points(points, begin, std::min(begin + kBlockSize, last));
    }
  });
  levels_.push_back(std::move(blocks));
  while (levels_.back().size() > kFan) {
    const std::vector<Box>& below = levels_.back();
    std::vector<Box> level;
    for (std::size_t begin = 0; begin < below.size(); begin += kFan) {
      level.push_back(around_boxes(below, begin, std::min(begin + kFan, below.size())));
    }
    levels_.push_back(std::move(level));
  }
}

}  // namespace hallway::em
