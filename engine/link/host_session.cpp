// SPDX-License-Identifier: MIT
#include "link/host_session.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "link/frames_in_step.hpp"
#include "link/newest_frames.hpp"

namespace hallway::link {
namespace {

using std::chrono::milliseconds;

/// How often hello is said until something comes of it.
constexpr milliseconds kHelloEvery{100};
/// The host says hello when it has said nothing for so long, so that the robot knows that it is there.
constexpr milliseconds kAliveEvery{1000};

}  // namespace

HostSession::HostSession(Wire& wire, const Address& robot, std::uint64_t nonce, milliseconds give_up,
                         Clock::time_point now, std::uint8_t newest)
    : wire_(wire), robot_(robot), nonce_(nonce), give_up_(give_up), heard_(now), sent_(now), newest_(newest) {
  say_hello(now);
}

bool HostSession::take(std::span<const std::byte> bytes, const Address& from, Clock::time_point now) {
  ++counters_.datagrams;
  if (from != robot_) {
    ++counters_.foreign;
    return false;
  }
  const auto read = read_datagram(bytes);
  if (const auto* refusal = std::get_if<Refusal>(&read)) {
    ++(*refusal == Refusal::kVersion ? counters_.other_version : counters_.malformed);
    return false;
  }
  const auto& datagram = std::get<Datagram>(read);
  const Type type = datagram.header.type;
  if (!has_version(datagram.header)) {
    ++counters_.other_version;
    return false;
  }
  if (type == Type::kDescription && datagram.header.sequence != nonce_) {
    ++counters_.foreign;
    return false;
  }
  if (type == Type::kDescription || of_this_session(datagram.header)) {
    heard_ = now;
    if (type == Type::kDescription) return take_description(datagram);
    if (type == Type::kFrame) return take_frame(datagram, now);
    if (type == Type::kBye) return take_bye(datagram, now);
    ++counters_.malformed;  // a host's own kind
  }
  return false;
}

/// A description chooses among what the hello offers, also that of a robot that was started anew.
bool HostSession::has_version(const Header& header) {
  const bool chosen = description_ && header.type != Type::kDescription;
  return chosen ? header.version == version_ : header.version <= newest_;
}

bool HostSession::of_this_session(const Header& header) {
  if (description_ && header.session == session_) return true;
  ++counters_.foreign;
  return false;
}

bool HostSession::take_description(const Datagram& datagram) {
  if (description_) {
    if (datagram.header.session == session_ || ended_) return false;
    fault_ = "the robot was started anew: its frames count from 0 again";
    return true;
  }
  if (!description_parts_.begun() || description_parts_.session() != datagram.header.session ||
      description_parts_.version() != datagram.header.version) {
    description_parts_.begin(datagram.header);
  }
  if (description_parts_.add(datagram) == Assembly::Added::kMisfit) ++counters_.malformed;
  if (!description_parts_.complete()) return false;
  session_ = description_parts_.session();
  version_ = description_parts_.version();
  description_parts_.take(payload_);
  try {
    description_ = read_description(payload_, version_);
  } catch (const Error& error) {
    fault_ = error.what();
    return true;
  }
  if (description_->lock_step) {
    inbox_ = std::make_unique<FramesInStep>();
  } else {
    inbox_ = std::make_unique<NewestFrames>();
  }
  return true;
}

bool HostSession::take_frame(const Datagram& datagram, Clock::time_point now) {
  const std::uint64_t before = inbox_->counters().frames;
  const FrameReply reply = inbox_->take(datagram);
  if (reply.kind == FrameReply::Kind::kMissing) {
    write_missing(reply.missing, payload_);
    send({.type = Type::kMissing, .sequence = datagram.header.sequence}, payload_, now);
  } else if (reply.kind == FrameReply::Kind::kAnswer) {
    wire_.send(last_answer_, robot_);
    sent_ = now;
  }
  return inbox_->counters().frames != before;
}

bool HostSession::take_bye(const Datagram& datagram, Clock::time_point now) {
  if (datagram.header.wants_reply()) send({.type = Type::kBye}, {}, now);
  ended_ = true;
  return true;
}

bool HostSession::tick(Clock::time_point now) {
  if (ended_ || !fault_.empty()) return false;
  const bool waiting = !description_ || (ready_ && inbox_->counters().frames == 0);
  if (now - sent_ >= (waiting ? kHelloEvery : kAliveEvery)) say_hello(now);
  if (give_up_.count() == 0 || now - heard_ < give_up_) return false;
  fault_ = fmt::format("nothing was heard from the robot at {} for {} s", print_address(robot_),
                       static_cast<double>(give_up_.count()) / 1000);
  if (counters_.other_version > 0) fault_ += ", but for datagrams of another version of the protocol";
  return true;
}

void HostSession::want_frames(Clock::time_point now) {
  if (ready_ || !description_) return;
  ready_ = true;
  say_hello(now);
}

std::optional<std::uint64_t> HostSession::next(Bytes& frame) {
  if (!inbox_) return std::nullopt;
  return inbox_->next(frame);
}

void HostSession::answer(Answer answer, Clock::time_point now) {
  answer.number = answers_++;
  write_answer(answer, payload_, version_);
  send({.type = Type::kAnswer, .sequence = answer.sequence}, payload_, now);
  if (!inbox_ || answer.status == HW_ANSWER_END) return;
  last_answer_ = datagram_;
  inbox_->answered(answer.sequence);
}

void HostSession::say_bye(Clock::time_point now) {
  send({.type = Type::kBye, .flags = kReplyWanted}, {}, now);
}

void HostSession::say_hello(Clock::time_point now) {
  const int offer = newest_ > kFirstVersion ? kOffersVersion2 : 0;
  const auto flags = static_cast<std::uint16_t>(offer | (ready_ ? kReady : 0));
  send({.type = Type::kHello, .flags = flags, .sequence = nonce_}, {}, now);
}

void HostSession::send(Header header, std::span<const std::byte> payload, Clock::time_point now) {
  header.session = session_;
  header.version = header.type == Type::kHello ? kFirstVersion : version_;
  write_datagram(header, payload, datagram_);
  wire_.send(datagram_, robot_);
  sent_ = now;
}

HostCounters HostSession::counters() const {
  HostCounters counters = counters_;
  if (inbox_) counters.frames = inbox_->counters();
  return counters;
}

}  // namespace hallway::link
