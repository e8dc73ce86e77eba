// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <optional>

#include "run/sources/source.hpp"

namespace hallway::run {

/// The frames of another source at their own pace: a frame is given no sooner after the first one than its time says.
class PacedSource : public Source {
 public:
  using Clock = std::chrono::steady_clock;

  /// Keeps a reference to `source`.
  /// @param rate         1: as recorded; 2: twice as fast. Above 0
  /// @param sleep_until  how to wait
  PacedSource(Source& source, double rate, std::function<void(Clock::time_point)> sleep_until);

  std::uint32_t iterations() const override { return source_.iterations(); }
  std::optional<eval::FloorPlan> floor_plan() const override { return source_.floor_plan(); }

 private:
  void fill(std::uint32_t iteration, SourceFrame& frame) override;

  struct Start {
    Clock::time_point wall;
    std::int64_t t_ns;
  };

  Source& source_;
  double rate_;
  std::function<void(Clock::time_point)> sleep_until_;
  std::optional<Start> start_;  ///< of the first frame
};

}  // namespace hallway::run
