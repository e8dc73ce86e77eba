// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "drive/wheels.hpp"

namespace hallway::sim {

/// The ways of a drive's rims over the last time.
class WheelHistory {
 public:
  explicit WheelHistory(std::size_t n_wheels) : n_wheels_(n_wheels) {}

  /// Appends a ramp, which begins where the last one ends; the first one at time 0.
  void add(const drive::WheelRamp& ramp) {
    pieces_.push_back({end_ns_, travel_m_, ramp});
    const drive::PerWheel way = drive::travel(ramp);
    for (std::size_t i = 0; i < way.size(); ++i) travel_m_.at(i) += way.at(i);
    end_ns_ += ramp.duration_ns;
  }

  /// Drops the ramps that end before a time.
  void forget_before(std::int64_t t_ns) {
    while (!pieces_.empty() && pieces_.front().begin_ns + pieces_.front().ramp.duration_ns < t_ns)
      pieces_.pop_front();
  }

  /// The way of each rim since time 0, at a time from the oldest ramp's begin to the newest one's end, metres. O(log ramps).
  std::vector<double> at(std::int64_t t_ns) const {
    std::vector<double> ways(travel_m_.begin(), travel_m_.begin() + static_cast<std::ptrdiff_t>(n_wheels_));
    if (t_ns >= end_ns_ || pieces_.empty()) return ways;
    const auto after =
        std::upper_bound(pieces_.begin(), pieces_.end(), t_ns,
                         [](std::int64_t t, const Piece& piece) { return t < piece.begin_ns; });
    const Piece& piece = after == pieces_.begin() ? *after : *(after - 1);
    const drive::WheelRamp& ramp = piece.ramp;
    const std::int64_t part_ns = std::max<std::int64_t>(t_ns - piece.begin_ns, 0);
    drive::WheelRamp begin{.from = ramp.from, .duration_ns = part_ns};
    for (std::size_t i = 0; i < n_wheels_; ++i)
      begin.to.at(i) = drive::between(ramp.from.at(i), ramp.to.at(i), part_ns, ramp.duration_ns);
    const drive::PerWheel way = drive::travel(begin);
    for (std::size_t i = 0; i < n_wheels_; ++i) ways[i] = piece.travel_m.at(i) + way.at(i);
    return ways;
  }

 private:
  struct Piece {
    std::int64_t begin_ns = 0;
    drive::PerWheel travel_m{};  ///< at its begin
    drive::WheelRamp ramp{};
  };

  std::size_t n_wheels_;
  std::deque<Piece> pieces_;
  drive::PerWheel travel_m_{};
  std::int64_t end_ns_ = 0;
};

}  // namespace hallway::sim
