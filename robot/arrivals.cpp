// SPDX-License-Identifier: MIT
#include "robot/arrivals.hpp"

#include <utility>

namespace hallway::robot {
namespace {

/// How long one wait for the driver is: as long stop() may take.
constexpr std::chrono::milliseconds kLongestWait{50};

}  // namespace

Arrivals::Arrivals(host::Driver& driver, const host::RobotInfo& robot, std::size_t backlog)
    : robot_(robot), backlog_(backlog), intake_(driver, robot) {
  if (!robot_.lock_step) thread_ = std::thread([this] { read(); });
}

Arrivals::~Arrivals() {
  stop();
}

void Arrivals::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  if (thread_.joinable()) thread_.join();
  dropped_ += waiting_.size();
  waiting_.clear();
}

void Arrivals::read() {
  Arrival arrival;
  try {
    for (;;) {
      if (read_one(arrival)) add(arrival);
      const std::lock_guard lock(mutex_);
      counts_ = intake_.counts();
      first_refusal_ = intake_.first_refusal();
      ended_ = intake_.ended();
      if (ended_) came_.notify_one();
      if (ended_ || stopping_) return;
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
    came_.notify_one();
  }
}

bool Arrivals::read_one(Arrival& arrival) {
  const auto frame = intake_.take(kLongestWait, arrival.bytes);
  if (!frame) return false;
  arrival.frame = *frame;
  arrival.came = Clock::now();
  return true;
}

/// @param heir  the frame behind it
void Arrivals::drop_first(Arrival& heir) {
  carried_.carry(waiting_.front().bytes, heir.bytes);
  spare_.push_back(std::move(waiting_.front().bytes));
  waiting_.pop_front();
  ++dropped_;
}

void Arrivals::add(Arrival& arrival) {
  const std::lock_guard lock(mutex_);
  if (waiting_.size() == backlog_) drop_first(backlog_ > 1 ? waiting_[1] : arrival);
  waiting_.push_back({arrival.frame, arrival.came, std::move(arrival.bytes)});
  arrival.bytes.clear();
  if (!spare_.empty()) {
    arrival.bytes = std::move(spare_.back());
    spare_.pop_back();
  }
  came_.notify_one();
}

bool Arrivals::take(std::chrono::nanoseconds wait, bool newest, Arrival& arrival) {
  if (robot_.lock_step) {
    const auto frame = intake_.take(wait, arrival.bytes);
    counts_ = intake_.counts();
    ended_ = intake_.ended();
    if (frame) arrival = {*frame, Clock::now(), std::move(arrival.bytes)};
    return frame.has_value();
  }
  std::unique_lock lock(mutex_);
  came_.wait_for(lock, wait, [this] { return !waiting_.empty() || failure_ || ended_; });
  if (waiting_.empty() && failure_) std::rethrow_exception(failure_);
  if (waiting_.empty()) return false;
  while (newest && waiting_.size() > 1) drop_first(waiting_[1]);
  std::swap(arrival, waiting_.front());
  spare_.push_back(std::move(waiting_.front().bytes));
  waiting_.pop_front();
  return true;
}

bool Arrivals::ended() const {
  const std::lock_guard lock(mutex_);
  return ended_ && waiting_.empty();
}

IntakeCounts Arrivals::counts() const {
  const std::lock_guard lock(mutex_);
  IntakeCounts counts = counts_;
  counts.dropped = dropped_;
  return counts;
}

std::string Arrivals::first_refusal() const {
  const std::lock_guard lock(mutex_);
  return first_refusal_;
}

}  // namespace hallway::robot
