// SPDX-License-Identifier: MIT
// The driver `ros1`: a robot whose sensors and base are topics of ROS 1.
#include <hallway/driver.hpp>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "ros1/console.hpp"
#include "ros1/session.hpp"
#include "ros1/settings.hpp"

namespace hallway::ros1 {
namespace {

using namespace std::chrono_literals;

/// How long read() waits before it looks whether the node or its publishers have gone.
constexpr std::chrono::nanoseconds kLookPeriod = 50ms;
/// How long roscpp gets to send the last command, which nothing says was sent.
constexpr auto kLastCommandTime = 100ms;

class Ros1 final : public sdk::Driver {
 public:
  static const hw_driver_info_t* info() {
    static const hw_driver_info_t kInfo = sdk::driver_info(
        "ros1", "ROS 1", "1.0.0", "Hallway",
        "Reads PointCloud2 and LaserScan topics, publishes commands, poses, the map and diagnostics.",
        settings_help());
    return &kInfo;
  }

  explicit Ros1(const hw_host_t* host) : Driver(host) {}

  void open(const sdk::DriverSettings& given) override {
    settings_ = read_settings(given);
    open_console(host());
    try {
      session_ = std::make_unique<Session>(settings_);
    } catch (...) {
      close_console();
      throw;
    }
    has_read_ = false;
    publishers_gone_ = false;
    make_robot();
  }

  const hw_robot_info_t& describe() override { return robot_; }

  Reading read(std::int64_t wait_ns) override {
    const auto until =
        std::chrono::steady_clock::now() + std::chrono::nanoseconds(std::max<std::int64_t>(wait_ns, 0));
    for (;;) {
      const auto left = until - std::chrono::steady_clock::now();
      std::optional<ros1::Reading> next =
          session_->inputs().readings().pop(std::clamp<std::chrono::nanoseconds>(left, 0ns, kLookPeriod));
      if (settings_.lock_step && session_->inputs().has_lost()) {
        throw sdk::Failure(HW_ERROR_IO,
                           "lock_step: messages were lost, could not be read or were out of order");
      }
      if (next) return {HW_READ_FRAME, &make_frame(std::move(*next))};
      if (Node::end_asked() || log_has_ended()) return {HW_READ_END, nullptr};
      if (left <= 0ns) return {HW_READ_NOTHING, nullptr};
    }
  }

  void write(const hw_answer_t& answer) override {
    session_->outputs().publish(answer, session_->counters(), session_->master().answers());
  }

  const hw_counters_t* counters() override {
    counter_list_ = session_->counters();
    counters_.size = sizeof counters_;
    counters_.stride = sizeof(hw_counter_t);
    counters_.count = counter_list_.size();
    counters_.counters = counter_list_.data();
    return &counters_;
  }

  void close() override {
    session_->outputs().stop();
    std::this_thread::sleep_for(kLastCommandTime);
    session_.reset();
    close_console();
  }

 private:
  void make_robot() {
    sensor_infos_.clear();
    sensors_.clear();
    for (std::uint32_t i = 0; i < settings_.sensors.size(); ++i) {
      const SensorSettings& sensor = settings_.sensors[i];
      hw_sensor_info_t info{};
      info.size = sizeof info;
      info.id = i;
      info.kind = HW_SAMPLE_POINTS;
      info.name = sensor.topic.c_str();
      info.T_body_sensor = session_->mounts()[i];
      info.horizontal_fov = sensor.horizontal_fov;
      info.vertical_fov = sensor.vertical_fov;
      info.min_range_m = sensor.min_range_m;
      info.max_range_m = sensor.max_range_m;
      std::copy(std::begin(sensor.noise_m), std::end(sensor.noise_m), std::begin(info.noise_m));
      info.rate_hz = info.latency_s = SensorSettings::kUnknown;
      std::fill(std::begin(info.noise_per_m), std::end(info.noise_per_m), SensorSettings::kUnknown);
      sensor_infos_.push_back(info);
    }
    for (const hw_sensor_info_t& info : sensor_infos_) sensors_.push_back(&info);
    robot_ = {};
    robot_.size = sizeof robot_;
    robot_.flags = settings_.lock_step ? HW_ROBOT_LOCK_STEP : 0;
    robot_.name = settings_.node.c_str();
    robot_.period_ns = settings_.period_ns;
    robot_.sensors = sensors_.data();
    robot_.n_sensors = static_cast<std::uint32_t>(sensors_.size());
  }

  const hw_frame_t& make_frame(ros1::Reading reading) {
    current_ = std::move(reading);
    points_ = {sizeof points_, sizeof(hw_point3_t), current_.points.size(), current_.points.data(), nullptr};
    sample_ = {};
    sample_.size = sizeof sample_;
    sample_.kind = HW_SAMPLE_POINTS;
    sample_.sensor_id = current_.sensor;
    sample_.sequence = current_.sensor_sequence;
    sample_.t_begin_ns = sample_.t_end_ns = current_.t_ns;
    sample_.payload = &points_;
    samples_ = &sample_;
    frame_ = {sizeof frame_, 1, current_.sequence, current_.t_ns, &samples_};
    has_read_ = true;
    return frame_;
  }

  /// In lock-step, what is read is a log that ends: its publisher has gone. It is asked twice, for the last message may still be on
  /// its way from the connection that ended to the queue.
  bool log_has_ended() {
    const bool gone = settings_.lock_step && has_read_ && !session_->inputs().has_publishers();
    return std::exchange(publishers_gone_, gone) && gone;
  }

  Settings settings_;
  std::unique_ptr<Session> session_;
  hw_robot_info_t robot_{};
  std::vector<hw_sensor_info_t> sensor_infos_;
  std::vector<const hw_sensor_info_t*> sensors_;
  bool has_read_ = false;
  bool publishers_gone_ = false;
  ros1::Reading current_;
  hw_points_t points_{};
  hw_sample_t sample_{};
  const hw_sample_t* samples_ = nullptr;
  hw_frame_t frame_{};
  std::vector<hw_counter_t> counter_list_;
  hw_counters_t counters_{};
};

}  // namespace
}  // namespace hallway::ros1

HALLWAY_DRIVER(hallway::ros1::Ros1);
