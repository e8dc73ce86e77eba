// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bsp/tree.hpp"
#include "geom/box.hpp"
#include "pvs/visible_sets.hpp"

namespace hallway::sense {

/// The landmarks of a world, grouped so that a sensor need not look at each: by cluster of the BSP where there is one, and
/// in blocks of landmarks that lie together. Made once for a world and shared by its sensors.
class LandmarkIndex {
 public:
  /// Landmarks that lie together, all in one cluster.
  struct Block {
    Box box{};
    std::uint32_t first = 0;  ///< in points() and numbers()
    std::uint32_t count = 0;  ///< 1 to kBlockSize
  };
  static constexpr std::uint32_t kBlockSize = 128;

  /// Of a world without visible sets: from everywhere every block may be seen. The index of a landmark is its number.
  /// Throws Error{kBadInput} for landmarks that trace::Scene takes no rays from, or too many of them. O(n log n).
  explicit LandmarkIndex(const std::vector<Vec3>& landmarks);

  /// Of a world with visible sets. Keeps references to `tree` and `visible`, which must outlive the index and belong together
  /// (Error{kInternal} if the numbers of clusters differ). Landmarks in solid, outside, or so close to a plane of the tree
  /// that rounding could put them into either of two clusters may be seen from everywhere.
  LandmarkIndex(const std::vector<Vec3>& landmarks, const bsp::Tree& tree, const pvs::VisibleSets& visible);

  /// Replaces `blocks` by the indices of the blocks that may be seen from a viewpoint, rising: all of them where the
  /// viewpoint is in solid or outside, or there are no visible sets. A landmark between which and the viewpoint there is a
  /// free line is always in one of them.
  void blocks_from(const Vec3& viewpoint, std::vector<std::uint32_t>& blocks) const;

  std::span<const Block> blocks() const { return blocks_; }
  /// Positions in the order of the blocks, world metres.
  std::span<const Vec3> points() const { return points_; }
  /// The landmark at each place of points().
  std::span<const std::uint32_t> numbers() const { return numbers_; }

 private:
  void build(const std::vector<Vec3>& landmarks, const std::vector<std::uint32_t>& group,
             std::uint32_t groups);
  void append_blocks_of(std::uint32_t group, std::vector<std::uint32_t>& blocks) const;

  const bsp::Tree* tree_ = nullptr;
  const pvs::VisibleSets* visible_ = nullptr;
  std::vector<Block> blocks_;
  /// Blocks of group g are those from first_block_[g] to first_block_[g + 1]. Groups 0 ... clusters - 1 are the clusters, the
  /// last group may be seen from everywhere.
  std::vector<std::uint32_t> first_block_;
  std::vector<Vec3> points_;
  std::vector<std::uint32_t> numbers_;
};

/// Throws Error{kBadInput} that names the landmark if trace::Scene takes no rays that end at its position.
void check_landmark(const Vec3& position, std::size_t number);

}  // namespace hallway::sense
