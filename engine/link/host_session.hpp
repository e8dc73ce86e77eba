// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "link/assembly.hpp"
#include "link/description.hpp"
#include "link/frame_inbox.hpp"
#include "link/messages.hpp"
#include "link/wire.hpp"

namespace hallway::link {

using Clock = std::chrono::steady_clock;

/// What became of the datagrams that reached the host.
struct HostCounters {
  FrameCounters frames{};
  std::uint64_t datagrams = 0;      ///< that came, of every kind
  std::uint64_t malformed = 0;      ///< damaged, of a wrong length, or without sense
  std::uint64_t other_version = 0;  ///< of a version of the protocol that the session does not have
  std::uint64_t foreign = 0;        ///< from another address, or of another session
};

/// The host's side of a session as a function of the datagrams that come and of time; it sends through a wire and never waits. Not for several
/// threads at once.
class HostSession {
 public:
  /// Says hello. Keeps a reference to `wire`.
  /// @param nonce    names this host program; another one for each start of it
  /// @param give_up  for how long the robot may be silent; 0: for ever
  /// @param newest   the newest version of the protocol that the hello offers
  HostSession(Wire& wire, const Address& robot, std::uint64_t nonce, std::chrono::milliseconds give_up,
              Clock::time_point now, std::uint8_t newest = kNewestVersion);

  /// Takes bytes that have come. @return whether there is news: a description, a frame, an end or a fault
  bool take(std::span<const std::byte> bytes, const Address& from, Clock::time_point now);
  /// Does what is due: says hello again, gives up. @return whether there is news
  bool tick(Clock::time_point now);

  /// What the robot said of itself.
  const std::optional<Description>& description() const { return description_; }
  /// The version of the protocol that this session has. Only once the robot is described.
  std::uint8_t version() const { return version_; }
  /// Tells the robot that frames may come. Only once it is described.
  void want_frames(Clock::time_point now);
  /// Moves the next frame into `frame`. @return its sequence number; empty if there is none
  std::optional<std::uint64_t> next(Bytes& frame);
  /// Sends an answer; its number is set here.
  void answer(Answer answer, Clock::time_point now);
  /// Tells the robot that the session is over.
  void say_bye(Clock::time_point now);

  /// Whether the robot has said that there will be no more.
  bool ended() const { return ended_; }
  /// Why the session cannot go on; empty if it can.
  const std::string& fault() const { return fault_; }
  HostCounters counters() const;

 private:
  bool take_description(const Datagram& datagram);
  bool take_frame(const Datagram& datagram, Clock::time_point now);
  bool take_bye(const Datagram& datagram, Clock::time_point now);
  void say_hello(Clock::time_point now);
  void send(Header header, std::span<const std::byte> payload, Clock::time_point now);
  bool of_this_session(const Header& header);
  bool has_version(const Header& header);

  Wire& wire_;
  Address robot_;
  std::uint64_t nonce_;
  std::chrono::milliseconds give_up_;
  Clock::time_point heard_;  ///< from the robot, last
  Clock::time_point sent_;   ///< to it, last
  bool ready_ = false;
  std::uint32_t session_ = 0;
  std::uint8_t newest_;
  std::uint8_t version_ = kFirstVersion;  ///< of the session, once the robot is described
  Assembly description_parts_;
  std::optional<Description> description_;
  std::unique_ptr<FrameInbox> inbox_;
  std::uint64_t answers_ = 0;
  Bytes last_answer_;  ///< the datagram, in case that it is asked for again
  bool ended_ = false;
  std::string fault_;
  HostCounters counters_;
  Bytes payload_;
  Bytes datagram_;
};

}  // namespace hallway::link
