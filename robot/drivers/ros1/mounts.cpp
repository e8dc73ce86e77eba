// SPDX-License-Identifier: MIT
#include "ros1/mounts.hpp"

#include <boost/function.hpp>

#include "base/text.hpp"

namespace hallway::ros1 {
namespace {

hw_pose_t pose_of(const geometry_msgs::Transform& transform) {
  const auto& t = transform.translation;
  const auto& q = transform.rotation;
  return {{t.x, t.y, t.z}, {q.w, q.x, q.y, q.z}};
}

}  // namespace

MountFinder::MountFinder(ros::NodeHandle& handle, std::string base_frame)
    : base_frame_(std::move(base_frame)) {
  const boost::function<void(const tf2_msgs::TFMessageConstPtr&)> callback =
      [this](const tf2_msgs::TFMessageConstPtr& message) { take(*message); };
  moving_ = handle.subscribe<tf2_msgs::TFMessage>("/tf", 100, callback);
  fixed_ = handle.subscribe<tf2_msgs::TFMessage>("/tf_static", 100, callback);
}

void MountFinder::take(const tf2_msgs::TFMessage& message) {
  const std::lock_guard lock(mutex_);
  for (const geometry_msgs::TransformStamped& edge : message.transforms) {
    tree_.set(edge.header.frame_id, edge.child_frame_id, pose_of(edge.transform));
  }
  changed_.notify_all();
}

void MountFinder::fail(const std::string& topic, const std::string& frame) const {
  if (frame.empty()) {
    throw sdk::Failure(HW_ERROR_IO, "mount: no message came on " + printable(topic) +
                                        " that would name the sensor's frame; \"tf FRAME\" names it");
  }
  throw sdk::Failure(HW_ERROR_IO, "mount: tf does not say where " + printable(frame) + " (" +
                                      printable(topic) + ") is on " + printable(base_frame_));
}

}  // namespace hallway::ros1
