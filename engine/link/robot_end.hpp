// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "link/description.hpp"
#include "link/messages.hpp"
#include "link/wire.hpp"

namespace hallway::link {

/// What became of the datagrams of the robot's side.
struct RobotCounters {
  std::uint64_t frames = 0;            ///< sent
  std::uint64_t datagrams = 0;         ///< of frames, sent for the first time
  std::uint64_t resent = 0;            ///< of frames, sent again
  std::uint64_t answers = 0;           ///< that came
  std::uint64_t repeated_answers = 0;  ///< that came again, or after a later one
  std::uint64_t malformed =
      0;                      ///< datagrams that were damaged, of a wrong length or version, or without sense
  std::uint64_t foreign = 0;  ///< datagrams from another address, or of another session
};

/// An answer as it came.
struct CameAnswer {
  Answer answer;
  std::optional<std::chrono::nanoseconds>
      round_trip{};  ///< since its frame was first sent, where that is still known
};

/// The robot's side of one session: it waits for a host, tells it what it is, sends frames and takes answers. All in the caller's thread; what comes is
/// taken while one of the functions waits.
class RobotEnd {
 public:
  using Clock = std::chrono::steady_clock;

  /// Keeps a reference to `wire`. Throws Error{kBadInput} for a description that cannot be sent.
  /// @param session  names the session; another one for each start of the robot
  /// @param give_up  for how long a host may be silent; 0: for ever
  /// @param newest   the newest version of the protocol that it speaks; a host gets that if it offers it, else the first
  RobotEnd(Wire& wire, const Description& description, std::uint32_t session,
           std::chrono::milliseconds give_up, std::uint8_t newest = kNewestVersion);

  /// Takes what comes until `deadline`, or until a signal, but not longer than one datagram. @return whether one came
  bool wait(Clock::time_point deadline);
  /// Whether a host has said that frames may come.
  bool wanted() const { return wanted_; }
  /// Whether the session is over: the host has said bye, or was silent for too long.
  bool over() const { return over_; }
  bool gave_up() const { return gave_up_; }
  /// The host of the session.
  const std::optional<Address>& host() const { return host_; }
  /// The version of the protocol that it gets.
  std::uint8_t version() const { return version_; }

  /// Real time: sends a frame once. Takes what comes meanwhile.
  /// @param frame  its bytes; Error{kBadInput} if they are more than a frame may have
  void send(std::uint64_t sequence, std::span<const std::byte> frame);
  /// Lock-step: sends a frame, and what is lost of it again, until it is answered.
  /// @param stop  asked several times a second; true ends it
  /// @return whether it was answered; else the session is over or was stopped
  bool deliver(std::uint64_t sequence, std::span<const std::byte> frame, const std::function<bool()>& stop);
  /// The oldest answer that was not yet taken.
  std::optional<CameAnswer> next_answer();
  /// Says bye, several times until the host says so too, and waits for that: two seconds at most.
  void leave();

  const RobotCounters& counters() const { return counters_; }

 private:
  /// What is known of the frame that is being delivered.
  struct Delivery {
    std::uint64_t sequence = 0;
    std::vector<bool> missing;
    bool told = false;  ///< the host has told what is missing, since that was last asked
    bool answered = false;
  };

  void take(std::span<const std::byte> bytes, const Address& from);
  void take_hello(const Header& header, const Address& from);
  void take_from_host(const Datagram& datagram);
  void take_answer(const Datagram& datagram);
  void describe();
  void put(Header header, std::span<const std::byte> payload);
  void send_fragment(std::span<const std::byte> frame, std::size_t fragment, std::uint16_t flags);
  std::size_t send_missing(std::span<const std::byte> frame);
  void note_sent(std::uint64_t sequence);
  void begin(std::uint64_t sequence, std::span<const std::byte> frame);

  Wire& wire_;
  std::array<Bytes, kNewestVersion> descriptions_;  ///< by version, from the first
  std::uint32_t session_;
  std::uint8_t newest_;
  std::uint8_t version_ = kFirstVersion;  ///< of the session
  std::chrono::milliseconds give_up_;
  std::optional<Address> host_;
  std::uint64_t nonce_ = 0;  ///< of the host
  Clock::time_point heard_{};
  bool wanted_ = false;
  bool over_ = false;
  bool gave_up_ = false;
  bool bye_heard_ = false;
  bool delivering_ = false;
  int byes_ = 0;  ///< that came while an answer was owed
  Delivery delivery_;
  std::vector<bool> sent_once_;  ///< by fragment of the frame that is being sent
  std::deque<std::pair<std::uint64_t, Clock::time_point>> sent_;  ///< when the last frames were sent
  std::optional<std::uint64_t> last_answer_;                      ///< its number
  std::deque<CameAnswer> answers_;
  RobotCounters counters_;
  Bytes datagram_;
};

}  // namespace hallway::link
