// SPDX-License-Identifier: MIT
// publish_log LOG TOPIC DIAGNOSTICS_TOPIC [PAUSE_MS]
//
// Publishes the frames of a run log as PointCloud2 with float64 coordinates, each after the one before was answered: after
// diagnostics with its sequence number came. So a driver in lock-step is fed with exactly what stands in the log.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "log_frames.hpp"
#include "ros_messages.hpp"

namespace {

using hallway::test::LogFrame;

/// Longest wait for the driver to connect, and for an answer.
constexpr double kPatience_s = 60;

std::string answered;  ///< sequence number in the last diagnostics

void take_diagnostics(const diagnostic_msgs::DiagnosticArray& array) {
  for (const auto& status : array.status) {
    for (const auto& pair : status.values) {
      if (pair.key == "sequence") answered = pair.value;
    }
  }
}

template <typename Condition>
void wait_until(const char* what, Condition condition) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(kPatience_s);
  while (!condition()) {
    if (ros::WallTime::now() > end || !ros::ok())
      throw std::runtime_error(std::string("waited in vain for ") + what);
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01));
  }
}

void publish_log(const char* log, const char* topic, const char* diagnostics, int pause_ms) {
  const std::vector<LogFrame> frames = hallway::test::read_log_frames(log);
  ros::NodeHandle node;
  const ros::Publisher publisher = node.advertise<sensor_msgs::PointCloud2>(topic, 1);
  const ros::Subscriber answers = node.subscribe(diagnostics, 100, &take_diagnostics);
  wait_until("a driver",
             [&] { return publisher.getNumSubscribers() != 0 && answers.getNumPublishers() != 0; });
  for (const LogFrame& frame : frames) {
    publisher.publish(hallway::test::cloud_of(frame.points, frame.t_ns));
    const std::string sequence = std::to_string(frame.sequence);
    wait_until("an answer", [&] { return answered == sequence; });
    if (pause_ms != 0) ros::WallDuration(1e-3 * pause_ms).sleep();
  }
  std::printf("%zu frames\n", frames.size());
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(ros::M_string{{"__log", "/dev/null"}}, "publish_log", ros::init_options::NoRosout);
  if (argc != 4 && argc != 5) {
    std::fprintf(stderr, "publish_log LOG TOPIC DIAGNOSTICS_TOPIC [PAUSE_MS]\n");
    return 2;
  }
  try {
    publish_log(argv[1], argv[2], argv[3], argc == 5 ? std::atoi(argv[4]) : 0);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "publish_log: %s\n", failure.what());
    return 1;
  }
}
