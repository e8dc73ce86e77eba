// SPDX-License-Identifier: MIT
#include "em/core/point_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hallway::em {
namespace {

constexpr std::uint32_t kLeafPoints = 16;

double squared_distance_to_box(const Vec3& p, const Vec3& middle, const Vec3& half) {
  return ((p - middle).cwiseAbs() - half).cwiseMax(0.0).squaredNorm();
}

}  // namespace

bool OrientedBox::touches(const Vec3& middle, const Vec3& half_sides) const {
  const Vec3 d = middle - centre;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double reach = half[static_cast<Eigen::Index>(i)] + axes[i].cwiseAbs().dot(half_sides);
    // A little more than touching, lest rounding shut out what contains() lets in.
    if (std::abs(axes[i].dot(d)) > reach * (1.0 + 1e-9)) return false;
  }
  return true;
}

PointTree::PointTree(std::span<const Vec3> points) : points_(points), order_(points.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (!points.empty()) build(0, static_cast<std::uint32_t>(points.size()));
}

void PointTree::measure(Node& node) const {
  Vec3 low = points_[order_[node.begin]];
  Vec3 high = low;
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    low = low.cwiseMin(points_[order_[i]]);
    high = high.cwiseMax(points_[order_[i]]);
  }
  node.middle = 0.5 * (low + high);
  node.half = (high - node.middle).cwiseMax(node.middle - low);
}

std::uint32_t PointTree::build(std::uint32_t begin, std::uint32_t end) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node node;
  node.begin = begin;
  node.end = end;
  measure(node);
  nodes_.push_back(node);
  if (end - begin <= kLeafPoints) return index;
  Eigen::Index axis = 0;
  node.half.maxCoeff(&axis);
  const std::uint32_t split = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + split, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return points_[a][axis] != points_[b][axis] ? points_[a][axis] < points_[b][axis]
                                                                 : a < b;
                   });
  const std::uint32_t left = build(begin, split);
  const std::uint32_t right = build(split, end);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

std::vector<Neighbour> PointTree::nearest(const Vec3& p, std::size_t count) const {
  std::vector<Neighbour> heap;
  if (!nodes_.empty() && count > 0) search(0, p, count, heap);
  std::sort_heap(heap.begin(), heap.end());
  return heap;
}

void PointTree::search(std::uint32_t index, const Vec3& p, std::size_t count,
                       std::vector<Neighbour>& heap) const {
  const Node& node = nodes_[index];
  if (heap.size() == count &&
      squared_distance_to_box(p, node.middle, node.half) > heap.front().squared_distance * (1.0 + 1e-9)) {
    return;
  }
  if (node.left == 0) {
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const Neighbour candidate{(points_[order_[i]] - p).squaredNorm(), order_[i]};
      if (heap.size() == count && !(candidate < heap.front())) continue;
      if (heap.size() == count) {
        std::pop_heap(heap.begin(), heap.end());
        heap.pop_back();
      }
      heap.push_back(candidate);
      std::push_heap(heap.begin(), heap.end());
    }
    return;
  }
  const Node& left = nodes_[node.left];
  const Node& right = nodes_[node.right];
  const bool left_first = squared_distance_to_box(p, left.middle, left.half) <=
                          squared_distance_to_box(p, right.middle, right.half);
  search(left_first ? node.left : node.right, p, count, heap);
  search(left_first ? node.right : node.left, p, count, heap);
}

std::vector<std::uint32_t> PointTree::within(const OrientedBox& box) const {
  std::vector<std::uint32_t> found;
  if (!nodes_.empty()) collect(0, box, found);
  std::sort(found.begin(), found.end());
  return found;
}

void PointTree::collect(std::uint32_t index, const OrientedBox& box,
                        std::vector<std::uint32_t>& found) const {
  const Node& node = nodes_[index];
  if (!box.touches(node.middle, node.half)) return;
  if (node.left != 0) {
    collect(node.left, box, found);
    collect(node.right, box, found);
    return;
  }
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    if (box.contains(points_[order_[i]])) found.push_back(order_[i]);
  }
}

}  // namespace hallway::em
