// SPDX-License-Identifier: MIT
#include "sense/landmark_index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>

#include "base/error.hpp"
#include "geometry/morton.hpp"
#include "trace/scene.hpp"

namespace hallway::sense {
namespace {

/// A point this close to a plane of the tree may be on either side of it: rounding of the planes and of the point,
/// metres near the origin, and relative to the point's coordinates far from it.
constexpr double kOnPlane_m = 1e-5;
constexpr double kOnPlane = 1e-12;

void check_landmarks(const std::vector<Vec3>& landmarks) {
  if (landmarks.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::kBadInput, "there are more than 2^32 landmarks");
  }
  for (std::size_t i = 0; i < landmarks.size(); ++i) check_landmark(landmarks[i], i);
}

/// The clusters of all leaves that a point may be in, rising; empty if one of them has no cluster.
std::vector<std::uint32_t> clusters_at(const bsp::Tree& tree, const Vec3& point) {
  const double margin = kOnPlane_m + kOnPlane * point.cwiseAbs().maxCoeff();
  std::vector<std::uint32_t> clusters;
  std::vector<bsp::Child> open{tree.root};
  while (!open.empty()) {
    const bsp::Child at = open.back();
    open.pop_back();
    if (at.is_leaf()) {
      const std::int32_t cluster = tree.leaves[at.index()].cluster;
      if (cluster < 0) return {};
      clusters.push_back(static_cast<std::uint32_t>(cluster));
      continue;
    }
    const bsp::Node& node = tree.nodes[at.index()];
    const double distance = tree.distance(at, point);
    if (distance >= -margin) open.push_back(node.child[0]);
    if (distance <= margin) open.push_back(node.child[1]);
  }
  std::sort(clusters.begin(), clusters.end());
  clusters.erase(std::unique(clusters.begin(), clusters.end()), clusters.end());
  return clusters;
}

/// Places along a Morton curve through the box of some points.
class Curve {
 public:
  explicit Curve(const std::vector<Vec3>& points) {
    Box box;
    for (const Vec3& point : points) box.extend(point);
    if (points.empty()) return;
    low_ = box.min();
    const double size = box.sizes().maxCoeff();
    if (size > 0.0) steps_per_m_ = kSteps / size;
  }

  std::uint64_t place(const Vec3& point) const {
    const auto step = [&](int axis) {
      return static_cast<std::uint64_t>(std::clamp((point[axis] - low_[axis]) * steps_per_m_, 0.0, kSteps));
    };
    return morton_code(step(0), step(1), step(2));
  }

 private:
  static constexpr double kSteps = 2097151.0;  // 2^21 - 1

  Vec3 low_ = Vec3::Zero();
  double steps_per_m_ = 0.0;
};

}  // namespace

void check_landmark(const Vec3& position, std::size_t number) {
  if (trace::Scene::takes(position)) return;
  throw Error(ErrorCode::kBadInput, "its position is not finite or too far from the origin",
              {.element = "landmark " + std::to_string(number)});
}

LandmarkIndex::LandmarkIndex(const std::vector<Vec3>& landmarks) {
  check_landmarks(landmarks);
  build(landmarks, std::vector<std::uint32_t>(landmarks.size(), 0), 1);
}

LandmarkIndex::LandmarkIndex(const std::vector<Vec3>& landmarks, const bsp::Tree& tree,
                             const pvs::VisibleSets& visible)
    : tree_(&tree), visible_(&visible) {
  check_landmarks(landmarks);
  if (tree.clusters != visible.clusters() || tree.leaves.empty()) {
    throw Error(ErrorCode::kInternal, "the visible sets are not those of the tree");
  }
  std::vector<std::uint32_t> group;
  group.reserve(landmarks.size());
  for (const Vec3& landmark : landmarks) {
    const std::vector<std::uint32_t> clusters = clusters_at(tree, landmark);
    group.push_back(clusters.size() == 1 ? clusters[0] : tree.clusters);
  }
  build(landmarks, group, tree.clusters + 1);
}

void LandmarkIndex::build(const std::vector<Vec3>& landmarks, const std::vector<std::uint32_t>& group,
                          std::uint32_t groups) {
  const Curve curve(landmarks);
  std::vector<std::uint64_t> place(landmarks.size());
  std::transform(landmarks.begin(), landmarks.end(), place.begin(),
                 [&](const Vec3& landmark) { return curve.place(landmark); });
  numbers_.resize(landmarks.size());
  std::iota(numbers_.begin(), numbers_.end(), 0u);
  std::sort(numbers_.begin(), numbers_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(group[a], place[a], a) < std::tie(group[b], place[b], b);
  });
  points_.reserve(landmarks.size());
  for (const std::uint32_t number : numbers_) points_.push_back(landmarks[number]);

  const auto count = static_cast<std::uint32_t>(landmarks.size());
  std::uint32_t at = 0;
  for (std::uint32_t g = 0; g < groups; ++g) {
    first_block_.push_back(static_cast<std::uint32_t>(blocks_.size()));
    while (at < count && group[numbers_[at]] == g) {
      Block block{Box(), at, 0};
      for (; at < count && group[numbers_[at]] == g && block.count < kBlockSize; ++at, ++block.count) {
        block.box.extend(points_[at]);
      }
      blocks_.push_back(block);
    }
  }
  first_block_.push_back(static_cast<std::uint32_t>(blocks_.size()));
}

void LandmarkIndex::blocks_from(const Vec3& viewpoint, std::vector<std::uint32_t>& blocks) const {
  blocks.clear();
  const std::vector<std::uint32_t> here =
      tree_ != nullptr ? clusters_at(*tree_, viewpoint) : std::vector<std::uint32_t>();
  if (here.empty()) {
    blocks.resize(blocks_.size());
    std::iota(blocks.begin(), blocks.end(), 0u);
    return;
  }
  std::vector<std::uint32_t> visible;
  for (const std::uint32_t cluster : here) {
    const std::vector<std::uint32_t> row = visible_->visible_from(cluster);
    visible.insert(visible.end(), row.begin(), row.end());
  }
  std::sort(visible.begin(), visible.end());
  visible.erase(std::unique(visible.begin(), visible.end()), visible.end());
  for (const std::uint32_t cluster : visible) append_blocks_of(cluster, blocks);
  append_blocks_of(tree_->clusters, blocks);
}

void LandmarkIndex::append_blocks_of(std::uint32_t group, std::vector<std::uint32_t>& blocks) const {
  for (std::uint32_t b = first_block_[group]; b < first_block_[group + 1]; ++b) blocks.push_back(b);
}

}  // namespace hallway::sense
