// SPDX-License-Identifier: MIT
#include "run/sources/paced_source.hpp"

#include <gtest/gtest.h>

#include "run/sources/log_source.hpp"

namespace hallway::run {
namespace {

using Clock = PacedSource::Clock;

LogSource five_frames() {
  log::ObservationLog observations(false);
  for (std::uint32_t i = 0; i < 5; ++i) observations.add_frame(i, {});
  return {std::move(observations), {}, {}, 40'000'000, 5};
}

TEST(PacedSource, FollowsTheScheduleOfTheFirstFrame) {
  LogSource log = five_frames();
  std::vector<Clock::time_point> due;
  PacedSource paced(log, 2.0, [&](Clock::time_point at) { due.push_back(at); });
  SourceFrame frame;
  for (std::uint32_t i = 0; i < paced.iterations(); ++i) {
    paced.read(i, frame);
    EXPECT_EQ(frame.t_ns(), 40'000'000 * std::int64_t{i});
  }
  ASSERT_EQ(due.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(due[i] - due[0], std::chrono::milliseconds(20 * i)) << "twice as fast as 40 ms, frame " << i;
  }
}

TEST(PacedSource, AFrameThatIsReadAgainIsDueWhenItWas) {
  LogSource log = five_frames();
  std::vector<Clock::time_point> due;
  PacedSource paced(log, 1.0, [&](Clock::time_point at) { due.push_back(at); });
  SourceFrame frame;
  for (const std::uint32_t i : {0u, 3u, 3u}) paced.read(i, frame);
  EXPECT_EQ(due[1], due[2]);
}

}  // namespace
}  // namespace hallway::run
