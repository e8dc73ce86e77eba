// SPDX-License-Identifier: MIT
#include "slam_point/core/index/kd_tree.hpp"

#include <algorithm>
#include <tuple>

namespace hallway::slam_point {
namespace {

constexpr double kStrayReaches = 0.125;  // moves up to here leave a point in its leaf
constexpr std::size_t kBucketPoints = 8;
constexpr double kLopsidedShare = 0.7;

}  // namespace

KdTree::KdTree(double reach_m)
    : reach_((1.0 + kStrayReaches) * reach_m), slack2_(kStrayReaches * kStrayReaches * reach_m * reach_m) {}

void KdTree::add(const Vec3& p) {
  const auto i = static_cast<std::uint32_t>(put_.size());
  put_.push_back(p);
  leaf_.push_back(kNone);
  if (nodes_.empty()) make_node(kNone);
  insert(i);
}

void KdTree::move(std::uint32_t i, const Vec3& p) {
  if ((p - put_[i]).squaredNorm() <= slack2_) return;
  erase(i);
  put_[i] = p;
  insert(i);
}

void KdTree::remove(std::uint32_t i) {
  erase(i);
  leaf_[i] = kNone;
}

void KdTree::clear() {
  nodes_.clear();
  free_.clear();
  put_.clear();
  leaf_.clear();
}

std::uint32_t KdTree::leaf_of(const Vec3& p) const {
  std::uint32_t n = 0;
  while (nodes_[n].low != kNone) n = p[nodes_[n].axis] <= nodes_[n].border ? nodes_[n].low : nodes_[n].high;
  return n;
}

void KdTree::insert(std::uint32_t i) {
  const std::uint32_t leaf = leaf_of(put_[i]);
  nodes_[leaf].points.push_back(i);
  leaf_[i] = leaf;
  count(leaf, 1);
  if (nodes_[leaf].points.size() <= kBucketPoints) return;
  rebuild(leaf);
  const std::uint32_t lopsided = lopsided_above(leaf);
  if (lopsided != kNone) rebuild(lopsided);
}

void KdTree::erase(std::uint32_t i) {
  std::erase(nodes_[leaf_[i]].points, i);
  count(leaf_[i], -1);
}

void KdTree::count(std::uint32_t leaf, std::int32_t change) {
  for (std::uint32_t n = leaf; n != kNone; n = nodes_[n].parent)
    nodes_[n].count = static_cast<std::uint32_t>(static_cast<std::int32_t>(nodes_[n].count) + change);
}

std::uint32_t KdTree::lopsided_above(std::uint32_t leaf) const {
  std::uint32_t highest = kNone;
  for (std::uint32_t n = nodes_[leaf].parent; n != kNone; n = nodes_[n].parent) {
    const std::uint32_t larger = std::max(nodes_[nodes_[n].low].count, nodes_[nodes_[n].high].count);
    if (larger > kLopsidedShare * nodes_[n].count + kBucketPoints) highest = n;
  }
  return highest;
}

void KdTree::rebuild(std::uint32_t n) {
  std::vector<std::uint32_t> points;
  collect(n, points);
  build(n, points.data(), points.data() + points.size());
}

/// Takes all points from below a node, and the nodes below it away.
void KdTree::collect(std::uint32_t n, std::vector<std::uint32_t>& points) {
  points.insert(points.end(), nodes_[n].points.begin(), nodes_[n].points.end());
  nodes_[n].points.clear();
  for (const std::uint32_t child : {nodes_[n].low, nodes_[n].high}) {
    if (child == kNone) continue;
    collect(child, points);
    free_.push_back(child);
  }
  nodes_[n].low = nodes_[n].high = kNone;
}

void KdTree::build(std::uint32_t n, std::uint32_t* begin, std::uint32_t* end) {
  nodes_[n].count = static_cast<std::uint32_t>(end - begin);
  Vec3 low = Vec3::Zero();
  Vec3 high = Vec3::Zero();
  if (begin != end) low = high = put_[*begin];
  for (const std::uint32_t* i = begin; i != end; ++i) {
    low = low.cwiseMin(put_[*i]);
    high = high.cwiseMax(put_[*i]);
  }
  int axis = 0;
  const double width = (high - low).maxCoeff(&axis);
  if (end - begin <= static_cast<std::ptrdiff_t>(kBucketPoints) || !(width > 0.0)) {
    nodes_[n].points.assign(begin, end);
    for (const std::uint32_t* i = begin; i != end; ++i) leaf_[*i] = n;
    return;
  }
  std::uint32_t* middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end, [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(put_[a][axis], a) < std::tie(put_[b][axis], b);
  });
  const std::uint32_t below = make_node(n);
  const std::uint32_t above = make_node(n);
  nodes_[n].axis = axis;
  nodes_[n].border = put_[*middle][axis];
  nodes_[n].low = below;
  nodes_[n].high = above;
  build(below, begin, middle);
  build(above, middle, end);
}

std::uint32_t KdTree::make_node(std::uint32_t parent) {
  std::uint32_t n = static_cast<std::uint32_t>(nodes_.size());
  if (free_.empty()) {
    nodes_.emplace_back();
  } else {
    n = free_.back();
    free_.pop_back();
    nodes_[n] = Node{};
  }
  nodes_[n].parent = parent;
  return n;
}

}  // namespace hallway::slam_point
