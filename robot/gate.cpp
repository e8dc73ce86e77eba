// SPDX-License-Identifier: MIT
#include "robot/gate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace hallway::robot {
namespace {

constexpr std::size_t kMaxMessages = 100;

}  // namespace

Gate::Gate(Write write, Clock::duration limit, Clock::time_point now)
    : write_(std::move(write)), limit_(limit), last_frame_(now) {}

void Gate::frame_came(std::uint64_t sequence, std::int64_t t_ns, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  sequence_ = sequence;
  t_ns_ = t_ns;
  last_frame_ = now;
  waiting_ = true;
  late_ = false;
}

bool Gate::answer(hw_answer_t answer, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  waiting_ = false;
  if (ended_) return false;
  late_ = late_ || (limit_ > Clock::duration::zero() && now - last_frame_ > limit_);
  if (!late_) {
    write(answer, HW_ANSWER_DONE);
    stopped_ = false;
    return true;
  }
  ++counts_.late_answers;
  const std::string message = fmt::format("the answer to frame {} came {:.1f} ms after it", sequence_,
                                          milliseconds(now - last_frame_));
  stop(answer, HW_ANSWER_LATE, message);
  if (!stopped_) note_trip(message);  // the watchdog has not looked yet
  return false;
}

void Gate::fail(const std::string& message, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  waiting_ = false;
  if (ended_) return;
  stop({}, HW_ANSWER_FAILED, message);
  if (!std::exchange(stopped_, true)) note_stop(now);
}

void Gate::end(const std::string& message) {
  const std::lock_guard lock(mutex_);
  if (std::exchange(ended_, true)) return;
  stop({}, HW_ANSWER_END, message);
}

Clock::time_point Gate::watch(Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  if (ended_ || limit_ <= Clock::duration::zero()) return Clock::time_point::max();
  const Clock::time_point due = last_frame_ + limit_;
  if (now <= due) return due + Clock::duration(1);
  late_ = waiting_;
  if (!stopped_) {
    const std::string message =
        waiting_ ? fmt::format("no answer to frame {} within {:g} ms", sequence_, milliseconds(limit_))
                 : fmt::format("no frame within {:g} ms", milliseconds(limit_));
    try {
      stop({}, HW_ANSWER_LATE, message);
    } catch (...) {
      failure_ = std::current_exception();
    }
    note_trip(message);
  }
  return now + limit_;
}

void Gate::write(hw_answer_t& answer, std::uint32_t status) {
  answer.size = sizeof answer;
  answer.status = status;
  answer.sequence = sequence_;
  answer.t_ns = t_ns_;
  write_(answer);
}

void Gate::stop(hw_answer_t answer, std::uint32_t status, const std::string& message) {
  hw_drive_command_t still{};
  still.size = sizeof still;
  answer.command = &still;
  answer.message = message.c_str();
  write(answer, status);
}

void Gate::note_trip(const std::string& message) {
  stopped_ = true;
  ++counts_.trips;
  note_stop(last_frame_);
  if (messages_.size() < kMaxMessages) messages_.push_back("watchdog: stopped, for " + message);
}

void Gate::note_stop(Clock::time_point since) {
  counts_.worst_stop = std::max(counts_.worst_stop, Clock::now() - since);
}

GateCounts Gate::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

std::vector<std::string> Gate::take_messages() {
  const std::lock_guard lock(mutex_);
  return std::exchange(messages_, {});
}

void Gate::check() const {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
}

}  // namespace hallway::robot
