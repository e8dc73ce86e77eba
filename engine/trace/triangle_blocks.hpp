// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "trace/triangle_set.hpp"

namespace hallway::trace {

inline constexpr std::size_t kBlockSize = 8;

/// Up to eight triangles that lie together, in single precision, relative to the scene's centre.
struct alignas(32) TriangleBlock {
  using Lane = std::array<float, kBlockSize>;
  std::array<Lane, 3> corner{};  ///< a
  std::array<Lane, 3> first{};   ///< b - a
  std::array<Lane, 3> second{};  ///< c - a
  std::array<Lane, 3> normal{};  ///< first x second
  /// The longest edge, and the length of `normal`; both infinite for a triangle that is never to be decided in single
  /// precision.
  Lane edge{};
  Lane area{};
  std::array<std::uint32_t, kBlockSize> triangle{};  ///< index in the TriangleSet
  std::uint32_t used = 0;                            ///< bit i is set if triangle i is there
};

/// A line from `origin` (at 0) to `origin + delta` (at 1), relative to the scene's centre, with the bounds on rounding
/// that certify() works with. Infinite margins leave everything open.
struct FloatSegment {
  std::array<float, 3> origin{};
  std::array<float, 3> delta{};
  float edge_margin = 0.0f;   ///< times TriangleBlock::edge bounds the error of a signed volume
  float plane_margin = 0.0f;  ///< times TriangleBlock::area bounds the error of a distance from a plane
  float least_facing =
      0.0f;  ///< times TriangleBlock::area: no line that is flatter to a triangle surely hits it
};

/// What single precision says of the triangles of a block, a bit for each.
struct Verdict {
  std::uint32_t hit = 0;   ///< TriangleSet::hit() of the exact line surely has a value
  std::uint32_t open = 0;  ///< it may have one: all but the sure misses, hits included
};

/// Decides a block in single precision as far as its rounding errors allow; see triangle_blocks.cpp for the proof.
using Certify = Verdict (*)(const TriangleBlock& block, const FloatSegment& segment);
/// For any CPU.
Verdict certify_portable(const TriangleBlock& block, const FloatSegment& segment);
/// The fastest for this CPU.
Certify fastest_certify();

/// The triangles of a set in blocks.
class TriangleBlocks {
 public:
  /// Triangles without area are left out: they are never hit.
  explicit TriangleBlocks(const TriangleSet& triangles);

  std::uint32_t size() const { return static_cast<std::uint32_t>(blocks_.size()); }
  const TriangleBlock& operator[](std::uint32_t block) const { return blocks_[block]; }
  /// Of the triangles of a block, world frame.
  const Box& box(std::uint32_t block) const { return boxes_[block]; }
  /// The origin of the blocks' coordinates, world frame.
  const Vec3& centre() const { return centre_; }

  /// @param from   relative to centre(); within the scene's bounds grown by 1 % of its radius, as is from + delta
  /// @param delta  at least least_length_m() long
  /// @param sure   false to leave everything open
  FloatSegment segment(const Vec3& from, const Vec3& delta, bool sure) const {
    const auto narrow = [](double value) { return static_cast<float>(value); };
    FloatSegment segment;
    segment.origin = {narrow(from.x()), narrow(from.y()), narrow(from.z())};
    segment.delta = {narrow(delta.x()), narrow(delta.y()), narrow(delta.z())};
    const float length = std::abs(segment.delta[0]) + std::abs(segment.delta[1]) + std::abs(segment.delta[2]);
    segment.edge_margin = sure ? rounding_ * length : std::numeric_limits<float>::infinity();
    segment.plane_margin = sure ? rounding_ : std::numeric_limits<float>::infinity();
    segment.least_facing = kLeastFacing * length;
    return segment;
  }
  double least_length_m() const;
  /// How far from centre() along an axis the line's true origin may be for a segment to be `sure`.
  double sure_within_m() const;

 private:
  /// Sine of the least angle to a triangle's plane of a sure hit.
  static constexpr float kLeastFacing = 0x1.0p-10f;

  void add(const TriangleSet& triangles, std::uint32_t triangle, TriangleBlock& block, std::size_t lane);

  std::vector<TriangleBlock> blocks_;
  std::vector<Box> boxes_;
  Vec3 centre_;
  double radius_m_;
  float rounding_;  ///< metres; see triangle_blocks.cpp
};

}  // namespace hallway::trace
