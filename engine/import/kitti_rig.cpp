// SPDX-License-Identifier: MIT
#include <hallway/sample.h>

#include <utility>

#include "import/imu_stream.hpp"
#include "import/kitti_odometry.hpp"
#include "import/rig_recording.hpp"

namespace hallway::import {
namespace {

class KittiRig : public RigRecording {
 public:
  explicit KittiRig(KittiSequence sequence) : sequence_(std::move(sequence)) {
    sensors_.push_back(rig_sensor(0, HW_SAMPLE_POINTS, "lidar", {}));
  }

  std::uint32_t frames() const override { return sequence_.frames(); }
  void read(std::uint32_t index, RigFrame& frame) override {
    frame.t_ns = sequence_.t_ns[index];
    frame.T_world_body = sequence_.T_world_velodyne(index);
    frame.samples.clear();
    frame.samples.push_back({.sensor = 0,
                             .sequence = index,
                             .t_begin_ns = frame.t_ns,
                             .t_end_ns = frame.t_ns,
                             .content = sequence_.cloud(index)});
  }
  std::int64_t period_ns() const override {
    constexpr std::int64_t kOfTheBenchmark_ns = 100'000'000;
    return mean_period_ns(sequence_.t_ns.front(), sequence_.t_ns.back(), frames(), kOfTheBenchmark_ns);
  }
  bool has_truth() const override { return sequence_.has_truth(); }

 private:
  KittiSequence sequence_;
};

}  // namespace

std::unique_ptr<RigRecording> open_kitti_rig(const std::filesystem::path& folder) {
  return std::make_unique<KittiRig>(open_kitti_odometry(folder));
}

}  // namespace hallway::import
