// SPDX-License-Identifier: MIT
#include "run/sources/paced_source.hpp"

#include <utility>

namespace hallway::run {

PacedSource::PacedSource(Source& source, double rate, std::function<void(Clock::time_point)> sleep_until)
    : Source(source.facts()), source_(source), rate_(rate), sleep_until_(std::move(sleep_until)) {}

void PacedSource::fill(std::uint32_t iteration, SourceFrame& frame) {
  source_.read(iteration, frame);
  if (!start_) start_ = Start{Clock::now(), frame.t_ns()};
  // By the schedule, not by the last frame: one that was late makes no other one late.
  const double elapsed_ns = static_cast<double>(frame.t_ns() - start_->t_ns) / rate_;
  sleep_until_(start_->wall + std::chrono::nanoseconds(static_cast<std::int64_t>(elapsed_ns)));
}

}  // namespace hallway::run
