// SPDX-License-Identifier: MIT
#include "loaders/bag_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "loaders/bag_topics.hpp"
#include "support/errors.hpp"
#include "unit/import/cloud_bytes.hpp"

namespace hallway::loaders::bag {
namespace {

using test::Points;

/// A cloud of two rows with bytes between the fields, the points and the rows.
template <typename T>
Cloud cloud_of(const Points& points, bool big_endian) {
  Cloud cloud;
  cloud.t_ns = 17;
  cloud.height = 2;
  cloud.width = static_cast<std::uint32_t>(points.size() / 2);
  cloud.point_step = 3 * sizeof(T) + 7;
  cloud.row_step = cloud.width * cloud.point_step + 5;
  cloud.big_endian = big_endian;
  const std::uint8_t type = sizeof(T) == 4 ? 7 : 8;
  cloud.fields = {
      {"z", 1, type}, {"intensity", 0, 2}, {"x", sizeof(T) + 3, type}, {"y", 2 * sizeof(T) + 5, type}};
  std::string bytes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [x, y, z] = points[i];
    bytes += "i" + test::bytes_of(static_cast<T>(z), big_endian) + "--" +
             test::bytes_of(static_cast<T>(x), big_endian) + "--" +
             test::bytes_of(static_cast<T>(y), big_endian) + "--";
    if (i + 1 == cloud.width) bytes += "=====";
  }
  cloud.data.assign(bytes.begin(), bytes.end());
  return cloud;
}

std::string error_text(const Cloud& cloud) {
  import::Frame frame;
  const auto error = test::error_of([&] { take_cloud(cloud, 1, frame); });
  return error ? error->message() : "none";
}

TEST(BagPoints, CloudsOfEitherFloatAndByteOrder) {
  const Points points = test::exact_points(10);
  import::Frame frame;
  for (const bool big_endian : {false, true}) {
    take_cloud(cloud_of<float>(points, big_endian), 1, frame);
    EXPECT_EQ(frame.points, points);
    take_cloud(cloud_of<double>(points, big_endian), 1, frame);
    EXPECT_EQ(frame.points, points);
    EXPECT_EQ(frame.t_ns, 17);
    take_cloud(cloud_of<double>(points, big_endian), 4, frame);
    EXPECT_EQ(frame.points, (Points{points[0], points[4], points[8]}));
  }
}

TEST(BagPoints, ACloudWhoseNumbersLieIsAnError) {
  const Cloud good = cloud_of<float>(test::exact_points(10), false);
  EXPECT_EQ(error_text(good), "none");
  constexpr auto kMost = std::numeric_limits<std::uint32_t>::max();
  const std::vector<std::pair<void (*)(Cloud&), std::string>> lies{
      {[](Cloud& c) { c.width = kMost; }, "too short"},
      {[](Cloud& c) { c.height = kMost; }, "too short"},
      {[](Cloud& c) { c.height = kMost, c.width = kMost, c.row_step = kMost; }, "too short"},
      {[](Cloud& c) { c.row_step = 0; }, "too short"},
      {[](Cloud& c) { c.row_step = c.width * c.point_step - 1; }, "too short"},
      {[](Cloud& c) { c.data.pop_back(), c.data.pop_back(), c.data.pop_back(); }, "too short"},
      {[](Cloud& c) { c.data.clear(); }, "too short"},
      {[](Cloud& c) { c.point_step = kMost; }, "too short"},
      {[](Cloud& c) { c.point_step = 0; }, "x lies outside of a point"},
      {[](Cloud& c) { c.fields[2].offset = kMost; }, "x lies outside of a point"},
      {[](Cloud& c) { c.fields[3].datatype = 5; }, "y is no float"},
      {[](Cloud& c) { c.fields.pop_back(); }, "have no y"},
      {[](Cloud& c) { c.fields.clear(); }, "have no x"},
  };
  for (const auto& [lie, words] : lies) {
    Cloud cloud = good;
    lie(cloud);
    EXPECT_NE(error_text(cloud).find(words), std::string::npos) << error_text(cloud) << " for " << words;
  }
  Cloud empty = good;
  empty.width = 0;
  empty.height = kMost;
  EXPECT_EQ(error_text(empty), "none");
}

TEST(BagPoints, ScansArePointsOfTheirPlane) {
  constexpr float kNone = std::numeric_limits<float>::infinity();
  Scan scan{5, -0.5f, 0.25f, 0.5f, 10.0f, {1.0f, kNone, 2.0f, 0.25f, 11.0f, std::nanf(""), 10.0f, -1.0f}};
  import::Frame frame;
  take_scan(scan, 1, frame);
  const auto beam = [](double range, double angle) {
    return std::array<double, 3>{range * std::cos(angle), range * std::sin(angle), 0.0};
  };
  EXPECT_EQ(frame.points, (Points{beam(1, -0.5), beam(2, 0.0), beam(10, 1.0)}));
  EXPECT_EQ(frame.not_finite, 0u);
  take_scan(scan, 3, frame);
  EXPECT_EQ(frame.points, (Points{beam(1, -0.5), beam(10, 1.0)}));
  scan.range_min = scan.range_max = 0.0f;
  take_scan(scan, 1, frame);
  EXPECT_EQ(frame.points.size(), 5u) << "all that are positive and finite";
}

TEST(BagTopics, TheOneThereIsOrTheOneThatIsNamed) {
  const std::vector<Topic> topics{{"/cloud", "sensor_msgs/PointCloud2", 3},
                                  {"/odom", "nav_msgs/Odometry", 9}};
  EXPECT_EQ(choose_points(topics, "").name, "/cloud");
  EXPECT_EQ(choose_points(topics, "/cloud").name, "/cloud");
  EXPECT_EQ(choose_poses(topics, "/odom").name, "/odom");
  std::vector<Topic> two = topics;
  two.push_back({"/scan\x1b", "sensor_msgs/LaserScan", 4});
  const auto unclear = test::error_of([&] { choose_points(two, ""); });
  ASSERT_TRUE(unclear);
  EXPECT_EQ(unclear->code(), ErrorCode::kUsage);
  EXPECT_EQ(unclear->message(),
            "has several topics of points: --topic is needed; its topics: /cloud (sensor_msgs/PointCloud2, "
            "3), /odom "
            "(nav_msgs/Odometry, 9), /scan\\x1b (sensor_msgs/LaserScan, 4)");
  EXPECT_EQ(test::error_of([&] { choose_points(topics, "/odom"); })->code(), ErrorCode::kUsage);
  EXPECT_EQ(test::error_of([&] { choose_points(topics, "/x"); })->code(), ErrorCode::kUsage);
  EXPECT_EQ(test::error_of([&] { choose_poses(topics, "/cloud"); })->code(), ErrorCode::kUsage);
  EXPECT_EQ(test::error_of([&] { choose_points({topics[1]}, ""); })->code(), ErrorCode::kBadInput);
  EXPECT_EQ(test::error_of([&] { choose_points({}, ""); })->code(), ErrorCode::kBadInput);
}

}  // namespace
}  // namespace hallway::loaders::bag
