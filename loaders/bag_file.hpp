// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>

#include "loaders/bag_messages.hpp"

namespace hallway::loaders::bag {

/// A ROS 1 bag. Messages are those of one topic, in the order of the bag; their times are those of their stamps or, where a stamp is 0, when they were
/// recorded. All functions throw Error{kBadInput} for a bag or a message that cannot be read.
class BagFile {
 public:
  explicit BagFile(const std::string& path);
  ~BagFile();
  BagFile(const BagFile&) = delete;
  BagFile& operator=(const BagFile&) = delete;

  /// By name.
  const std::vector<Topic>& topics() const { return topics_; }
  /// When the first and the last message of a topic were recorded.
  std::array<std::int64_t, 2> span_ns(const std::string& topic) const;
  void read_clouds(const std::string& topic, const std::function<void(const Cloud&)>& take) const;
  void read_scans(const std::string& topic, const std::function<void(const Scan&)>& take) const;
  void read_poses(const std::string& topic, const std::function<void(const StampedPose&)>& take) const;

 private:
  struct Ros;
  std::unique_ptr<Ros> ros_;
  std::vector<Topic> topics_;
};

}  // namespace hallway::loaders::bag
