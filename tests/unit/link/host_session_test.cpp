// SPDX-License-Identifier: MIT
#include "link/host_session.hpp"

#include <gtest/gtest.h>

#include "unit/link/datagrams.hpp"

namespace hallway::link {
namespace {

using std::chrono::milliseconds;

/// Keeps what is sent.
class Recorder final : public Wire {
 public:
  void send(std::span<const std::byte> datagram, const Address&) override {
    sent.emplace_back(datagram.begin(), datagram.end());
  }
  std::optional<std::size_t> receive(std::span<std::byte>, Address&, milliseconds) override {
    return std::nullopt;
  }

  std::vector<Bytes> sent;
};

constexpr std::uint64_t kNonce = 42;
constexpr std::uint32_t kSession = 7;

/// A session and the clock that it lives by.
class Session : public testing::Test {
 protected:
  bool give(const Bytes& bytes) { return session_.take(bytes, robot_, now_); }
  bool give(Header header, std::span<const std::byte> payload = {}) {
    header.session = kSession;
    return give(datagram_of(header, payload));
  }
  bool describe(bool lock_step) {
    return give({.type = Type::kDescription, .sequence = kNonce},
                write_description(description(lock_step), kFirstVersion));
  }
  bool frame(std::uint64_t sequence, std::uint16_t flags = 0) {
    return give({.type = Type::kFrame, .flags = flags, .sequence = sequence},
                frame_of(sequence, 2, static_cast<std::int64_t>(sequence)));
  }
  Header last_sent() const { return std::get<Datagram>(read_datagram(wire_.sent.back())).header; }
  bool pass(milliseconds time) {
    now_ += time;
    return session_.tick(now_);
  }

