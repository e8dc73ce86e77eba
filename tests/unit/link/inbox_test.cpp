// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "host/samples/point_kind.hpp"
#include "link/frames_in_step.hpp"
#include "link/newest_frames.hpp"
#include "support/made_up_kind.hpp"
#include "unit/link/datagrams.hpp"

namespace hallway::link {
namespace {

constexpr std::size_t kThreeFragments = 2 * kFragmentBytes + 100;

/// The message of a frame, its datagrams, and what an inbox says to them.
class Frames {
 public:
  explicit Frames(FrameInbox& inbox) : inbox_(inbox) {}

  static Bytes message(std::uint64_t sequence) { return some_bytes(kThreeFragments, sequence); }
  FrameReply give(std::uint64_t sequence, std::size_t fragment, std::uint16_t flags = 0) {
    const auto datagrams =
        datagrams_of({.type = Type::kFrame, .flags = flags, .sequence = sequence}, message(sequence));
    return inbox_.take(std::get<Datagram>(read_datagram(datagrams[fragment])));
  }
  void give_all(std::uint64_t sequence) {
    for (const std::size_t i : {0u, 1u, 2u}) give(sequence, i);
  }
  /// The number of the frame that comes next, whose bytes must be its own.
  std::optional<std::uint64_t> next() {
    Bytes bytes;
    const auto sequence = inbox_.next(bytes);
    if (sequence) {
      EXPECT_TRUE(bytes == message(*sequence));
    }
    return sequence;
  }

