// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "host/samples/frame_bytes.hpp"
#include "import/recording.hpp"

namespace hallway::import {

/// Most points of one frame: what the frame's bytes in a log have room for.
inline constexpr std::size_t kMaxFramePoints = (host::kMaxFrameBytes - 4096) / sizeof(hw_point3_t);

/// Most pixels of an image that a frame may tell.
inline constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 28;

/// Takes the points of a frame in their order; leaves out all but each `stride`-th of them, and of those the ones that are not finite.
class PointCollector {
 public:
  /// Empties `frame` of points. Keeps a reference to it.
  /// @param stride  at least 1
  /// @param rows    if given: emptied, then gets for each point taken which of those given it was, counted from 0
  PointCollector(Frame& frame, std::uint32_t stride, std::vector<std::uint64_t>* rows = nullptr);

  /// The points that follow are the pixels of an image, row by row, or those that add() names. Called before them; an
  /// image of more than kMaxPixels pixels is not kept.
  void begin_image(std::uint64_t width, std::uint64_t height);
  /// Throws Error{kBadInput} where the frame would hold more than kMaxFramePoints.
  void add(double x, double y, double z) { add(x, y, z, given_); }
  /// As above, of a point that is not the next pixel but `pixel`.
  void add(double x, double y, double z, std::uint64_t pixel);
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
