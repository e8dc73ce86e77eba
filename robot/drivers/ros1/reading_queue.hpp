// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

namespace hallway::ros1 {

/// A message on its way from its topic to the host.
struct Reading {
  std::uint32_t sensor = 0;
  std::int64_t t_ns = 0;
  std::vector<hw_point3_t> points{};  ///< sensor frame, metres
  std::uint64_t sequence = 0;         ///< counts what the queue took
  std::uint64_t sensor_sequence = 0;  ///< counts what it took of this sensor
};

/// What became of a reading.
enum class Pushed { kTaken, kOutOfOrder, kOverflow };

/// Holds readings in the order of their stamps between the thread of the topics and that of the host.
class ReadingQueue {
 public:
  explicit ReadingQueue(std::size_t capacity) : capacity_(capacity) {}

  /// Adds a reading, unless its stamp lies before that of one that was taken earlier. Where the queue is full the oldest
  /// one goes, which is kOverflow and leaves a gap in the sequence numbers.
  Pushed push(Reading reading);
  /// The oldest reading; waits for one, `wait` at most.
  std::optional<Reading> pop(std::chrono::nanoseconds wait);

 private:
  std::size_t capacity_;
  std::mutex mutex_;
  std::condition_variable filled_;
  std::deque<Reading> readings_;
  std::optional<std::int64_t> last_t_ns_;
  std::uint64_t taken_ = 0;
  std::map<std::uint32_t, std::uint64_t> taken_of_sensor_;
};

}  // namespace hallway::ros1