 private:
  FrameInbox& inbox_;
};

TEST(NewestFrames, GivesWholeFramesInTheirOrder) {
  NewestFrames inbox;
  Frames frames(inbox);
  EXPECT_FALSE(frames.next());
  for (const std::uint64_t k : {0u, 1u, 2u}) {
    frames.give(k, 2);
    frames.give(k, 0);
    EXPECT_FALSE(frames.next());
    frames.give(k, 1);
    EXPECT_EQ(frames.next(), k);
    EXPECT_FALSE(frames.next());
  }
  EXPECT_EQ(inbox.counters().frames, 3u);
  EXPECT_EQ(inbox.counters().lost, 0u);
}

TEST(NewestFrames, TheNewestWins) {
  NewestFrames inbox;
  Frames frames(inbox);
  for (const std::uint64_t k : {0u, 1u, 2u}) frames.give_all(k);
  EXPECT_EQ(frames.next(), 2u);
  EXPECT_FALSE(frames.next());
  EXPECT_EQ(inbox.counters().skipped, 2u);
  EXPECT_EQ(inbox.counters().lost, 0u);
}

/// A frame of points and one made-up sample, of which none may be missed.
Bytes frame_with_made_up(std::uint64_t number) {
  const test::MadeUp made_up{.temperature = 20};
  host::FrameBuilder builder;
  builder.begin(number, 0);
  host::add_points(builder, 0) = {{1, 2, 3}};
  builder.add({sizeof(hw_sample_t), test::kMadeUpSample, 0, 1, number, 0, 0, &made_up});
  Bytes bytes;
  host::FrameWriter().write_over(bytes, builder.finish());
  return bytes;
}

TEST(NewestFrames, WhatMayNotBeMissedOfAFrameThatIsOvertakenGoesIntoTheNext) {
  NewestFrames inbox;
  for (const std::uint64_t k : {0u, 1u, 2u}) {
    const Bytes datagram = datagram_of({.type = Type::kFrame, .sequence = k}, frame_with_made_up(k));
    inbox.take(std::get<Datagram>(read_datagram(datagram)));
  }
  Bytes bytes;
  ASSERT_EQ(inbox.next(bytes), 2u);
  host::FrameReader reader;
  const hw_frame_t& frame = reader.read(bytes);
  EXPECT_EQ(frame.sequence, 2u);
  ASSERT_EQ(frame.n_samples, 4u) << "its points, and three made-up samples";
  for (std::uint32_t i = 1; i < 4; ++i) EXPECT_EQ(frame.samples[i]->sequence, i - 1);
  EXPECT_EQ(inbox.counters().skipped, 2u);
}

TEST(NewestFrames, CountsLossLatenessAndDuplicates) {
  NewestFrames inbox;
  Frames frames(inbox);
  frames.give_all(0);
  EXPECT_EQ(frames.next(), 0u);
  frames.give(0, 1);  // once more
  frames.give(2, 0);  // one whose rest is lost; 1 and 3 never come
  frames.give(2, 0);
  frames.give_all(4);
  frames.give(2, 1);  // too late
  EXPECT_EQ(frames.next(), 4u);
  const FrameCounters& counters = inbox.counters();
  EXPECT_EQ(counters.frames, 2u);
  EXPECT_EQ(counters.lost, 3u);
  EXPECT_EQ(counters.incomplete, 1u);
  EXPECT_EQ(counters.duplicates, 2u);
  EXPECT_EQ(counters.late, 1u);
}

TEST(NewestFrames, FragmentsOfTwoFramesMayOvertakeEachOther) {
  NewestFrames inbox;
  Frames frames(inbox);
  for (const std::size_t i : {0u, 1u}) {
    frames.give(0, i);
    frames.give(1, i);
  }
  frames.give(0, 2);
  EXPECT_EQ(frames.next(), 0u);
  frames.give(1, 2);
  EXPECT_EQ(frames.next(), 1u);
  // Of three the oldest makes room, and what still comes of it is late.
  for (const std::uint64_t k : {2u, 3u, 4u}) frames.give(k, 0);
  frames.give(2, 1);
  frames.give(3, 1);
  frames.give(3, 2);
  EXPECT_EQ(frames.next(), 3u);
  EXPECT_EQ(inbox.counters().late, 1u);
  EXPECT_EQ(inbox.counters().lost, 1u);
  EXPECT_EQ(inbox.counters().incomplete, 1u);
}

TEST(FramesInStep, SaysWhatIsMissingWhenItIsAsked) {
  FramesInStep inbox;
  Frames frames(inbox);
  EXPECT_EQ(frames.give(0, 1).kind, FrameReply::Kind::kNothing);
  FrameReply reply = frames.give(0, 1, kReplyWanted);
  EXPECT_EQ(reply.kind, FrameReply::Kind::kMissing);
  EXPECT_EQ(reply.missing, (std::vector<bool>{true, false, true}));
  EXPECT_EQ(frames.give(0, 0, kReplyWanted).missing, (std::vector<bool>{false, false, true}));
  EXPECT_FALSE(frames.next());
  EXPECT_EQ(frames.give(0, 2, kReplyWanted).missing, (std::vector<bool>{false, false, false}));
  EXPECT_EQ(inbox.counters().duplicates, 1u);
}

TEST(FramesInStep, WaitsForTheAnswerAndRepeatsIt) {
  FramesInStep inbox;
  Frames frames(inbox);
  frames.give_all(0);
  EXPECT_EQ(frames.give(0, 2, kReplyWanted).missing, std::vector<bool>(3, false))
      << "there, and not yet answered";
  EXPECT_EQ(frames.next(), 0u);
  EXPECT_EQ(frames.give(0, 2, kReplyWanted).kind, FrameReply::Kind::kMissing);
  frames.give_all(1);  // a robot that does not wait
  EXPECT_EQ(inbox.counters().misfits, 3u);
  inbox.answered(0);
  EXPECT_EQ(frames.give(0, 2, kReplyWanted).kind, FrameReply::Kind::kAnswer);
  EXPECT_EQ(frames.give(0, 2).kind, FrameReply::Kind::kNothing) << "nobody asked";
  EXPECT_FALSE(frames.next());
  frames.give_all(1);
  EXPECT_EQ(frames.next(), 1u);
  frames.give(0, 0, kReplyWanted);
  EXPECT_EQ(inbox.counters().late, 1u);
  EXPECT_EQ(inbox.counters().frames, 2u);
}

TEST(FramesInStep, AnAnswerBeforeTheFrameWasReadAnswersNothing) {
  FramesInStep inbox;
  Frames frames(inbox);
  frames.give_all(0);
  inbox.answered(0);
  EXPECT_EQ(frames.next(), 0u);
  EXPECT_EQ(frames.give(0, 2, kReplyWanted).kind, FrameReply::Kind::kMissing);
}

}  // namespace
}  // namespace hallway::link
