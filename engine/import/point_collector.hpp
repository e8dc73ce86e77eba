// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "host/frame_bytes.hpp"
#include "import/recording.hpp"

namespace hallway::import {

/// Most points of one frame: what the frame's bytes in a log have room for.
inline constexpr std::size_t kMaxFramePoints = (host::kMaxFrameBytes - 4096) / sizeof(hw_point3_t);

/// Takes the points of a frame in their order; leaves out all but each `stride`-th of them, and of those the ones that are not finite.
class PointCollector {
 public:
  /// Empties `frame` of points. Keeps a reference to it.
  /// @param stride  at least 1
  /// @param rows    if given: emptied, then gets for each point taken which of those given it was, counted from 0
  PointCollector(Frame& frame, std::uint32_t stride, std::vector<std::uint64_t>* rows = nullptr);

  /// Throws Error{kBadInput} where the frame would hold more than kMaxFramePoints.
  void add(double x, double y, double z);
  /// How many points were given.
  std::uint64_t given() const { return given_; }

 private:
  Frame& frame_;
  std::uint32_t stride_;
  std::uint32_t until_next_ = 0;
  std::vector<std::uint64_t>* rows_;
  std::uint64_t given_ = 0;
};

}  // namespace hallway::import
