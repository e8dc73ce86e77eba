// SPDX-License-Identifier: MIT
#include "ros1/inputs.hpp"

#include <boost/function.hpp>

#include "base/text.hpp"
#include "ros1/console.hpp"

namespace hallway::ros1 {
namespace {

/// Room for a publisher that waits for answers, but not after every message.
constexpr std::size_t kLockStepQueue = 1000;

std::int64_t nanoseconds_of(const ros::Time& time) {
  return std::int64_t{time.sec} * 1'000'000'000 + std::int64_t{time.nsec};
}

}  // namespace

Inputs::Inputs(ros::NodeHandle& handle, const Settings& settings)
    : readings_(settings.lock_step ? kLockStepQueue : settings.queue),
      // roscpp's own queue, in front of ours, drops without a word: it gets room for what comes while one message is read.
      queue_(static_cast<std::uint32_t>(settings.lock_step ? kLockStepQueue : settings.queue + 8)),
      sensors_(settings.sensors.size()) {
  for (std::uint32_t i = 0; i < sensors_.size(); ++i) {
    sensors_[i].topic = settings.sensors[i].topic;
    sensors_[i].subscriber = settings.sensors[i].is_scan
                                 ? subscribe<sensor_msgs::LaserScan>(handle, i, &read_scan)
                                 : subscribe<sensor_msgs::PointCloud2>(handle, i, &read_cloud);
    if (!sensors_[i].subscriber) {
      throw sdk::Failure(HW_ERROR_IO, "cannot subscribe to " + printable(sensors_[i].topic));
    }
  }
}

template <typename Message>
ros::Subscriber Inputs::subscribe(ros::NodeHandle& handle, std::uint32_t sensor,
                                  Points (*read)(const Message&)) {
  const boost::function<void(const ros::MessageEvent<const Message>&)> callback =
      [this, sensor, read](const ros::MessageEvent<const Message>& event) {
        const Message& message = *event.getConstMessage();
        note(sensors_[sensor], message.header, event.getPublisherName());
        try {
          push(sensor, message.header, read(message));
        } catch (const Malformed& failure) {
          ++counts_.malformed;
          if (std::exchange(sensors_[sensor].told_malformed, true)) return;
          say(HW_LOG_WARNING,
              printable(sensors_[sensor].topic) + ": a message cannot be read: " + failure.what());
        }
      };
  ros::SubscribeOptions options;
  options.template init<Message>(sensors_[sensor].topic, queue_, {});
  options.helper =
      boost::make_shared<ros::SubscriptionCallbackHelperT<const ros::MessageEvent<const Message>&>>(callback);
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  return handle.subscribe(options);
}

void Inputs::note(Sensor& sensor, const std_msgs::Header& header, const std::string& publisher) {
  ++counts_.received;
  const auto [last, is_first] = sensor.last_seq.try_emplace(publisher, header.seq);
  if (!is_first && header.seq > last->second) counts_.missed += header.seq - last->second - 1;
  last->second = header.seq;
  const std::lock_guard lock(mutex_);
  if (sensor.frame.empty()) sensor.frame = header.frame_id;
}

void Inputs::push(std::uint32_t sensor, const std_msgs::Header& header, Points points) {
  counts_.points_dropped += points.dropped;
  switch (readings_.push({sensor, nanoseconds_of(header.stamp), std::move(points.points), 0, 0})) {
    case Pushed::kTaken:
      return;
    case Pushed::kOverflow:
      ++counts_.overtaken;
      return;
    case Pushed::kOutOfOrder:
      ++counts_.out_of_order;
      if (std::exchange(sensors_[sensor].told_out_of_order, true)) return;
      say(HW_LOG_WARNING,
          printable(sensors_[sensor].topic) +
              ": a message is stamped before one that came earlier; it and others like it are dropped");
  }
}

bool Inputs::has_publishers() const {
  for (const Sensor& sensor : sensors_) {
    if (sensor.subscriber.getNumPublishers() != 0) return true;
  }
  return false;
}

std::string Inputs::frame_of(std::uint32_t sensor) {
  const std::lock_guard lock(mutex_);
  return sensors_[sensor].frame;
}

}  // namespace hallway::ros1
