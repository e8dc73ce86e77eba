// SPDX-License-Identifier: MIT
#pragma once

#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include <array>
#include <atomic>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "ros1/reading_queue.hpp"
#include "ros1/readings.hpp"
#include "ros1/settings.hpp"

namespace hallway::ros1 {

/// What became of the messages, counted since the robot was opened.
struct InputCounts {
  std::atomic<std::uint64_t> received = 0;        ///< messages
  std::atomic<std::uint64_t> overtaken = 0;       ///< readings that a newer one pushed out of the queue
  std::atomic<std::uint64_t> out_of_order = 0;    ///< readings whose stamp lay before that of an earlier one
  std::atomic<std::uint64_t> malformed = 0;       ///< messages that could not be read
  std::atomic<std::uint64_t> missed = 0;          ///< gaps in the publishers' own counting of messages
  std::atomic<std::uint64_t> points_dropped = 0;  ///< points not finite, or outside of a scan's limits
};

/// The topics that are read. Callbacks run on the thread that serves the handle's queue of callbacks.
class Inputs {
 public:
  /// Subscribes. Throws sdk::Failure.
  Inputs(ros::NodeHandle& handle, const Settings& settings);

  ReadingQueue& readings() { return readings_; }
  const InputCounts& counts() const { return counts_; }
  /// Whether something was lost on its way.
  bool has_lost() const {
    return counts_.overtaken + counts_.out_of_order + counts_.malformed + counts_.missed != 0;
  }
  /// Whether anybody publishes what is read.
  bool has_publishers() const;
  /// header.frame_id of the sensor's first message; empty before.
  std::string frame_of(std::uint32_t sensor);

 private:
  struct Sensor {
    std::string topic{};
    std::string frame{};                              ///< guarded by mutex_
    std::map<std::string, std::uint32_t> last_seq{};  ///< by publisher
    bool told_malformed = false;
    bool told_out_of_order = false;
    ros::Subscriber subscriber{};
  };

  template <typename Message>
  ros::Subscriber subscribe(ros::NodeHandle& handle, std::uint32_t sensor, Points (*read)(const Message&));
  void note(Sensor& sensor, const std_msgs::Header& header, const std::string& publisher);
  void push(std::uint32_t sensor, const std_msgs::Header& header, Points points);

  ReadingQueue readings_;
  std::uint32_t queue_;
  InputCounts counts_;
  std::mutex mutex_;
  std::vector<Sensor> sensors_;
};

}  // namespace hallway::ros1
