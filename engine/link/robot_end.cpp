// SPDX-License-Identifier: MIT
#include "link/robot_end.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/error.hpp"

namespace hallway::link {
namespace {

using std::chrono::milliseconds;

/// How many datagrams are sent in one go: about as many as a receiver has room for that is not scheduled just now.
constexpr std::size_t kBurst = 32;
/// What is left between two bursts in real time.
constexpr std::chrono::microseconds kBurstPause{500};
/// After how long without a word a question is asked again: at first, and at most.
constexpr milliseconds kFirstRetry{20};
constexpr milliseconds kLastRetry{320};
constexpr milliseconds kLongestSleep{50};
constexpr std::size_t kRememberedFrames = 1024;
/// Answers that nobody takes.
constexpr std::size_t kMaxAnswers = 1024;
constexpr milliseconds kByeTime{2000};
/// Which bye of a host that owes an answer ends the session.
constexpr int kByesForAnAnswer = 3;

}  // namespace

RobotEnd::RobotEnd(Wire& wire, const Description& description, std::uint32_t session, milliseconds give_up,
                   std::uint8_t newest)
    : wire_(wire), session_(session), newest_(newest), give_up_(give_up) {
  for (std::uint8_t version = kFirstVersion; version <= kNewestVersion; ++version) {
    descriptions_[version - kFirstVersion] = write_description(description, version);
  }
}

bool RobotEnd::wait(Clock::time_point deadline) {
  std::array<std::byte, kMaxDatagramBytes + 1> room{};
  const auto left = std::chrono::ceil<milliseconds>(deadline - Clock::now());
  Address from;
  const auto bytes = wire_.receive(room, from, std::clamp(left, milliseconds{0}, kLongestSleep));
  if (bytes) take(std::span(room).first(std::min(*bytes, room.size())), from);
  if (host_ && !over_ && give_up_.count() > 0 && Clock::now() - heard_ > give_up_) over_ = gave_up_ = true;
  return bytes.has_value();
}

void RobotEnd::take(std::span<const std::byte> bytes, const Address& from) {
  const auto read = read_datagram(bytes);
  const auto* datagram = std::get_if<Datagram>(&read);
  const bool hello = datagram != nullptr && datagram->header.type == Type::kHello;
  const bool sound = datagram != nullptr && (!hello || datagram->header.version == kFirstVersion);
  if (host_ && from != *host_) {
    ++counters_.foreign;
  } else if (!sound) {
    ++counters_.malformed;
  } else if (hello) {
    take_hello(datagram->header, from);
  } else if (!host_ || datagram->header.session != session_) {
    ++counters_.foreign;
  } else if (datagram->header.version != version_) {
    ++counters_.malformed;
  } else {
    heard_ = Clock::now();
    take_from_host(*datagram);
  }
}

void RobotEnd::take_hello(const Header& header, const Address& from) {
  if (!host_) {
    host_ = from;
    nonce_ = header.sequence;
    version_ = (header.flags & kOffersVersion2) != 0 ? newest_ : kFirstVersion;
  }
  heard_ = Clock::now();
  if (header.sequence != nonce_) {
    over_ = true;  // the host was started anew, and knows nothing of what was before
    return;
  }
  wanted_ = wanted_ || (header.flags & kReady) != 0;
  if (!over_) describe();
}

void RobotEnd::describe() {
  const Bytes& description = descriptions_[version_ - kFirstVersion];
  const std::size_t fragments = fragments_of(description.size());
  for (std::size_t i = 0; i < fragments; ++i) {
    put({.type = Type::kDescription,
         .sequence = nonce_,
         .fragment = static_cast<std::uint16_t>(i),
         .fragments = static_cast<std::uint16_t>(fragments)},
        fragment_of(description, i));
  }
}

/// Sends a datagram of this session.
void RobotEnd::put(Header header, std::span<const std::byte> payload) {
  header.session = session_;
  header.version = version_;
  write_datagram(header, payload, datagram_);
  wire_.send(datagram_, *host_);
}

void RobotEnd::take_from_host(const Datagram& datagram) {
  const Header& header = datagram.header;
  if (header.type == Type::kAnswer) {
    take_answer(datagram);
  } else if (header.type == Type::kMissing) {
    if (header.sequence != delivery_.sequence) return;  // it was asked before the answer came
    auto missing = read_missing(datagram.payload, delivery_.missing.size());
    if (!missing) {
      ++counters_.malformed;
      return;
    }
    delivery_.missing = std::move(*missing);
    delivery_.told = true;
  } else if (header.type == Type::kBye) {
    // The answer to the frame under way may have been lost: it is asked for again before a bye is taken.
    if (delivering_ && ++byes_ < kByesForAnAnswer) return;
    over_ = bye_heard_ = true;
    if (!header.wants_reply()) return;
    put({.type = Type::kBye}, {});
  } else {
    ++counters_.malformed;  // a robot's own kind
  }
}

void RobotEnd::take_answer(const Datagram& datagram) {
  const auto answer = read_answer(datagram);
  if (!answer) {
    ++counters_.malformed;
    return;
  }
  if (last_answer_ && answer->number <= *last_answer_) {
    ++counters_.repeated_answers;
    return;
  }
  last_answer_ = answer->number;
  ++counters_.answers;
  CameAnswer came{.answer = *answer};
  const auto sent =
      std::ranges::find_if(sent_, [&](const auto& entry) { return entry.first == answer->sequence; });
  if (sent != sent_.end()) came.round_trip = Clock::now() - sent->second;
  if (answers_.size() == kMaxAnswers) answers_.pop_front();
  answers_.push_back(std::move(came));
  if (answer->sequence == delivery_.sequence && answer->status != HW_ANSWER_END) delivery_.answered = true;
}

std::optional<CameAnswer> RobotEnd::next_answer() {
  if (answers_.empty()) return std::nullopt;
  CameAnswer first = std::move(answers_.front());
  answers_.pop_front();
  return first;
}

void RobotEnd::note_sent(std::uint64_t sequence) {
  ++counters_.frames;
  if (sent_.size() == kRememberedFrames) sent_.pop_front();
  sent_.emplace_back(sequence, Clock::now());
}

void RobotEnd::begin(std::uint64_t sequence, std::span<const std::byte> frame) {
  if (frame.empty() || frame.size() > kMaxFrameMessageBytes) {
    throw Error(ErrorCode::kBadInput, fmt::format("a frame of {} bytes; the protocol carries up to {}",
                                                  frame.size(), kMaxFrameMessageBytes));
  }
  delivery_ = {.sequence = sequence, .missing = std::vector<bool>(fragments_of(frame.size()), true)};
  sent_once_.assign(delivery_.missing.size(), false);
  note_sent(sequence);
}

void RobotEnd::send_fragment(std::span<const std::byte> frame, std::size_t fragment, std::uint16_t flags) {
  put({.type = Type::kFrame,
       .flags = flags,
       .sequence = delivery_.sequence,
       .fragment = static_cast<std::uint16_t>(fragment),
       .fragments = static_cast<std::uint16_t>(delivery_.missing.size())},
      fragment_of(frame, fragment));
  ++(sent_once_[fragment] ? counters_.resent : counters_.datagrams);
  sent_once_[fragment] = true;
}

void RobotEnd::send(std::uint64_t sequence, std::span<const std::byte> frame) {
  begin(sequence, frame);
  for (std::size_t i = 0; i < delivery_.missing.size(); ++i) {
    send_fragment(frame, i, 0);
    const Clock::time_point pause = Clock::now() + kBurstPause;
    while (i % kBurst == kBurst - 1 && Clock::now() < pause) wait(pause);
  }
}

/// Sends the first of what is missing, or asks again about the last one where nothing is; @return the fragment with the question
std::size_t RobotEnd::send_missing(std::span<const std::byte> frame) {
  std::vector<std::size_t> burst;
  for (std::size_t i = 0; i < delivery_.missing.size() && burst.size() < kBurst; ++i) {
    if (delivery_.missing[i]) burst.push_back(i);
  }
  if (burst.empty()) burst.push_back(delivery_.missing.size() - 1);
  for (const std::size_t i : burst) send_fragment(frame, i, i == burst.back() ? kReplyWanted : 0);
  return burst.back();
}

bool RobotEnd::deliver(std::uint64_t sequence, std::span<const std::byte> frame,
                       const std::function<bool()>& stop) {
  begin(sequence, frame);
  delivering_ = true;
  std::size_t question = send_missing(frame);
  milliseconds retry = kFirstRetry;
  Clock::time_point due = Clock::now() + retry;
  while (!delivery_.answered && !over_ && !stop()) {
    wait(due);
    if (std::exchange(delivery_.told, false)) {
      const bool all_there = std::ranges::find(delivery_.missing, true) == delivery_.missing.end();
      if (!all_there) {
        question = send_missing(frame);
        retry = kFirstRetry;
      }
      due = Clock::now() + retry;
    } else if (Clock::now() >= due) {
      // Nothing is known of what was sent: one datagram asks.
      send_fragment(frame, question, kReplyWanted);
      retry = std::min(2 * retry, kLastRetry);
      due = Clock::now() + retry;
    }
  }
  delivering_ = false;
  return delivery_.answered;
}

void RobotEnd::leave() {
  milliseconds retry = kFirstRetry;
  const Clock::time_point end = Clock::now() + kByeTime;
  while (host_ && !gave_up_ && !bye_heard_ && Clock::now() < end) {
    put({.type = Type::kBye, .flags = kReplyWanted}, {});
    const Clock::time_point due = std::min(end, Clock::now() + retry);
    while (!bye_heard_ && !gave_up_ && Clock::now() < due) wait(due);
    retry = std::min(2 * retry, kLastRetry);
  }
  over_ = true;
}

}  // namespace hallway::link
