// SPDX-License-Identifier: MIT
#include "slam_point/core/index/overlap_tree.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::slam_point {
namespace {

constexpr double kStrayShare = 0.125;  // of the reach: moves up to here leave a point in its leaves
constexpr std::size_t kLeafPoints = 8;
constexpr double kFirstHalfReaches = 64.0;
constexpr double kLargestReaches = 1e9;

}  // namespace

template <int Dimensions>
OverlapTree<Dimensions>::OverlapTree(double reach_m)
    : overlap_((1.0 + kStrayShare) * reach_m),
      slack2_(kStrayShare * kStrayShare * reach_m * reach_m),
      largest_(kLargestReaches * reach_m),
      root_{Vec3::Zero(), kFirstHalfReaches * reach_m} {}

template <int Dimensions>
void OverlapTree<Dimensions>::add(const Vec3& p) {
  const auto i = static_cast<std::uint32_t>(put_.size());
  put_.push_back(clamped(p));
  if (nodes_.empty()) nodes_.emplace_back();
  put(i);
}

template <int Dimensions>
void OverlapTree<Dimensions>::move(std::uint32_t i, const Vec3& p) {
  const Vec3 to = clamped(p);
  if ((to - put_[i]).squaredNorm() <= slack2_) return;
  erase(0, root_, i);
  put_[i] = to;
  put(i);
}

template <int Dimensions>
void OverlapTree<Dimensions>::remove(std::uint32_t i) {
  erase(0, root_, i);
  put_[i].setConstant(std::numeric_limits<double>::quiet_NaN());
}

template <int Dimensions>
void OverlapTree<Dimensions>::clear() {
  nodes_.clear();
  put_.clear();
}

template <int Dimensions>
typename OverlapTree<Dimensions>::Cell OverlapTree<Dimensions>::child_of(const Cell& cell,
                                                                         std::uint32_t child) {
  Cell result{cell.centre, 0.5 * cell.half};
  for (int axis = 0; axis < Dimensions; ++axis)
    result.centre[axis] += ((child >> axis) & 1u) != 0 ? result.half : -result.half;
  return result;
}

template <int Dimensions>
Vec3 OverlapTree<Dimensions>::clamped(const Vec3& p) const {
  return p.cwiseMin(Vec3::Constant(largest_)).cwiseMax(Vec3::Constant(-largest_));
}

template <int Dimensions>
bool OverlapTree<Dimensions>::holds(const Cell& cell, const Vec3& p) const {
  const double least = cell.half + overlap_;
  for (int axis = 0; axis < Dimensions; ++axis) {
    if (std::abs(p[axis] - cell.centre[axis]) > least) return false;
  }
  return true;
}

template <int Dimensions>
std::uint32_t OverlapTree<Dimensions>::leaf_of(const Vec3& p) const {
  // A place outside of the root has the same neighbours as the place of the root that is nearest to it, or fewer.
  std::uint32_t node = 0;
  Vec3 centre = root_.centre;
  double half = root_.half;
  while (nodes_[node].first_child != kNoChildren) {
    half *= 0.5;
    std::uint32_t child = 0;
    for (int axis = 0; axis < Dimensions; ++axis) {
      const bool high = p[axis] >= centre[axis];
      child |= (high ? 1u : 0u) << axis;
      centre[axis] += high ? half : -half;
    }
    node = nodes_[node].first_child + child;
  }
  return node;
}

template <int Dimensions>
void OverlapTree<Dimensions>::put(std::uint32_t i) {
  const double farthest = put_[i].template head<Dimensions>().cwiseAbs().maxCoeff();
  if (farthest <= root_.half) return insert(0, root_, i);
  while (root_.half < farthest) root_.half *= 2.0;
  nodes_.assign(1, Node{});
  for (std::uint32_t each = 0; each < put_.size(); ++each) {
    if (!std::isnan(put_[each].x())) insert(0, root_, each);
  }
}

template <int Dimensions>
void OverlapTree<Dimensions>::insert(std::uint32_t node, const Cell& cell, std::uint32_t i) {
  const std::uint32_t first_child = nodes_[node].first_child;
  if (first_child == kNoChildren) {
    nodes_[node].points.push_back(i);
    if (nodes_[node].points.size() > kLeafPoints && cell.half > overlap_) split(node, cell);
    return;
  }
  for (std::uint32_t child = 0; child < kChildren; ++child) {
    const Cell inner = child_of(cell, child);
    if (holds(inner, put_[i])) insert(first_child + child, inner, i);
  }
}

template <int Dimensions>
void OverlapTree<Dimensions>::erase(std::uint32_t node, const Cell& cell, std::uint32_t i) {
  const std::uint32_t first_child = nodes_[node].first_child;
  if (first_child == kNoChildren) {
    std::erase(nodes_[node].points, i);
    return;
  }
  for (std::uint32_t child = 0; child < kChildren; ++child) {
    const Cell inner = child_of(cell, child);
    if (holds(inner, put_[i])) erase(first_child + child, inner, i);
  }
}

template <int Dimensions>
void OverlapTree<Dimensions>::split(std::uint32_t node, const Cell& cell) {
  const auto first_child = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + kChildren);
  const std::vector<std::uint32_t> points = std::move(nodes_[node].points);
  nodes_[node].points = {};
  nodes_[node].first_child = first_child;
  for (std::uint32_t child = 0; child < kChildren; ++child) {
    const Cell inner = child_of(cell, child);
    for (const std::uint32_t i : points) {
      if (holds(inner, put_[i])) nodes_[first_child + child].points.push_back(i);
    }
  }
}

template class OverlapTree<2>;
template class OverlapTree<3>;

}  // namespace hallway::slam_point
