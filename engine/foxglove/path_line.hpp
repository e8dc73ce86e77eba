// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "foxglove/messages.hpp"

namespace hallway::foxglove {

/// A path that grows while a run goes on. It is shown anew whenever it has grown by a sixteenth: all that is written of it
/// is then at most some seventeen times the path, however long the run.
class PathLine {
 public:
  /// Iterations increase; where one is missing the line is broken.
  void add(std::uint32_t iteration, const Vec3& position);
  /// Whether it has grown enough since it was shown last.
  bool is_due() const { return points_ >= due_at_; }
  /// Whether there is anything that was not shown yet.
  bool has_news() const { return points_ > shown_; }
  /// The path so far. Points without neighbours are left out.
  std::vector<Line> show(double width_px, const Colour& colour);

 private:
  std::vector<std::vector<Vec3>> strips_;
  std::uint32_t last_ = 0;
  std::size_t points_ = 0;
  std::size_t shown_ = 0;
  std::size_t due_at_ = 2;
};

}  // namespace hallway::foxglove
