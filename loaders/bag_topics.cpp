// SPDX-License-Identifier: MIT
#include "loaders/bag_topics.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::loaders::bag {
namespace {

constexpr const char* kPointTypes = "sensor_msgs/PointCloud2 or sensor_msgs/LaserScan";
constexpr const char* kPoseTypes = "nav_msgs/Odometry or geometry_msgs/PoseStamped";

std::string list_of(const std::vector<Topic>& topics) {
  constexpr std::size_t kShown = 100;
  std::string list;
  for (std::size_t i = 0; i < std::min(topics.size(), kShown); ++i) {
    list += (i == 0 ? "" : ", ") + printable(topics[i].name) + " (" + printable(topics[i].type) + ", " +
            std::to_string(topics[i].messages) + ")";
  }
  if (topics.size() > kShown) list += ", …";
  return topics.empty() ? "its topics: none" : "its topics: " + list;
}

const Topic& named(const std::vector<Topic>& topics, std::string_view wanted,
                   bool (*is_right)(std::string_view), const char* types) {
  const auto found =
      std::find_if(topics.begin(), topics.end(), [&](const Topic& t) { return t.name == wanted; });
  if (found == topics.end()) {
    throw Error(ErrorCode::kUsage, "has no topic " + printable(wanted) + "; " + list_of(topics));
  }
  if (!is_right(found->type)) {
    throw Error(ErrorCode::kUsage,
                "topic " + printable(wanted) + " is not of " + types + "; " + list_of(topics));
  }
  return *found;
}

}  // namespace

bool is_point_type(std::string_view type) {
  return type == "sensor_msgs/PointCloud2" || type == "sensor_msgs/LaserScan";
}

bool is_pose_type(std::string_view type) {
  return type == "nav_msgs/Odometry" || type == "geometry_msgs/PoseStamped";
}

const Topic& choose_points(const std::vector<Topic>& topics, std::string_view wanted) {
  if (!wanted.empty()) return named(topics, wanted, is_point_type, kPointTypes);
  const auto is_right = [](const Topic& topic) { return is_point_type(topic.type); };
  const auto first = std::find_if(topics.begin(), topics.end(), is_right);
  if (first == topics.end()) {
    throw Error(ErrorCode::kBadInput, std::string("has no topic of ") + kPointTypes + "; " + list_of(topics));
  }
  if (std::count_if(topics.begin(), topics.end(), is_right) > 1) {
    throw Error(ErrorCode::kUsage, "has several topics of points: --topic is needed; " + list_of(topics));
  }
  return *first;
}

const Topic& choose_poses(const std::vector<Topic>& topics, std::string_view wanted) {
  return named(topics, wanted, is_pose_type, kPoseTypes);
}

}  // namespace hallway::loaders::bag
