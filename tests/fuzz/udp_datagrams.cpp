// SPDX-License-Identifier: MIT
// The bytes as datagrams, each behind two bytes of its length, that reach both ends of a session. Whatever they are, nothing crashes, each is counted once,
// and what is held stays small. The first byte says whether the session is in lock-step, whether check sums are mended before a datagram is given (else few
// would pass), how much of the greeting is spared, and whether version 2 of the protocol is offered and spoken.
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "host/samples/frame_bytes.hpp"
#include "link/host_session.hpp"
#include "link/robot_end.hpp"

using namespace hallway::link;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr std::uint32_t kSession = 1;
constexpr std::uint64_t kNonce = 2;
constexpr std::uint8_t kLockStep = 1;
constexpr std::uint8_t kMend = 2;
constexpr std::uint8_t kDescribed = 4;
constexpr std::uint8_t kVersion2 = 8;

/// Gives what it is told to and swallows what is sent.
class Feed final : public Wire {
 public:
  void send(std::span<const std::byte> datagram, const Address&) override {
    if (std::holds_alternative<Refusal>(read_datagram(datagram))) std::abort();
  }
  std::optional<std::size_t> receive(std::span<std::byte> room, Address& from,
                                     std::chrono::milliseconds) override {
    if (next.empty()) return std::nullopt;
    from = {};
    std::copy_n(next.begin(), std::min(next.size(), room.size()), room.begin());
    const std::size_t size = next.size();
    next.clear();
    return size;
  }

  Bytes next;
};

std::uint8_t version_of(std::uint8_t options) {
  return (options & kVersion2) != 0 ? kNewestVersion : kFirstVersion;
}

void mend(Bytes& datagram, std::uint8_t version) {
  if (datagram.size() < kHeaderBytes) return;
  const auto payload = static_cast<std::uint16_t>(datagram.size() - kHeaderBytes);
  if (datagram[5] == std::byte{1}) version = kFirstVersion;  // a hello
  std::memcpy(datagram.data(), "HWUD", 4);
  std::memcpy(datagram.data() + 4, &version, 1);
  std::memcpy(datagram.data() + 28, &payload, sizeof payload);
  std::memset(datagram.data() + 12, 0, 4);
  const auto* bytes = reinterpret_cast<const unsigned char*>(datagram.data());
  const auto sum = static_cast<std::uint32_t>(::crc32(0, bytes, static_cast<uInt>(datagram.size())));
  std::memcpy(datagram.data() + 12, &sum, sizeof sum);
}

std::vector<Bytes> split(std::span<const std::uint8_t> data, std::uint8_t options) {
  std::vector<Bytes> datagrams;
  while (data.size() >= 2) {
    const std::size_t length = std::min<std::size_t>(data[0] + 256u * data[1], data.size() - 2);
    Bytes& datagram = datagrams.emplace_back(length);
    for (std::size_t i = 0; i < length; ++i) datagram[i] = std::byte{data[i + 2]};
    if ((options & kMend) != 0) mend(datagram, version_of(options));
    data = data.subspan(2 + length);
  }
  return datagrams;
}

void check_host(const std::vector<Bytes>& datagrams, std::uint8_t options) {
  Feed wire;
  Clock::time_point now{};
  HostSession session(wire, {}, kNonce, std::chrono::milliseconds(5000), now, version_of(options));
  if ((options & kDescribed) != 0) {
    Description robot;
    robot.lock_step = (options & kLockStep) != 0;
    Bytes bytes;
    const std::uint8_t version = version_of(options);
    write_datagram({.type = Type::kDescription, .session = kSession, .sequence = kNonce, .version = version},
                   write_description(robot, version), bytes);
    session.take(bytes, {}, now);
    session.want_frames(now);
  }
  Bytes frame;
  hallway::host::FrameReader reader;
  for (const Bytes& datagram : datagrams) {
    session.take(datagram, {}, now += std::chrono::milliseconds(10));
    session.tick(now);
    const auto sequence = session.next(frame);
    if (!sequence) continue;
    try {
      reader.read(frame);
    } catch (const hallway::Error&) {  // whole, and no frame
    }
    session.answer({.sequence = *sequence}, now);
  }
  const HostCounters counters = session.counters();
  const FrameCounters& frames = counters.frames;
  if (counters.malformed + counters.other_version + counters.foreign + frames.late + frames.duplicates +
          frames.misfits >
      counters.datagrams) {
    std::abort();
  }
  if (frames.incomplete > frames.lost || frames.skipped > frames.frames) std::abort();
}

void check_robot(const std::vector<Bytes>& datagrams, std::uint8_t options) {
  Feed wire;
  RobotEnd robot(wire, {}, kSession, std::chrono::milliseconds(0), version_of(options));
  const Bytes frame(3 * kFragmentBytes);
  std::uint64_t sequence = 0;
  for (const Bytes& datagram : datagrams) {
    wire.next = datagram;
    robot.wait(RobotEnd::Clock::time_point{});
    // Only the first: what paces a large frame would take time.
    if (robot.host() && sequence == 0) robot.send(sequence++, frame);
    while (const auto came = robot.next_answer()) {
      if (came->answer.status > HW_ANSWER_END) std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto datagrams = split(std::span(data, size).subspan(1), data[0]);
  check_host(datagrams, data[0]);
  check_robot(datagrams, data[0]);
  return 0;
}
