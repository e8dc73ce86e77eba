// SPDX-License-Identifier: MIT
// Recordings with an IMU as rigs: EuRoC, and folders of PCD files.
#include <fmt/format.h>
#include <hallway/sample.h>

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "import/euroc.hpp"
#include "import/imu_stream.hpp"
#include "import/pcd_imu_folder.hpp"
#include "import/rig_recording.hpp"
#include "log/observations.hpp"

namespace hallway::import {
namespace {

namespace fs = std::filesystem;

/// True poses, asked for a time with a tolerance and without.
struct RigTruth {
  RigTruth(const std::vector<TimedPose>& poses, std::int64_t within_ns)
      : near(poses, within_ns), exact(poses, 0) {}

  TrueTrack near;
  TrueTrack exact;
};

std::vector<TimedPose> poses_of(const std::vector<EurocState>& states) {
  std::vector<TimedPose> poses;
  for (const EurocState& state : states) poses.push_back({state.t_ns, state.T_world_body});
  return poses;
}

host::SensorInfo sensor_of(const EurocImuSensor& imu) {
  host::SensorInfo sensor = rig_sensor(0, HW_SAMPLE_IMU, "imu0", imu.T_body_imu);
  sensor.rate_hz = imu.rate_hz;
  sensor.intrinsics = host::ImuIntrinsics{.angular_noise = imu.gyroscope_noise_density,
                                          .angular_walk = imu.gyroscope_random_walk,
                                          .force_noise = imu.accelerometer_noise_density,
                                          .force_walk = imu.accelerometer_random_walk};
  return sensor;
}

class EurocRig : public RigRecording {
 public:
  EurocRig(EurocSequence sequence, const RigOptions& options, const fs::path& folder)
      : truth_(poses_of(sequence.truth), options.truth_within_ns),
        imu_(std::move(sequence.imu)),
        period_ns_(options.period_ns) {
    sensors_.push_back(sensor_of(sequence.sensor));
    const std::int64_t frames = (imu_.end_ns() - imu_.begin_ns() + period_ns_ - 1) / period_ns_ + 1;
    if (frames > std::int64_t{log::kMaxIteration})
      throw Error(
          ErrorCode::kBadInput,
          fmt::format("at {} ns from frame to frame there are more frames than a log may have", period_ns_),
          {.file = printable(folder.string(), 4096)});
    frames_ = static_cast<std::uint32_t>(frames);
  }

  std::uint32_t frames() const override { return frames_; }
  void read(std::uint32_t index, RigFrame& frame) override {
    frame.t_ns = imu_.begin_ns() + period_ns_ * std::int64_t{index};
    frame.T_world_body = truth_.near.at(frame.t_ns);
    frame.samples.clear();
    imu_.add_samples(index == 0 ? -1 : frame.t_ns - period_ns_, 0, truth_.exact, frame);
  }
  std::int64_t period_ns() const override { return period_ns_; }
  bool has_truth() const override { return !truth_.near.empty(); }

 private:
  RigTruth truth_;
  ImuStream imu_;
  std::int64_t period_ns_;
  std::uint32_t frames_ = 0;
};

/// Makes the times of a cloud's points count from the begin of the reading, which it says.
RigSample reading_of(LidarCloud cloud, std::int64_t t_ns, const fs::path& file) {
  RigSample sample{.t_begin_ns = t_ns, .t_end_ns = t_ns};
  if (!cloud.t_offset_ns.empty()) {
    const auto [first, last] = std::ranges::minmax(cloud.t_offset_ns);
    sample.t_begin_ns += std::min<std::int64_t>(first, 0);
    sample.t_end_ns += std::max<std::int64_t>(last, 0);
    if (sample.t_begin_ns < 0)
      throw Error(ErrorCode::kBadInput, "a point's time is below 0",
                  {.file = printable(file.string(), 4096)});
    for (std::int64_t& offset : cloud.t_offset_ns) offset += t_ns - sample.t_begin_ns;
  }
  sample.content = std::move(cloud);
  return sample;
}

class PcdImuRig : public RigRecording {
 public:
  PcdImuRig(PcdImuFolder folder, const RigOptions& options)
      : folder_(std::move(folder)),
        truth_(folder_.truth, options.truth_within_ns),
        imu_(std::move(folder_.imu)) {
    const RigMounts mounts = folder_.mounts.value_or(RigMounts{});
    sensors_.push_back(rig_sensor(kLidar, HW_SAMPLE_POINTS, "lidar", mounts.T_body_lidar));
    sensors_.push_back(rig_sensor(kImu, HW_SAMPLE_IMU, "imu", mounts.T_body_imu));
    const auto first = folder_.cloud(0);
    const auto last_ns = first.t_offset_ns.empty() ? 0 : std::ranges::max(first.t_offset_ns);
    for (const TimedCloud& cloud : folder_.clouds) times_.push_back(cloud.t_ns);
    if (last_ns > 0) {
      first_ = 1;
      times_.push_back(times_.back() + (times_.size() == 1 ? last_ns : usual_period_ns()));
    }
    if (imu_.end_ns() > times_.back()) times_.push_back(imu_.end_ns());
  }

  std::uint32_t frames() const override { return static_cast<std::uint32_t>(times_.size()); }
  void read(std::uint32_t index, RigFrame& frame) override {
    frame.t_ns = times_[index];
    frame.T_world_body = truth_.near.at(frame.t_ns);
    frame.samples.clear();
    if (index >= first_ && index - first_ < folder_.clouds.size()) {
      const std::size_t number = index - first_;
      const TimedCloud& cloud = folder_.clouds[number];
      RigSample& sample =
          frame.samples.emplace_back(reading_of(folder_.cloud(number), cloud.t_ns, cloud.file));
      sample.sensor = kLidar;
      sample.sequence = number;
      sample.T_world_body = truth_.exact.at(sample.t_end_ns);
    }
    imu_.add_samples(index == 0 ? -1 : times_[index - 1], kImu, truth_.exact, frame);
  }
  std::int64_t period_ns() const override { return usual_period_ns(); }
  bool has_truth() const override { return !truth_.near.empty(); }

 private:
  static constexpr std::uint32_t kLidar = 0, kImu = 1;

  std::int64_t usual_period_ns() const {
    constexpr std::int64_t kOtherwise_ns = 100'000'000;
    return mean_period_ns(folder_.clouds.front().t_ns, folder_.clouds.back().t_ns, folder_.clouds.size(),
                          kOtherwise_ns);
  }

  PcdImuFolder folder_;
  RigTruth truth_;
  ImuStream imu_;
  std::vector<std::int64_t> times_;  ///< of the frames
  std::uint32_t first_ = 0;          ///< the frame that has the first cloud
};

}  // namespace

std::unique_ptr<RigRecording> open_euroc_rig(const fs::path& folder, const RigOptions& options) {
  return std::make_unique<EurocRig>(read_euroc(folder), options, folder);
}

std::unique_ptr<RigRecording> open_pcd_imu_rig(const fs::path& folder, const RigOptions& options) {
  return std::make_unique<PcdImuRig>(open_pcd_imu_folder(folder), options);
}

}  // namespace hallway::import
