// SPDX-License-Identifier: MIT
#include "ros1/reading_queue.hpp"

#include <utility>

namespace hallway::ros1 {

Pushed ReadingQueue::push(Reading reading) {
  const std::lock_guard lock(mutex_);
  if (last_t_ns_ && reading.t_ns < *last_t_ns_) return Pushed::kOutOfOrder;
  last_t_ns_ = reading.t_ns;
  reading.sequence = taken_++;
  reading.sensor_sequence = taken_of_sensor_[reading.sensor]++;
  readings_.push_back(std::move(reading));
  filled_.notify_one();
  if (readings_.size() <= capacity_) return Pushed::kTaken;
  readings_.pop_front();
  return Pushed::kOverflow;
}

std::optional<Reading> ReadingQueue::pop(std::chrono::nanoseconds wait) {
  std::unique_lock lock(mutex_);
  if (!filled_.wait_for(lock, wait, [this] { return !readings_.empty(); })) return std::nullopt;
  Reading reading = std::move(readings_.front());
  readings_.pop_front();
  return reading;
}

}  // namespace hallway::ros1
