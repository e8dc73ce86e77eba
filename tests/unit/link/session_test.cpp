// SPDX-License-Identifier: MIT
// Both ends, each with its clock and its thread.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <set>

#include "link/host_end.hpp"
#include "link/lossy_wire.hpp"
#include "link/robot_end.hpp"
#include "link/udp_wire.hpp"
#include "support/errors.hpp"
#include "unit/link/datagrams.hpp"
#include "unit/link/memory_wire.hpp"

namespace hallway::link {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr milliseconds kGiveUp{120'000};
constexpr std::uint32_t kSession = 7;

RobotEnd::Clock::time_point soon() {
  return RobotEnd::Clock::now() + milliseconds{20};
}

/// A host program that takes every frame and answers with its number, until the end.
class Program {
 public:
  Program(Wire& wire, const Address& robot, std::uint8_t newest = kNewestVersion)
      : end_(wire, robot, 42, kGiveUp, newest), thread_([this] { run(); }) {}
  ~Program() { thread_.join(); }

  /// Waits for its end. @return the frames that it was given
  std::vector<Bytes> frames() {
    if (thread_.joinable()) thread_.join();
    thread_ = std::thread([] {});
    return frames_;
  }
  HostCounters counters() const { return end_.counters(); }
  std::uint8_t version() const { return end_.version(); }

 private:
  void run() {
    end_.describe();
    for (;;) {
      const HostEnd::Reading reading = end_.read(milliseconds{100});
      if (reading.found == HostEnd::Found::kEnd) return;
      if (reading.found == HostEnd::Found::kNothing) continue;
      const hw_frame_t& frame = *reading.frame;
      host::FrameWriter().write_over(frames_.emplace_back(), frame);
      end_.answer({.sequence = frame.sequence,
                   .t_ns = frame.t_ns,
                   .command = host::DriveCommand{static_cast<double>(frame.sequence), 0.5}});
    }
  }

  HostEnd end_;
  std::vector<Bytes> frames_;
  std::thread thread_;
};

void wait_until_wanted(RobotEnd& robot) {
  const auto limit = RobotEnd::Clock::now() + seconds{20};
  while (!robot.wanted() && RobotEnd::Clock::now() < limit) robot.wait(soon());
  ASSERT_TRUE(robot.wanted());
}

/// The newest version of the protocol that each side speaks.
struct Versions {
  std::uint8_t robot = kNewestVersion;
  std::uint8_t host = kNewestVersion;
};

/// Sends frames of those sizes in lock-step, and expects that each comes, once and in order, and is answered.
void expect_all_in_order(Wire& robot_wire, const Address& robot_address, Wire& host_wire,
                         const std::vector<std::size_t>& points, Versions versions = {}) {
  RobotEnd robot(robot_wire, description(true), kSession, kGiveUp, versions.robot);
  Program program(host_wire, robot_address, versions.host);
  wait_until_wanted(robot);
  std::vector<Bytes> frames;
  for (std::size_t k = 0; k < points.size(); ++k) {
    frames.push_back(frame_of(k, points[k], static_cast<std::int64_t>(k) * 100));
    ASSERT_TRUE(robot.deliver(k, frames.back(), [] { return false; })) << k;
    const auto came = robot.next_answer();
    ASSERT_TRUE(came);
    EXPECT_EQ(came->answer.sequence, k);
    EXPECT_EQ(came->answer.t_ns, static_cast<std::int64_t>(k) * 100);
    EXPECT_EQ(came->answer.command, (host::DriveCommand{static_cast<double>(k), 0.5}));
    EXPECT_TRUE(came->round_trip);
    EXPECT_FALSE(robot.next_answer());
  }
  robot.leave();
  EXPECT_TRUE(program.frames() == frames);
  EXPECT_EQ(robot.counters().answers, points.size());
  EXPECT_EQ(program.counters().frames.frames, points.size());
  EXPECT_EQ(program.counters().other_version, 0u);
  EXPECT_EQ(robot.version(), std::min(versions.robot, versions.host));
  EXPECT_EQ(program.version(), std::min(versions.robot, versions.host));
}

/// Notes which versions the datagrams have, but for hellos.
class NotingWire final : public Wire {
 public:
  explicit NotingWire(Wire& wire) : wire_(wire) {}
  void send(std::span<const std::byte> datagram, const Address& to) override {
    if (datagram[5] != std::byte{static_cast<std::uint8_t>(Type::kHello)})
      versions.insert(std::to_integer<int>(datagram[4]));
    wire_.send(datagram, to);
  }
  std::optional<std::size_t> receive(std::span<std::byte> room, Address& from, milliseconds wait) override {
    return wire_.receive(room, from, wait);
  }

