// SPDX-License-Identifier: MIT
#include "ros1/session.hpp"

#include <ros/exceptions.h>

#include <algorithm>

#include "base/text.hpp"
#include "ros1/console.hpp"
#include "ros1/mounts.hpp"

namespace hallway::ros1 {
namespace {

/// How long the master gets to answer before this node leaves without telling it.
constexpr std::chrono::milliseconds kFarewellTime{1000};

}  // namespace

Session::Session(const Settings& settings) : address_(parse_master(settings.master)) {
  const MasterAnswer answer = wait_for_master(address_, settings.wait);
  if (!answer.pid) {
    throw sdk::Failure(HW_ERROR_IO, "no ROS master answers at " + address_.uri + " within " +
                                        format_double(std::chrono::duration<double>(settings.wait).count()) +
                                        " s (" + answer.problem + "); is roscore running there?");
  }
  Settings at_master = settings;
  at_master.master = address_.uri;
  try {
    node_.emplace(at_master);
    handle_.emplace();
    handle_->setCallbackQueue(&callbacks_);
    outputs_.emplace(*handle_, settings);
    inputs_.emplace(*handle_, settings);
  } catch (const ros::Exception& failure) {
    throw sdk::Failure(HW_ERROR_ARGUMENT, printable(failure.what(), 500));
  }
  spinner_.emplace(1, &callbacks_);
  spinner_->start();
  find_mounts(settings);
  watch_.emplace(address_, *answer.pid);
}

Session::~Session() {
  watch_.reset();
  spinner_->stop();
  const bool tell_master = ask_master(address_, kFarewellTime).pid.has_value();
  if (!tell_master)
    say(HW_LOG_WARNING, "the ROS master does not answer; this node leaves without telling it");
  // Before all that ends below, so that it asks the master nothing.
  node_->shut_down(tell_master);
}

void Session::find_mounts(const Settings& settings) {
  const auto until = std::chrono::steady_clock::now() + settings.wait;
  const bool asks_tf = std::any_of(settings.sensors.begin(), settings.sensors.end(),
                                   [](const SensorSettings& sensor) { return !sensor.mount.T_body_sensor; });
  std::optional<MountFinder> finder;
  if (asks_tf) finder.emplace(*handle_, settings.base_frame);
  for (std::uint32_t i = 0; i < settings.sensors.size(); ++i) {
    const SensorSettings& sensor = settings.sensors[i];
    if (sensor.mount.T_body_sensor) {
      mounts_.push_back(*sensor.mount.T_body_sensor);
      continue;
    }
    const auto frame = [&] {
      return sensor.mount.tf_frame.empty() ? inputs_->frame_of(i) : sensor.mount.tf_frame;
    };
    mounts_.push_back(finder->wait_for(sensor.topic, frame, until));
  }
}

std::vector<hw_counter_t> Session::counters() const {
  const InputCounts& counts = inputs_->counts();
  const auto number = [](std::uint64_t count) { return static_cast<double>(count); };
  return {
      {"messages_received", number(counts.received)},       {"messages_missed", number(counts.missed)},
      {"messages_malformed", number(counts.malformed)},     {"frames_overtaken", number(counts.overtaken)},
      {"frames_out_of_order", number(counts.out_of_order)}, {"points_dropped", number(counts.points_dropped)},
      {"master_lost", number(watch_->times_lost())}};
}

}  // namespace hallway::ros1
