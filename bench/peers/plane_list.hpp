// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/plugin.hpp>

#include <cstdint>
#include <vector>

#include "em/core/types.hpp"

namespace hallway::peers {

/// Points of one plane: places in the cloud, in any order, each once.
using Members = std::vector<std::uint32_t>;

/// Planes in the ABI's form, described as those of `em` are: total least squares, tightest rectangle, hull.
class PlaneList {
 public:
  /// Adds the plane of some points; none where they lie on a line.
  void add(const std::vector<Vec3>& points, Members members);

  /// Answers sample `sample` of the frame. Throws sdk::Failure.
  void put(const sdk::Host& host, std::uint32_t sample) const;

 private:
  std::vector<hw_plane_t> planes_;
  std::vector<hw_point3_t> hull_;
  std::vector<std::uint32_t> members_;
};

}  // namespace hallway::peers
