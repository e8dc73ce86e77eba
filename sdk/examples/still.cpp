// SPDX-License-Identifier: MIT
#include <hallway/plugin.hpp>

class Still final : public hallway::sdk::Plugin {
 public:
  static const hw_plugin_info_t* info() {
    static constexpr std::uint32_t kInputs[] = {HW_SAMPLE_POINTS}, kOutputs[] = {HW_OUTPUT_POSE};
    static constexpr hw_plugin_info_t kInfo = hallway::sdk::plugin_info(
        "still", "Still", "0.1.0", "", "Believes that the robot stands still.", kInputs, kOutputs);
    return &kInfo;
  }
  explicit Still(const hw_host_t* host) : Plugin(host) {}

  // Once per frame. frame.samples holds what the sensors saw, in metres: x forward, y left, z up.
  void process(const hw_frame_t&) override {
    host().put_pose({{0, 0, 0}, {1, 0, 0, 0}});  // where the robot is: position, quaternion w x y z
  }
  void report(bool) override {}  // when the host wants the map
  void reset() override {}       // forget the map
};
HALLWAY_PLUGINS(Still);
