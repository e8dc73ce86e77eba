// SPDX-License-Identifier: MIT
#include "robot/gate.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <stdexcept>

namespace hallway::robot {
namespace {

using std::chrono::milliseconds;

/// What the robot got, copied.
struct Written {
  std::uint32_t status = 0;
  std::uint64_t sequence = 0;
  std::optional<double> linear;
  std::string message;
};

class GateTest : public testing::Test {
 protected:
  Gate make(milliseconds limit = milliseconds(50)) {
    return Gate([this](const hw_answer_t& answer) { take(answer); }, limit, start_);
  }
  void take(const hw_answer_t& answer) {
    if (dead_) throw std::runtime_error("dead");
    Written written{.status = answer.status, .sequence = answer.sequence, .linear = {}, .message = {}};
    if (answer.command != nullptr) written.linear = answer.command->linear_m_s;
    if (answer.message != nullptr) written.message = answer.message;
    written_.push_back(written);
  }
  Clock::time_point at(int ms) const { return start_ + milliseconds(ms); }
  hw_answer_t drive() const {
    hw_answer_t answer{};
    answer.size = sizeof answer;
    answer.command = &command_;
    return answer;
  }

  Clock::time_point start_ = Clock::now();
  hw_drive_command_t command_{sizeof command_, 0, 0.5, 0.1, 0};
  std::vector<Written> written_;
  bool dead_ = false;
};

TEST_F(GateTest, AnAnswerInTimeMovesTheRobot) {
  Gate gate = make();
  gate.frame_came(7, 1, at(10));
  EXPECT_TRUE(gate.answer(drive(), at(60)));
  ASSERT_EQ(written_.size(), 1u);
  EXPECT_EQ(written_[0].status, std::uint32_t{HW_ANSWER_DONE});
  EXPECT_EQ(written_[0].sequence, 7u);
  EXPECT_EQ(written_[0].linear, 0.5);
}

TEST_F(GateTest, TheWatchdogLooksAgainWhenItIsTime) {
  Gate gate = make();
  gate.frame_came(0, 0, at(10));
  EXPECT_GT(gate.watch(at(20)), at(60));
  EXPECT_LE(gate.watch(at(60)), at(61));
  EXPECT_TRUE(written_.empty()) << "nothing is late yet";
}

TEST_F(GateTest, ALateAnswerStopsTheRobotTwiceAndTheNextOneMovesIt) {
  Gate gate = make();
  gate.frame_came(3, 0, at(10));
  gate.watch(at(61));
  EXPECT_FALSE(gate.answer(drive(), at(90)));
  gate.frame_came(4, 0, at(91));
  EXPECT_TRUE(gate.answer(drive(), at(95)));
  ASSERT_EQ(written_.size(), 3u);
  EXPECT_EQ(written_[0].status, std::uint32_t{HW_ANSWER_LATE});
  EXPECT_EQ(written_[0].linear, 0.0);
  EXPECT_EQ(written_[0].message, "no answer to frame 3 within 50 ms");
  EXPECT_EQ(written_[1].status, std::uint32_t{HW_ANSWER_LATE});
  EXPECT_EQ(written_[1].linear, 0.0);
  EXPECT_EQ(written_[2].linear, 0.5);
  EXPECT_EQ(gate.counts().trips, 1u);
  EXPECT_EQ(gate.counts().late_answers, 1u);
}

TEST_F(GateTest, AnAnswerAfterTheTimeIsLateAlsoIfNobodyLooked) {
  Gate gate = make();
  gate.frame_came(3, 0, at(10));
  EXPECT_FALSE(gate.answer(drive(), at(61)));
  EXPECT_EQ(written_.at(0).linear, 0.0);
  EXPECT_EQ(gate.counts().trips, 1u);
  gate.watch(at(120));
  EXPECT_EQ(gate.counts().trips, 1u) << "it stands still already";
}

TEST_F(GateTest, NoFrameStopsTheRobotOnce) {
  Gate gate = make();
  gate.frame_came(0, 0, at(0));
  gate.answer(drive(), at(1));
  for (int ms = 51; ms < 500; ms += 50) gate.watch(at(ms));
  ASSERT_EQ(written_.size(), 2u);
  EXPECT_EQ(written_[1].message, "no frame within 50 ms");
  gate.frame_came(1, 0, at(500));
  EXPECT_TRUE(gate.answer(drive(), at(501)));
}

TEST_F(GateTest, NoFrameFromTheBeginningStopsTheRobot) {
  Gate gate = make();
  gate.watch(at(51));
  EXPECT_EQ(written_.at(0).linear, 0.0);
}

TEST_F(GateTest, AFailureStopsTheRobot) {
  Gate gate = make();
  gate.frame_came(0, 0, at(0));
  gate.fail("it crashed", at(1));
  EXPECT_EQ(written_.at(0).status, std::uint32_t{HW_ANSWER_FAILED});
  EXPECT_EQ(written_.at(0).linear, 0.0);
  EXPECT_EQ(gate.counts().trips, 0u) << "it was not the clock";
}

TEST_F(GateTest, NothingComesAfterTheEnd) {
  Gate gate = make();
  gate.end("over");
  gate.frame_came(0, 0, at(0));
  EXPECT_FALSE(gate.answer(drive(), at(1)));
  gate.fail("x", at(1));
  gate.watch(at(500));
  gate.end("again");
  ASSERT_EQ(written_.size(), 1u);
  EXPECT_EQ(written_[0].status, std::uint32_t{HW_ANSWER_END});
  EXPECT_EQ(written_[0].linear, 0.0);
}

TEST_F(GateTest, WithoutALimitNothingIsLate) {
  Gate gate = make(milliseconds(0));
  gate.frame_came(0, 0, at(0));
  EXPECT_EQ(gate.watch(at(100'000)), Clock::time_point::max());
  EXPECT_TRUE(gate.answer(drive(), at(100'000)));
}

TEST_F(GateTest, AWriteThatFailsUnderTheWatchdogIsTold) {
  Gate gate = make();
  dead_ = true;
  EXPECT_NO_THROW(gate.watch(at(51)));
  EXPECT_THROW(gate.check(), std::runtime_error);
}

TEST_F(GateTest, PeopleAreToldOnce) {
  Gate gate = make();
  gate.watch(at(51));
  EXPECT_EQ(gate.take_messages().size(), 1u);
  EXPECT_TRUE(gate.take_messages().empty());
}

}  // namespace
}  // namespace hallway::robot
