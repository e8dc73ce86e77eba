// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "watch/past.hpp"

namespace hallway::watch {

/// Describes a run in lines of text, where there is no terminal to draw on: the state once in a while, and what happens at once.
class LineMode {
 public:
  /// @param every_s  of the robot's time, from line to line of the state; above 0
  explicit LineMode(double every_s);

  /// The lines of the next moment, each with its end; often none.
  std::string add(const Moment& moment);

 private:
  std::int64_t every_ns_;
  std::optional<std::int64_t> next_ns_;
  Past past_;
};

}  // namespace hallway::watch