  std::set<int> versions;

 private:
  Wire& wire_;
};

TEST(LockStep, SidesOfDifferentVersionsSpeakTheOlderOne) {
  for (const Versions versions : {Versions{1, 1}, Versions{1, 2}, Versions{2, 1}, Versions{2, 2}}) {
    SCOPED_TRACE(fmt::format("robot {}, host {}", versions.robot, versions.host));
    MemoryNet net;
    MemoryWire robot_wire(net, 1);
    MemoryWire host_wire(net, 2);
    LossyWire lossy_robot(robot_wire, 0.05, 3);
    NotingWire robot(lossy_robot), host(host_wire);
    expect_all_in_order(robot, robot_wire.address(), host, {5, 300, 0, 4000}, versions);
    const std::set<int> expected{std::min(versions.robot, versions.host)};
    EXPECT_EQ(robot.versions, expected);
    EXPECT_EQ(host.versions, expected);
  }
}

TEST(LockStep, GivesEveryFrameOverAWireThatLosesNothing) {
  MemoryNet net;
  MemoryWire robot(net, 1);
  MemoryWire host(net, 2);
  expect_all_in_order(robot, robot.address(), host, {10, 0, 1, 100, 20'000, 3});
}

TEST(LockStep, GivesEveryFrameWhateverIsLost) {
  for (const double loss : {0.01, 0.1, 0.3}) {
    MemoryNet net;
    MemoryWire robot(net, 1);
    MemoryWire host(net, 2);
    LossyWire lossy_robot(robot, loss / 2, 3);
    LossyWire lossy_host(host, loss / 2, 4);
    expect_all_in_order(lossy_robot, robot.address(), lossy_host, {5, 300, 0, 20'000, 1, 60, 4000});
  }
}

TEST(LockStep, OverSocketsOfBothKinds) {
  for (const char* listen : {"127.0.0.1:0", "[::1]:0"}) {
    std::optional<UdpWire> robot;
    try {
      robot.emplace(parse_address(listen));
    } catch (const Error&) {
      if (listen[0] == '[') continue;  // a machine without IPv6
      throw;
    }
    UdpWire host(local_address_towards(robot->address()));
    LossyWire lossy(host, 0.01, 5);
    expect_all_in_order(*robot, robot->address(), lossy, {5, 300, 20'000, 1, 20'000});
  }
}

TEST(RealTime, FramesComeAndAreAnswered) {
  MemoryNet net;
  MemoryWire robot_wire(net, 1);
  MemoryWire host_wire(net, 2);
  RobotEnd robot(robot_wire, description(false), kSession, kGiveUp);
  Program program(host_wire, robot_wire.address());
  wait_until_wanted(robot);
  // Each waits for its answer, so that none is passed over by the next one.
  std::vector<Bytes> frames;
  for (std::uint64_t k = 0; k < 5; ++k) {
    frames.push_back(frame_of(k, 2000, static_cast<std::int64_t>(k)));
    robot.send(k, frames.back());
    const auto limit = RobotEnd::Clock::now() + seconds{20};
    std::optional<CameAnswer> answer;
    while (!(answer = robot.next_answer()) && RobotEnd::Clock::now() < limit) robot.wait(soon());
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->answer.sequence, k);
  }
  robot.leave();
  EXPECT_TRUE(program.frames() == frames);
  EXPECT_EQ(program.counters().frames.lost, 0u);
  EXPECT_EQ(robot.counters().resent, 0u);
}

TEST(RealTime, SidesOfDifferentVersionsSpeakTheOlderOne) {
  for (const Versions versions : {Versions{1, 2}, Versions{2, 1}, Versions{2, 2}}) {
    SCOPED_TRACE(fmt::format("robot {}, host {}", versions.robot, versions.host));
    MemoryNet net;
    MemoryWire robot_wire(net, 1), host_wire(net, 2);
    RobotEnd robot(robot_wire, description(false), kSession, kGiveUp, versions.robot);
    Program program(host_wire, robot_wire.address(), versions.host);
    wait_until_wanted(robot);
    const Bytes frame = frame_of(0, 2000, 0);
    robot.send(0, frame);
    const auto limit = RobotEnd::Clock::now() + seconds{20};
    std::optional<CameAnswer> answer;
    while (!(answer = robot.next_answer()) && RobotEnd::Clock::now() < limit) robot.wait(soon());
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->answer.command, (host::DriveCommand{0, 0.5}));
    robot.leave();
    EXPECT_TRUE(program.frames() == std::vector<Bytes>{frame});
    EXPECT_EQ(robot.version(), std::min(versions.robot, versions.host));
  }
}

TEST(RealTime, LossIsCountedAndHoldsNothingUp) {
  MemoryNet net;
  MemoryWire robot_wire(net, 1);
  MemoryWire host_wire(net, 2);
  LossyWire lossy(robot_wire, 0.3, 11);
  RobotEnd robot(lossy, description(false), kSession, kGiveUp);
  Program program(host_wire, robot_wire.address());
  wait_until_wanted(robot);
  constexpr std::uint64_t kFrames = 200;
  for (std::uint64_t k = 0; k < kFrames; ++k) {
    robot.send(k, frame_of(k, 100, static_cast<std::int64_t>(k)));
    robot.wait(RobotEnd::Clock::now());
  }
  robot.leave();
  const std::size_t given = program.frames().size();
  const FrameCounters counters = program.counters().frames;
  EXPECT_EQ(given + counters.skipped, counters.frames);
  EXPECT_GT(counters.lost, 0u);
  EXPECT_GT(counters.incomplete, 0u);
  EXPECT_LE(counters.frames + counters.lost, kFrames);
  EXPECT_GT(counters.frames, kFrames / 10);
}

TEST(RealTime, AnotherThreadMayAnswerWhileOneReads) {
  MemoryNet net;
  MemoryWire robot_wire(net, 1);
  MemoryWire host_wire(net, 2);
  RobotEnd robot(robot_wire, description(false), kSession, kGiveUp);
  HostEnd host(host_wire, robot_wire.address(), 42, kGiveUp);
  std::atomic<bool> stop = false;
  std::thread serves([&] {
    while (!robot.wanted()) robot.wait(soon());
    for (std::uint64_t k = 0; !stop; ++k) {
      robot.send(k, frame_of(k, 100, static_cast<std::int64_t>(k)));
      robot.wait(soon());
    }
  });
  host.describe();
  std::thread answers([&] {
    for (std::uint64_t k = 0; k < 300; ++k) host.answer({.status = HW_ANSWER_LATE, .sequence = k});
  });
  for (int frames = 0; frames < 20;) frames += host.read(seconds{20}).found == HostEnd::Found::kFrame ? 1 : 0;
  answers.join();
  stop = true;
  serves.join();
  std::uint64_t next = 0;
  while (robot.wait(RobotEnd::Clock::now())) continue;
  while (const auto came = robot.next_answer()) EXPECT_EQ(came->answer.number, next++);
  EXPECT_EQ(next, 300u);
}

TEST(RealTime, WhatIsNoFrameIsPassedOver) {
  MemoryNet net;
  MemoryWire robot_wire(net, 1);
  MemoryWire host_wire(net, 2);
  RobotEnd robot(robot_wire, description(false), kSession, kGiveUp);
  HostEnd host(host_wire, robot_wire.address(), 42, kGiveUp);
  std::thread listens([&] {
    while (!robot.wanted()) robot.wait(soon());
  });
  host.describe();
  EXPECT_EQ(host.read(milliseconds{1}).found, HostEnd::Found::kNothing);
  listens.join();
  const auto give = [&](std::uint64_t sequence, const Bytes& bytes) {
    robot.send(sequence, bytes);
    const auto limit = RobotEnd::Clock::now() + seconds{20};
    while (host.counters().frames.frames <= sequence && RobotEnd::Clock::now() < limit)
      std::this_thread::sleep_for(milliseconds{1});
    return host.read(milliseconds{0});
  };
  EXPECT_EQ(give(0, some_bytes(100)).found, HostEnd::Found::kNothing);
  EXPECT_EQ(give(1, frame_of(2, 3, 5)).found, HostEnd::Found::kNothing) << "another number";
  EXPECT_EQ(give(2, frame_of(2, 3, 5)).found, HostEnd::Found::kFrame);
  EXPECT_EQ(give(3, frame_of(3, 3, 4)).found, HostEnd::Found::kNothing) << "time goes back";
  EXPECT_EQ(give(4, frame_of(4, 3, 5)).found, HostEnd::Found::kFrame);
  EXPECT_EQ(host.bad_frames(), 3u);
}

TEST(LockStep, WhatIsNoFrameIsAnError) {
  MemoryNet net;
  MemoryWire robot_wire(net, 1);
  MemoryWire host_wire(net, 2);
  RobotEnd robot(robot_wire, description(true), kSession, kGiveUp);
  HostEnd host(host_wire, robot_wire.address(), 42, kGiveUp);
  std::atomic<bool> stop = false;
  std::thread sends([&] {
    while (!robot.wanted()) robot.wait(soon());
    robot.deliver(0, some_bytes(100), [&] { return stop.load(); });
  });
  host.describe();
  const auto error = hallway::test::error_of([&] { host.read(seconds{20}); });
  stop = true;
  sends.join();
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
}

TEST(RobotEnd, ServesTheFirstHostAndNoOther) {
  MemoryNet net;
  MemoryWire robot_wire(net, 1);
  MemoryWire first(net, 2);
  MemoryWire second(net, 3);
  RobotEnd robot(robot_wire, description(true), kSession, kGiveUp);
  const auto heard = [&](MemoryWire& wire, const Bytes& bytes) {
    wire.send(bytes, robot_wire.address());
    EXPECT_TRUE(robot.wait(RobotEnd::Clock::now() + seconds{20}));
    return net.get(wire.address(), milliseconds{0}).has_value();
  };
  EXPECT_FALSE(heard(second, some_bytes(60)));
  EXPECT_FALSE(robot.host());
  EXPECT_FALSE(heard(second, datagram_of({.type = Type::kAnswer, .session = kSession}, some_bytes(104))));
  EXPECT_TRUE(heard(first, datagram_of({.type = Type::kHello, .sequence = 42})));
  EXPECT_EQ(robot.host(), first.address());
  EXPECT_FALSE(robot.wanted());
  EXPECT_FALSE(heard(second, datagram_of({.type = Type::kHello, .flags = kReady, .sequence = 43})));
  EXPECT_FALSE(robot.wanted());
  EXPECT_FALSE(heard(second, datagram_of({.type = Type::kBye, .session = kSession})));
  EXPECT_FALSE(robot.over());
  EXPECT_EQ(robot.counters().foreign, 3u);
  EXPECT_TRUE(heard(
      first, datagram_of({.type = Type::kHello, .flags = kReady, .session = kSession, .sequence = 42})));
  EXPECT_TRUE(robot.wanted());
  // A host program that was started again knows nothing of the frames before.
  EXPECT_FALSE(heard(first, datagram_of({.type = Type::kHello, .sequence = 44})));
  EXPECT_TRUE(robot.over());
  EXPECT_FALSE(robot.gave_up());
}

TEST(RobotEnd, AHelloHasTheFirstVersionAndTheRestThatOfTheSession) {
  MemoryNet net;
  MemoryWire robot_wire(net, 1), host(net, 2);
  RobotEnd robot(robot_wire, description(true), kSession, kGiveUp);
  const auto give = [&](const Header& header) {
    host.send(datagram_of(header), robot_wire.address());
    EXPECT_TRUE(robot.wait(RobotEnd::Clock::now() + seconds{20}));
  };
  give({.type = Type::kHello, .flags = kOffersVersion2, .sequence = 42, .version = kNewestVersion});
  EXPECT_FALSE(robot.host());
  give({.type = Type::kHello, .flags = kOffersVersion2, .sequence = 42});
  EXPECT_EQ(robot.host(), host.address());
  EXPECT_EQ(robot.version(), kNewestVersion);
  const auto described = net.get(host.address(), seconds{20});
  ASSERT_TRUE(described);
  EXPECT_EQ(described->first[4], std::byte{kNewestVersion});
  give({.type = Type::kBye, .session = kSession});
  EXPECT_FALSE(robot.over());
  EXPECT_EQ(robot.counters().malformed, 2u);
  give({.type = Type::kBye, .session = kSession, .version = kNewestVersion});
  EXPECT_TRUE(robot.over());
}

TEST(RobotEnd, GivesUpAHostThatIsSilent) {
  MemoryNet net;
  MemoryWire robot_wire(net, 1);
  MemoryWire host_wire(net, 2);
  RobotEnd robot(robot_wire, description(true), kSession, milliseconds{100});
  host_wire.send(datagram_of({.type = Type::kHello, .flags = kReady, .sequence = 42}), robot_wire.address());
  while (!robot.wanted()) robot.wait(soon());
  EXPECT_FALSE(robot.deliver(0, frame_of(0, 1, 0), [] { return false; }));
  EXPECT_TRUE(robot.gave_up());
}

TEST(RobotEnd, RefusesFramesThatTheProtocolCannotCarry) {
  MemoryNet net;
  MemoryWire wire(net, 1);
  RobotEnd robot(wire, description(true), kSession, kGiveUp);
  EXPECT_TRUE(hallway::test::error_of([&] { robot.send(0, {}); }));
  EXPECT_TRUE(hallway::test::error_of([&] { robot.send(0, Bytes(kMaxFrameMessageBytes + 1)); }));
}

TEST(HostEnd, LeavesAndTheRobotHearsOfIt) {
  MemoryNet net;
  MemoryWire robot_wire(net, 1);
  MemoryWire host_wire(net, 2);
  RobotEnd robot(robot_wire, description(true), kSession, kGiveUp);
  std::atomic<bool> delivered = false;
  std::thread serves([&] {
    while (!robot.wanted()) robot.wait(soon());
    delivered = robot.deliver(0, frame_of(0, 10, 0), [] { return false; });
    EXPECT_FALSE(robot.deliver(1, frame_of(1, 10, 0), [] { return false; }));
  });
  HostEnd host(host_wire, robot_wire.address(), 42, kGiveUp);
  host.describe();
  EXPECT_EQ(host.read(seconds{20}).found, HostEnd::Found::kFrame);
  host.answer({.sequence = 0});
  host.answer({.status = HW_ANSWER_END, .sequence = 0});
  host.leave();
  serves.join();
  EXPECT_TRUE(delivered);
  EXPECT_TRUE(robot.over());
  EXPECT_FALSE(robot.gave_up());
}

TEST(LossyWire, LosesTheSameForTheSameSeed) {
  const auto that_arrive = [](std::uint64_t seed) {
    MemoryNet net;
    MemoryWire a(net, 1);
    MemoryWire b(net, 2);
    LossyWire lossy(a, 0.25, seed);
    for (std::size_t i = 0; i < 1000; ++i) lossy.send(Bytes{static_cast<std::byte>(i & 0xff)}, b.address());
    std::vector<std::byte> numbers;
    while (const auto got = net.get(b.address(), milliseconds{0})) numbers.push_back(got->first.at(0));
    return numbers;
  };
  EXPECT_EQ(that_arrive(1), that_arrive(1));
  EXPECT_NE(that_arrive(1), that_arrive(2));
  EXPECT_NEAR(static_cast<double>(that_arrive(1).size()), 750, 60);
}

TEST(UdpWire, CannotHaveAnAddressTwice) {
  const UdpWire first(parse_address("127.0.0.1:0"));
  EXPECT_NE(first.address().port, 0);
  const auto error = hallway::test::error_of([&] { UdpWire again(first.address()); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kIo);
  EXPECT_NE(std::string(error->what()).find(print_address(first.address())), std::string::npos)
      << error->what();
}

}  // namespace
}  // namespace hallway::link
