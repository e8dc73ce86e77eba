// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "contact/separation.hpp"
#include "geom/box_tree.hpp"

namespace hallway::contact {

/// Greatest coordinate of an obstacle, metres.
inline constexpr double kGreatestCoordinate = 1e6;

/// What bodies meet: triangles that do not move, in metres, world frame. Those of the solid's boundary and of models, in one list.
class Obstacles {
 public:
  /// Throws Error{kBadInput} for coordinates that are no numbers or beyond kGreatestCoordinate. O(n log n).
  explicit Obstacles(std::vector<Triangle> triangles);

  std::uint32_t size() const { return static_cast<std::uint32_t>(triangles_.size()); }
  const Triangle& triangle(std::uint32_t index) const { return triangles_[index]; }
  /// The box of a triangle.
  const Box& box(std::uint32_t index) const { return boxes_[index]; }

  /// Replaces `found` by the indices of the triangles whose boxes touch `box`, rising. O(log n + found) on average. Any number of threads may ask at once.
  void near(const Box& box, std::vector<std::uint32_t>& found) const { tree_.find(box, found); }

 private:
  std::vector<Triangle> triangles_;
  std::vector<Box> boxes_;
  BoxTree tree_;
};

}  // namespace hallway::contact
