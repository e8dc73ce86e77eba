// SPDX-License-Identifier: MIT
#include "link/host_end.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>

#include "base/error.hpp"

namespace hallway::link {
namespace {

using std::chrono::milliseconds;

/// The longest sleep of the thread that listens; what is due is then at most so late.
constexpr milliseconds kTick{20};
/// One more than the largest datagram, so that a larger one is seen to be so.
constexpr std::size_t kRoomBytes = kMaxDatagramBytes + 1;
constexpr std::chrono::hours kLongestWait{1};
/// How long leave() waits for the robot's bye, and how often it says its own.
constexpr milliseconds kByeWait{50};
constexpr int kByes = 6;

}  // namespace

HostEnd::HostEnd(Wire& wire, const Address& robot, std::uint64_t nonce, milliseconds give_up,
                 std::uint8_t newest)
    : wire_(wire),
      session_(wire, robot, nonce, give_up, Clock::now(), newest),
      thread_([this] { listen(); }) {}

HostEnd::~HostEnd() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  thread_.join();
}

void HostEnd::listen() {
  std::array<std::byte, kRoomBytes> room{};
  try {
    for (;;) {
      Address from;
      const auto bytes = wire_.receive(room, from, kTick);
      const std::lock_guard lock(mutex_);
      if (stop_) return;
      const Clock::time_point now = Clock::now();
      bool news = session_.tick(now);
      if (bytes) news |= session_.take(std::span(room).first(std::min(*bytes, room.size())), from, now);
      if (news) news_.notify_all();
    }
  } catch (const std::exception& failure) {
    const std::lock_guard lock(mutex_);
    broken_ = failure.what();
    news_.notify_all();
  }
}

void HostEnd::check_fault() const {
  if (!session_.fault().empty()) throw Error(ErrorCode::kIo, session_.fault());
  if (!broken_.empty()) throw Error(ErrorCode::kInternal, broken_);
}

const Description& HostEnd::describe() {
  std::unique_lock lock(mutex_);
  news_.wait(lock,
             [this] { return session_.description() || !session_.fault().empty() || !broken_.empty(); });
  check_fault();
  lock_step_ = session_.description()->lock_step;
  return *session_.description();
}

HostEnd::Reading HostEnd::read(std::chrono::nanoseconds wait) {
  const Clock::time_point deadline = Clock::now() + std::min<std::chrono::nanoseconds>(wait, kLongestWait);
  std::unique_lock lock(mutex_);
  session_.want_frames(Clock::now());
  for (bool more = true;;) {
    if (const auto sequence = session_.next(bytes_)) {
      lock.unlock();
      if (take_frame(*sequence)) return {Found::kFrame, frame_};
      lock.lock();
      continue;
    }
    check_fault();
    if (session_.ended()) return {.found = Found::kEnd};
    if (!more) return {};
    more = news_.wait_until(lock, deadline) == std::cv_status::no_timeout;
  }
}

bool HostEnd::bad_frame(const std::string& cause) {
  if (lock_step_) throw Error(ErrorCode::kBadInput, "the robot sends what is no frame: " + cause);
  ++bad_frames_;
  return false;
}

bool HostEnd::take_frame(std::uint64_t sequence) {
  try {
    frame_ = &reader_.read(bytes_);
  } catch (const Error& error) {
    return bad_frame(error.what());
  }
  if (frame_->sequence != sequence) {
    return bad_frame(fmt::format("message {1} holds frame {0}", frame_->sequence, sequence));
  }
  if (frame_->t_ns < t_ns_) {
    return bad_frame(fmt::format("the time of frame {} lies before that of the one before", sequence));
  }
  t_ns_ = frame_->t_ns;
  return true;
}

void HostEnd::answer(const Answer& answer) {
  const std::lock_guard lock(mutex_);
  session_.answer(answer, Clock::now());
}

void HostEnd::leave() {
  std::unique_lock lock(mutex_);
  const auto over = [this] {
    return session_.ended() || !session_.fault().empty() || !session_.description() || !broken_.empty();
  };
  for (int i = 0; i < kByes && !over(); ++i) {
    session_.say_bye(Clock::now());
    news_.wait_for(lock, kByeWait, over);
  }
}

std::uint8_t HostEnd::version() const {
  const std::lock_guard lock(mutex_);
  return session_.version();
}

HostCounters HostEnd::counters() const {
  const std::lock_guard lock(mutex_);
  return session_.counters();
}

}  // namespace hallway::link