  Recorder wire_;
  Address robot_{.ip = {127, 0, 0, 1}, .port = 7000};
  Clock::time_point now_{};
  HostSession session_{wire_, robot_, kNonce, milliseconds{5000}, now_};
};

TEST_F(Session, SaysHelloUntilTheRobotIsDescribed) {
  EXPECT_EQ(wire_.sent.size(), 1u);
  EXPECT_EQ(last_sent().type, Type::kHello);
  EXPECT_EQ(last_sent().sequence, kNonce);
  EXPECT_EQ(last_sent().flags, kOffersVersion2);
  EXPECT_EQ(last_sent().version, kFirstVersion) << "every robot reads it";
  pass(milliseconds{50});
  EXPECT_EQ(wire_.sent.size(), 1u);
  pass(milliseconds{60});
  EXPECT_EQ(wire_.sent.size(), 2u);
  EXPECT_TRUE(describe(true));
  ASSERT_TRUE(session_.description());
  EXPECT_EQ(session_.description()->name, "office");
  EXPECT_FALSE(describe(true)) << "no news";
  session_.want_frames(now_);
  EXPECT_EQ(last_sent().flags, kReady | kOffersVersion2);
  EXPECT_EQ(last_sent().session, kSession);
  // Until a frame comes, as the robot may not have heard it.
  const std::size_t before = wire_.sent.size();
  pass(milliseconds{110});
  EXPECT_EQ(wire_.sent.size(), before + 1);
  EXPECT_TRUE(frame(0));
  pass(milliseconds{110});
  EXPECT_EQ(wire_.sent.size(), before + 1);
  pass(milliseconds{1000});
  EXPECT_EQ(last_sent().type, Type::kHello) << "a sign of life";
}

TEST_F(Session, GivesUpARobotThatIsSilent) {
  EXPECT_FALSE(pass(milliseconds{4999}));
  EXPECT_TRUE(pass(milliseconds{2}));
  EXPECT_NE(session_.fault().find("127.0.0.1:7000 for 5 s"), std::string::npos) << session_.fault();
  EXPECT_FALSE(pass(milliseconds{2})) << "once";
}

TEST_F(Session, ASignOfLifeIsNoSilence) {
  describe(false);
  for (int i = 0; i < 10; ++i) {
    pass(milliseconds{4000});
    describe(false);
  }
  EXPECT_EQ(session_.fault(), "");
}

TEST_F(Session, TellsOfAnotherVersionOfTheProtocol) {
  Bytes bytes = datagram_of({.type = Type::kDescription});
  bytes[4] = std::byte{9};
  EXPECT_FALSE(give(bytes));
  EXPECT_EQ(session_.counters().other_version, 1u);
  pass(milliseconds{6000});
  EXPECT_NE(session_.fault().find("another version"), std::string::npos) << session_.fault();
}

TEST_F(Session, ARobotOfTheFirstVersionGetsTheFirstVersion) {
  EXPECT_TRUE(describe(true));
  EXPECT_EQ(session_.version(), kFirstVersion);
  frame(0, kReplyWanted);
  EXPECT_EQ(last_sent().type, Type::kMissing);
  EXPECT_EQ(last_sent().version, kFirstVersion);
  session_.answer({.sequence = 0}, now_);
  EXPECT_EQ(last_sent().version, kFirstVersion);
  EXPECT_FALSE(give({.type = Type::kBye, .version = kNewestVersion}));
  EXPECT_FALSE(session_.ended());
  EXPECT_EQ(session_.counters().other_version, 1u);
}

TEST_F(Session, ARobotThatTakesTheOfferGetsVersion2) {
  EXPECT_TRUE(give({.type = Type::kDescription, .sequence = kNonce, .version = kNewestVersion},
                   write_description(description(true), kNewestVersion)));
  ASSERT_TRUE(session_.description());
  EXPECT_EQ(session_.description()->sensors.at(0).name, "eyes");
  EXPECT_EQ(session_.version(), kNewestVersion);
  EXPECT_FALSE(frame(0)) << "of the first version";
  EXPECT_EQ(session_.counters().other_version, 1u);
  give({.type = Type::kFrame, .flags = kReplyWanted, .sequence = 0, .version = kNewestVersion},
       frame_of(0, 2, 0));
  EXPECT_EQ(last_sent().type, Type::kMissing);
  EXPECT_EQ(last_sent().version, kNewestVersion);
  pass(milliseconds{1100});
  EXPECT_EQ(last_sent().type, Type::kHello);
  EXPECT_EQ(last_sent().version, kFirstVersion) << "a hello has the first version in every session";
}

TEST_F(Session, ThePartsOfADescriptionAreOfOneVersion) {
  Description robot = description(false);
  robot.sensors.assign(20, robot.sensors.front());
  for (std::size_t i = 0; i < 20; ++i) robot.sensors[i].id = static_cast<std::uint32_t>(i);
  const auto parts = [&](std::uint8_t version) {
    return datagrams_of(
        {.type = Type::kDescription, .session = kSession, .sequence = kNonce, .version = version},
        write_description(robot, version));
  };
  const auto first = parts(kFirstVersion);
  const auto newest = parts(kNewestVersion);
  ASSERT_EQ(first.size(), newest.size());
  give(first[0]);
  for (std::size_t i = 1; i < newest.size(); ++i) EXPECT_FALSE(give(newest[i]));
  EXPECT_TRUE(give(newest[0]));
  EXPECT_EQ(session_.version(), kNewestVersion);
  EXPECT_EQ(session_.fault(), "");
}

TEST_F(Session, AVersionThatWasNotOfferedIsRefused) {
  HostSession first(wire_, robot_, kNonce, milliseconds{5000}, now_, kFirstVersion);
  EXPECT_EQ(last_sent().flags, 0);
  EXPECT_FALSE(first.take(
      datagram_of(
          {.type = Type::kDescription, .session = kSession, .sequence = kNonce, .version = kNewestVersion},
          write_description(description(true), kNewestVersion)),
      robot_, now_));
  EXPECT_FALSE(first.description());
  EXPECT_EQ(first.counters().other_version, 1u);
}

TEST_F(Session, HearsOnlyThePeerOfTheSession) {
  Address other = robot_;
  other.port = 7001;
  const Bytes description = datagram_of({.type = Type::kDescription, .session = kSession, .sequence = kNonce},
                                        write_description(link::description(false), kFirstVersion));
  EXPECT_FALSE(session_.take(description, other, now_));
  EXPECT_FALSE(session_.description());
  EXPECT_FALSE(give({.type = Type::kDescription, .sequence = kNonce + 1},
                    write_description(link::description(false), kFirstVersion)));
  EXPECT_FALSE(frame(0)) << "before it is described";
  EXPECT_EQ(session_.counters().foreign, 3u);
  EXPECT_TRUE(give(description));
  EXPECT_FALSE(give(datagram_of({.type = Type::kFrame, .session = kSession + 1}, frame_of(0, 1, 0))));
  EXPECT_FALSE(give(datagram_of({.type = Type::kBye, .session = kSession + 1})));
  EXPECT_FALSE(session_.ended());
  EXPECT_EQ(session_.counters().foreign, 5u);
}

TEST_F(Session, ARobotThatWasStartedAnewIsAFault) {
  describe(true);
  EXPECT_TRUE(frame(0));
  EXPECT_TRUE(give(datagram_of({.type = Type::kDescription, .session = kSession + 1, .sequence = kNonce},
                               write_description(description(true), kFirstVersion))));
  EXPECT_NE(session_.fault().find("started anew"), std::string::npos) << session_.fault();
}

TEST_F(Session, ARobotThatWasStartedAnewMaySpeakAnotherVersion) {
  describe(true);
  EXPECT_TRUE(give(datagram_of(
      {.type = Type::kDescription, .session = kSession + 1, .sequence = kNonce, .version = kNewestVersion},
      write_description(description(true), kNewestVersion))));
  EXPECT_NE(session_.fault().find("started anew"), std::string::npos) << session_.fault();
}

TEST_F(Session, AnswersAreNumberedAndRepeatedOnRequest) {
  describe(true);
  session_.want_frames(now_);
  frame(0, kReplyWanted);
  EXPECT_EQ(last_sent().type, Type::kMissing);
  Bytes bytes;
  EXPECT_EQ(session_.next(bytes), 0u);
  session_.answer({.sequence = 0, .command = host::DriveCommand{1, 2}}, now_);
  const Bytes answer = wire_.sent.back();
  frame(0, kReplyWanted);
  EXPECT_TRUE(wire_.sent.back() == answer);
  frame(1);
  EXPECT_EQ(session_.next(bytes), 1u);
  session_.answer({.sequence = 1}, now_);
  const auto read = read_datagram(wire_.sent.back());
  EXPECT_EQ(read_answer(std::get<Datagram>(read))->number, 1u);
}

TEST_F(Session, AByeEndsItAndIsReturned) {
  describe(true);
  frame(0);
  EXPECT_TRUE(give({.type = Type::kBye, .flags = kReplyWanted}));
  EXPECT_TRUE(session_.ended());
  EXPECT_EQ(last_sent().type, Type::kBye);
  EXPECT_EQ(last_sent().flags, 0) << "or they would never end";
  Bytes bytes;
  EXPECT_EQ(session_.next(bytes), 0u) << "what came before it counts";
  pass(milliseconds{60'000});
  EXPECT_EQ(session_.fault(), "");
}

TEST_F(Session, DamagedDatagramsAreCountedAndChangeNothing) {
  describe(true);
  const Bytes whole = datagram_of({.type = Type::kFrame, .session = kSession}, frame_of(0, 1, 0));
  std::uint64_t refused = 0;
  for (std::size_t size = 0; size < whole.size(); ++size, ++refused) {
    EXPECT_FALSE(give(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))));
  }
  for (std::size_t bit = 0; bit < whole.size() * 8; ++bit, ++refused) {
    Bytes flipped = whole;
    flipped[bit / 8] ^= std::byte{1} << (bit % 8);
    EXPECT_FALSE(give(flipped));
  }
  for (const Type type : {Type::kHello, Type::kMissing, Type::kAnswer}) {
    EXPECT_FALSE(give({.type = type}));
    ++refused;
  }
  EXPECT_EQ(session_.counters().malformed + session_.counters().other_version, refused);
  EXPECT_EQ(session_.counters().frames.frames, 0u);
  EXPECT_TRUE(give(whole));
}

TEST_F(Session, ADescriptionOfManyDatagramsIsPutTogether) {
  Description robot = description(false);
  robot.sensors.assign(40, robot.sensors.front());
  for (std::size_t i = 0; i < 40; ++i) robot.sensors[i].id = static_cast<std::uint32_t>(i);
  const Bytes message = write_description(robot, kFirstVersion);
  auto datagrams =
      datagrams_of({.type = Type::kDescription, .session = kSession, .sequence = kNonce}, message);
  ASSERT_GT(datagrams.size(), 2u);
  // Each hello brings all of it again, and each time something is lost.
  for (std::size_t i = 0; i < datagrams.size(); i += 2) EXPECT_FALSE(give(datagrams[i]));
  for (std::size_t i = 0; i < datagrams.size(); ++i) give(datagrams[i]);
  ASSERT_TRUE(session_.description());
  EXPECT_EQ(session_.description()->sensors.size(), 40u);
}

}  // namespace
}  // namespace hallway::link
