// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <mutex>
#include <thread>

#include "fixtures.hpp"

namespace hallway::host {
namespace {

using test_fixtures::frame_of;
using test_fixtures::point_sensors;

TEST(Threads, LogsOfAPluginsOwnThreadsArrive) {
  std::mutex mutex;
  int lines = 0;
  const LogSink sink = [&](const std::string&, std::uint32_t, const std::string& message) {
    const std::lock_guard lock(mutex);
    lines += message == "from a thread" ? 1 : 0;
  };
  FrameBuilder builder;
  Plugin plugin(test_fixtures::find_fixture("logs_from_threads.so"), sink);
  plugin.activate(point_sensors());
  plugin.process(frame_of(builder, 0, {}));
  EXPECT_EQ(lines, 200);
}

/// Feeds a plugin twenty frames of points that do not move. @return observations of its landmarks
std::size_t feed(Plugin& plugin) {
  FrameBuilder builder;
  std::vector<hw_point3_t> points;
  for (int i = 0; i < 40; ++i) points.push_back({5.0 + i % 7, i * 0.9 - 18, i % 5 - 2.0});
  for (std::uint64_t i = 0; i < 20; ++i) plugin.process(frame_of(builder, i, points));
  std::size_t observations = 0;
  for (const hw_landmark_t& landmark : plugin.report(true).landmarks()) observations += landmark.observations;
  return observations;
}

TEST(Threads, InstancesOfOneLibraryRunAtTheSameTime) {
  const std::string file = std::string(PLUGINS) + "/slam_point.so";
  Plugin first(find_plugin(file, {})), second(find_plugin(file, {}));
  first.activate(point_sensors());
  second.activate(point_sensors());
  std::size_t of_second = 0;
  std::thread thread([&] { of_second = feed(second); });
  const std::size_t of_first = feed(first);
  thread.join();
  EXPECT_EQ(of_first, 40u * 20u);
  EXPECT_EQ(of_second, of_first);
}

TEST(Threads, AnInstanceMayBeFedByOneThreadAfterAnother) {
  FrameBuilder builder;
  Plugin plugin(find_plugin(EXAMPLE, {}));
  plugin.activate(point_sensors());
  std::thread([&] { plugin.process(frame_of(builder, 0, {{1, 2, 3}})); }).join();
  std::thread([&] { plugin.process(frame_of(builder, 1, {{1, 2, 3}})); }).join();
  EXPECT_EQ(plugin.report(false).landmarks()[0].observations, 2u);
}

}  // namespace
}  // namespace hallway::host
