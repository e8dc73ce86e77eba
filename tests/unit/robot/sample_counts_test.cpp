// SPDX-License-Identifier: MIT
#include "robot/sample_counts.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <utility>
#include <vector>

namespace hallway::robot {
namespace {

/// A frame of samples: sensor and number of each.
void add(SampleCounter& counter, std::initializer_list<std::pair<std::uint32_t, std::uint64_t>> samples) {
  std::vector<hw_sample_t> all;
  std::vector<const hw_sample_t*> pointers;
  for (const auto& [sensor, sequence] : samples) {
    all.push_back({.size = sizeof(hw_sample_t),
                   .kind = 0,
                   .flags = 0,
                   .sensor_id = sensor,
                   .sequence = sequence,
                   .t_begin_ns = 0,
                   .t_end_ns = 0,
                   .payload = nullptr});
  }
  for (const hw_sample_t& sample : all) pointers.push_back(&sample);
  counter.add({sizeof(hw_frame_t), static_cast<std::uint32_t>(all.size()), 0, 0, pointers.data()});
}

TEST(SampleCounter, CountsWhatIsMissingBySensor) {
  SampleCounter counter;
  add(counter, {{1, 10}, {2, 0}, {2, 1}});
  add(counter, {});
  add(counter, {{1, 11}, {2, 5}});  // three of sensor 2 were in frames that did not come
  add(counter, {{1, 14}});
  EXPECT_EQ(counter.sensors().at(1).given, 3u);
  EXPECT_EQ(counter.sensors().at(1).missing, 2u);
  EXPECT_EQ(counter.sensors().at(2).given, 3u);
  EXPECT_EQ(counter.sensors().at(2).missing, 3u);
}

TEST(SampleCounter, NumbersThatBeginAnewLeaveNoGap) {
  SampleCounter counter;
  add(counter, {{1, 7}});
  add(counter, {{1, 0}});
  add(counter, {{1, 1}});
  EXPECT_EQ(counter.sensors().at(1).missing, 0u);
}

}  // namespace
}  // namespace hallway::robot
