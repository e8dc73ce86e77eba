// SPDX-License-Identifier: MIT
#include "robot/arrivals.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "host/load/search.hpp"
#include "support/made_up_kind.hpp"

namespace hallway::robot {
namespace {

using std::chrono::milliseconds;

constexpr std::uint64_t kFrames = 50;  // of the driver

/// The robot of gives_made_up.cpp, all of whose frames have come before one is taken.
class ComeAtOnce : public testing::Test {
 protected:
  /// The frames that are left, of `backlog` that may wait.
  std::vector<Arrival> arrived(std::size_t backlog, bool newest) {
    host::Driver driver(host::find_driver(GIVES_MADE_UP, {}));
    driver.open({}, {});
    const host::RobotInfo robot = driver.describe();
    Arrivals arrivals(driver, robot, backlog);
    const auto limit = Clock::now() + std::chrono::seconds{60};
    while (arrivals.counts().read < kFrames && Clock::now() < limit)
      std::this_thread::sleep_for(milliseconds{1});
    std::vector<Arrival> all;
    for (Arrival arrival; arrivals.take(milliseconds{0}, newest, arrival);) all.push_back(arrival);
    counts_ = arrivals.counts();
    return all;
  }

  IntakeCounts counts_;
};

/// The numbers of the samples of the made-up sensor.
std::vector<std::uint64_t> made_up_in(const std::vector<Arrival>& arrivals) {
  std::vector<std::uint64_t> numbers;
  host::FrameReader reader;
  for (const Arrival& arrival : arrivals) {
    const hw_frame_t& frame = reader.read(std::as_bytes(std::span(arrival.bytes)));
    EXPECT_EQ(frame.sequence, arrival.frame.sequence);
    for (std::uint32_t i = 0; i < frame.n_samples; ++i) {
      if (frame.samples[i]->kind == test::kMadeUpSample) numbers.push_back(frame.samples[i]->sequence);
    }
  }
  return numbers;
}

TEST_F(ComeAtOnce, OfThoseThatAreDroppedTheNextOnesGetWhatMayNotBeMissed) {
  std::vector<std::uint64_t> all;
  for (std::uint64_t i = 0; i < kFrames; ++i) all.push_back(i);
  for (const std::size_t backlog : {1u, 2u, 8u}) {
    const auto arrivals = arrived(backlog, false);
    ASSERT_EQ(arrivals.size(), backlog);
    EXPECT_EQ(counts_.dropped, kFrames - backlog);
    EXPECT_EQ(made_up_in(arrivals), all) << "backlog " << backlog;
  }
  const auto newest = arrived(8, true);
  ASSERT_EQ(newest.size(), 1u);
  EXPECT_EQ(newest[0].frame.sequence, kFrames - 1);
  EXPECT_EQ(made_up_in(newest), all);
}

}  // namespace
}  // namespace hallway::robot
