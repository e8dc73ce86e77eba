// SPDX-License-Identifier: MIT
// hallway-bag: reads the messages of a ROS 1 bag and hands them to the program that started it (engine/import/bag_protocol.hpp).
#include <stdlib.h>  // setenv is POSIX, not in <cstdlib>

#include <functional>

#include "base/sandbox.hpp"
#include "import/bag_protocol.hpp"
#include "loaders/bag_file.hpp"
#include "loaders/bag_points.hpp"
#include "loaders/bag_topics.hpp"
#include "loaders/helper_main.hpp"
#include "loaders/refuse.hpp"

namespace {

namespace bag = hallway::loaders::bag;
using hallway::Error;
namespace recorded = hallway::import;

recorded::BagHead head_of(const bag::BagFile& file, const bag::Topic& topic, const std::string& truth_topic) {
  const auto span_ns = file.span_ns(topic.name);
  recorded::BagHead head{topic.name, topic.messages, span_ns[0], span_ns[1], {}};
  if (truth_topic.empty()) return head;
  const bag::Topic& truth = bag::choose_poses(file.topics(), truth_topic);
  file.read_poses(truth.name, [&](const bag::StampedPose& pose) {
    const auto& t = pose.position_m;
    const auto& q = pose.orientation;
    head.truth.push_back({pose.t_ns, {t[0], t[1], t[2]}, {q[0], q[1], q[2], q[3]}});
  });
  return head;
}

/// Makes frames of messages and sends them.
class Sender {
 public:
  Sender(std::string topic, std::uint32_t stride) : topic_(std::move(topic)), stride_(stride) {}

  void operator()(const bag::Cloud& cloud) {
    send([&] { bag::take_cloud(cloud, stride_, frame_); });
  }
  void operator()(const bag::Scan& scan) {
    send([&] { bag::take_scan(scan, stride_, frame_); });
  }

 private:
  template <typename Take>
  void send(Take&& take) {
    const std::int64_t last_ns = frame_.t_ns;
    const std::string element = "message " + std::to_string(number_++) + " of " + hallway::printable(topic_);
    try {
      take();
    } catch (const Error& error) {
      throw Error(error.code(), error.message(), {.element = element});
    }
    if (frame_.t_ns < last_ns) {
      hallway::loaders::refuse("its stamp lies before that of the message before it", element);
    }
    hallway::write_standard_output(recorded::encode_frame(frame_));
  }

  std::string topic_;
  std::uint32_t stride_;
  std::uint64_t number_ = 0;
  recorded::Frame frame_;
};

/// ROS's library looks for its plugins among all packages of ROS and keeps a list of these in the user's home; for encrypted bags it starts gpg. A
/// reader of bags needs its own package, writes nothing and starts nothing.
void keep_ros_at_home() {
  ::setenv("ROS_PACKAGE_PATH", HALLWAY_ROSBAG_PACKAGE, 1);
  constexpr std::uint64_t kMemoryBytes = std::uint64_t{4} << 30;
  hallway::confine({.data_bytes = kMemoryBytes, .file_bytes = 0, .open_files = 64});
}

void answer(const std::string& text) {
  keep_ros_at_home();
  const recorded::BagRequest request = recorded::decode_request(text);
  const bag::BagFile file(request.file);
  const bag::Topic& topic = bag::choose_points(file.topics(), request.topic);
  hallway::write_standard_output(recorded::encode_head(head_of(file, topic, request.truth_topic)));
  Sender send(topic.name, request.stride);
  if (topic.type == "sensor_msgs/LaserScan") {
    file.read_scans(topic.name, std::ref(send));
  } else {
    file.read_clouds(topic.name, std::ref(send));
  }
  hallway::write_standard_output(recorded::encode_end());
}

}  // namespace

int main(int argc, char** argv) {
  return hallway::loaders::helper_main(argc, argv, "the bag reader", answer, recorded::encode_failure);
}
