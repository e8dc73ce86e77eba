// SPDX-License-Identifier: MIT
// The one source file that includes ROS. It is C++17: ROS 1's headers use parts of allocators that C++20 has no longer.
#include "loaders/bag_file.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include <map>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::loaders::bag {
namespace {

[[noreturn]] void refuse(const std::string& cause, const std::string& element = {}) {
  throw Error(ErrorCode::kBadInput, cause, {"", 0, element});
}

/// What ROS's libraries throw becomes an Error.
template <typename Work>
auto guarded(Work&& work) {
  try {
    return work();
  } catch (const rosbag::BagUnindexedException&) {
    refuse("has no index: it was cut off or not closed; `rosbag reindex` makes one");
  } catch (const rosbag::BagException& failure) {
    refuse("cannot be read as a bag: " + printable(failure.what()));
  } catch (const ros::Exception& failure) {
    refuse("cannot be read as a bag: " + printable(failure.what()));
  }
}

std::int64_t nanoseconds(const ros::Time& time) {
  return std::int64_t{time.sec} * 1'000'000'000 + time.nsec;
}

StampedPose pose_of(const geometry_msgs::Pose& pose) {
  StampedPose out;
  out.position_m = {pose.position.x, pose.position.y, pose.position.z};
  out.orientation = {pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z};
  return out;
}

StampedPose convert(const nav_msgs::Odometry& message) {
  return pose_of(message.pose.pose);
}

StampedPose convert(const geometry_msgs::PoseStamped& message) {
  return pose_of(message.pose);
}

Scan convert(const sensor_msgs::LaserScan& message) {
  Scan scan;
  scan.angle_min = message.angle_min;
  scan.angle_increment = message.angle_increment;
  scan.range_min = message.range_min;
  scan.range_max = message.range_max;
  scan.ranges = message.ranges;
  return scan;
}

Cloud convert(const sensor_msgs::PointCloud2& message) {
  Cloud cloud;
  cloud.height = message.height;
  cloud.width = message.width;
  cloud.point_step = message.point_step;
  cloud.row_step = message.row_step;
  cloud.big_endian = message.is_bigendian != 0;
  for (const auto& field : message.fields) cloud.fields.push_back({field.name, field.offset, field.datatype});
  cloud.data = message.data;
  return cloud;
}

/// Each message of type `Message` of a topic, converted.
template <typename Message, typename Take>
void read_all(const rosbag::Bag& bag, const std::string& topic, const Take& take) {
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  std::uint64_t number = 0;
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = instance.instantiate<Message>();
    if (!message) {
      refuse("its type is not that of this version of ROS",
             "message " + std::to_string(number) + " of " + printable(topic));
    }
    auto converted = convert(*message);
    converted.t_ns = nanoseconds(message->header.stamp.isZero() ? instance.getTime() : message->header.stamp);
    take(converted);
    ++number;
  }
}

}  // namespace

struct BagFile::Ros {
  rosbag::Bag bag;
};

BagFile::BagFile(const std::string& path) : ros_(std::make_unique<Ros>()) {
  guarded([&] {
    ros_->bag.open(path, rosbag::bagmode::Read);
    // A topic may have been written through several connections.
    std::map<std::string, Topic> topics;
    rosbag::View all(ros_->bag);
    for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
      topics[connection->topic] = {connection->topic, connection->datatype, 0};
    }
    for (auto& [name, topic] : topics) {
      topic.messages = rosbag::View(ros_->bag, rosbag::TopicQuery(name)).size();
      topics_.push_back(topic);
    }
  });
}

BagFile::~BagFile() = default;

std::array<std::int64_t, 2> BagFile::span_ns(const std::string& topic) const {
  return guarded([&]() -> std::array<std::int64_t, 2> {
    rosbag::View view(ros_->bag, rosbag::TopicQuery(topic));
    return {nanoseconds(view.getBeginTime()), nanoseconds(view.getEndTime())};
  });
}

void BagFile::read_clouds(const std::string& topic, const std::function<void(const Cloud&)>& take) const {
  guarded([&] { read_all<sensor_msgs::PointCloud2>(ros_->bag, topic, take); });
}

void BagFile::read_scans(const std::string& topic, const std::function<void(const Scan&)>& take) const {
  guarded([&] { read_all<sensor_msgs::LaserScan>(ros_->bag, topic, take); });
}

void BagFile::read_poses(const std::string& topic,
                         const std::function<void(const StampedPose&)>& take) const {
  guarded([&] {
    for (const Topic& known : topics_) {
      if (known.name != topic) continue;
      if (known.type == "nav_msgs/Odometry") return read_all<nav_msgs::Odometry>(ros_->bag, topic, take);
      return read_all<geometry_msgs::PoseStamped>(ros_->bag, topic, take);
    }
  });
}

}  // namespace hallway::loaders::bag
