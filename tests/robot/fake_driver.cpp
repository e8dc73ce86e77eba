// SPDX-License-Identifier: MIT
//
// A robot that does what its settings say, and writes down what it gives and gets: a line "TIME frame SEQUENCE" for each frame given and
// "TIME answer SEQUENCE STATUS LINEAR ANGULAR LANDMARKS MESSAGE" for each answer, times in ns of the monotonic clock.
#include <time.h>
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <hallway/driver.hpp>
#include <mutex>
#include <string>
#include <vector>

namespace {

using hallway::sdk::DriverSettings;
using hallway::sdk::Failure;

constexpr std::int64_t kMillisecond_ns = 1'000'000;

std::int64_t now_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

void sleep_ns(std::int64_t ns) {
  const timespec time{.tv_sec = ns / 1'000'000'000, .tv_nsec = ns % 1'000'000'000};
  if (ns > 0) ::nanosleep(&time, nullptr);
}

class Fake final : public hallway::sdk::Driver {
 public:
  static const hw_driver_info_t* info() {
    static constexpr hw_driver_info_t kInfo = hallway::sdk::driver_info(
        "fake_driver", "Fake", "1.0.0", "Hallway", "A robot that does what its settings say.",
        "log         file that is written [none]\n"
        "frames      how many it gives; 0 for no end [100]\n"
        "period_ms   from frame to frame [20]\n"
        "lock_step   time is its own [false]\n"
        "fail        open, describe: where it fails [nowhere]\n"
        "read_error  frame at which read() fails [none]\n"
        "write_error answer at which write() fails [none]\n"
        "gap         frame before which three are missing [none]\n"
        "stall       frame before which there is none for stall_ms [none]\n"
        "stall_ms    how long [500]\n"
        "nan         frame that has a point that is none [none]\n"
        "speed       greatest of its drive, which is tracked [its drive is not known]\n"
        "old         it was built before robots had drives: what is there is none [false]\n");
    return &kInfo;
  }

  explicit Fake(const hw_host_t* host) : Driver(host) {}
  ~Fake() override {
    if (log_ != nullptr) std::fclose(log_);
  }

  void open(const DriverSettings& settings) override {
    fail_ = settings.text("fail");
    if (fail_ == "open") throw Failure(HW_ERROR_IO, "no robot answers");
    frames_ = number(settings, "frames", 100);
    period_ns_ = number(settings, "period_ms", 20) * kMillisecond_ns;
    lock_step_ = settings.text("lock_step") == "true";
    read_error_ = number(settings, "read_error", -1);
    write_error_ = number(settings, "write_error", -1);
    gap_ = number(settings, "gap", -1);
    stall_ = number(settings, "stall", -1);
    stall_ns_ = number(settings, "stall_ms", 500) * kMillisecond_ns;
    nan_ = number(settings, "nan", -1);
    speed_ = settings.text("speed");
    old_ = settings.text("old") == "true";
    const std::string log = settings.text("log");
    if (!log.empty()) log_ = std::fopen(log.c_str(), "we");
  }

  const hw_robot_info_t& describe() override {
    if (fail_ == "describe") throw Failure(HW_ERROR_IO, "the robot says nothing of itself");
    sensor_ = {};
    sensor_.size = sizeof sensor_;
    sensor_.kind = HW_SAMPLE_POINTS;
    sensor_.name = "eyes";
    sensor_.T_body_sensor.orientation[0] = 1.0;
    sensor_.horizontal_fov = sensor_.vertical_fov = 1.5;
    sensor_.min_range_m = 0.1;
    sensor_.max_range_m = 50.0;
    for (double& noise : sensor_.noise_m) noise = 0.01;
    robot_ = {};
    robot_.size = sizeof robot_;
    robot_.flags = lock_step_ ? HW_ROBOT_LOCK_STEP : 0;
    robot_.name = "fake";
    robot_.period_ns = period_ns_;
    robot_.sensors = &sensor_pointer_;
    robot_.n_sensors = 1;
    if (!speed_.empty()) {
      drive_.size = sizeof drive_;
      drive_.kind = HW_DRIVE_TRACKED;
      drive_.max_speed_m_s = std::strtod(speed_.c_str(), nullptr);
      robot_.drive = &drive_;
    }
    if (old_) {
      robot_.size = offsetof(hw_robot_info_t, drive);
      robot_.drive = reinterpret_cast<const hw_drive_info_t*>(std::uintptr_t{8});  // behind its end
    }
    return robot_;
  }

  Reading read(std::int64_t wait_ns) override {
    if (given_ == read_error_) throw Failure(HW_ERROR_IO, "the line is dead");
    if (frames_ > 0 && given_ >= frames_) return {HW_READ_END, nullptr};
    if (!lock_step_ && !wait_until_due(wait_ns)) return {};
    build();
    note("frame " + std::to_string(frame_.sequence));
    ++given_;
    return {HW_READ_FRAME, &frame_};
  }

  void write(const hw_answer_t& answer) override {
    if (written_++ == write_error_) throw Failure(HW_ERROR_IO, "the wheels do not listen");
    const double linear = answer.command != nullptr ? answer.command->linear_m_s : NAN;
    const double angular = answer.command != nullptr ? answer.command->angular_rad_s : NAN;
    note("answer " + std::to_string(answer.sequence) + " " + std::to_string(answer.status) + " " +
         std::to_string(linear) + " " + std::to_string(angular) + " " +
         std::to_string(answer.landmarks != nullptr ? answer.landmarks->count : 0) + " " +
         (answer.message != nullptr ? answer.message : ""));
  }

  const hw_counters_t* counters() override {
    counter_ = {"fake_frames", static_cast<double>(given_)};
    counters_ = {sizeof counters_, sizeof counter_, 1, &counter_};
    return &counters_;
  }

  void close() override { note("closed"); }

 private:
  static std::int64_t number(const DriverSettings& settings, const char* key, std::int64_t otherwise) {
    const std::string text = settings.text(key);
    return text.empty() ? otherwise : std::strtoll(text.c_str(), nullptr, 10);
  }

  bool wait_until_due(std::int64_t wait_ns) {
    const std::int64_t now = now_ns();
    if (given_ == 0) start_ns_ = now;
    if (given_ == stall_) {
      start_ns_ += stall_ns_;
      stall_ = -1;
    }
    const std::int64_t due = start_ns_ + given_ * period_ns_;
    sleep_ns(std::min(due - now, wait_ns));
    return due - now <= wait_ns;
  }

  /// The same points in every frame.
  void build() {
    points_.clear();
    for (int i = 0; i < 20; ++i) {
      points_.push_back({5.0 + 0.7 * (i % 5), -3.0 + 0.4 * i, 0.5 * std::sin(i)});
    }
    if (given_ == nan_) points_.front().x = NAN;
    payload_ = {sizeof payload_,
                sizeof(hw_point3_t),
                points_.size(),
                points_.data(),
                nullptr,
                0,
                0,
                nullptr,
                nullptr,
                nullptr,
                nullptr};
    const std::int64_t t_ns = given_ * period_ns_;
    const auto sequence = static_cast<std::uint64_t>(given_ + (gap_ >= 0 && given_ >= gap_ ? 3 : 0));
    sample_ = {sizeof sample_, HW_SAMPLE_POINTS, 0, 0, sequence, t_ns, t_ns, &payload_};
    frame_ = {sizeof frame_, 1, sequence, t_ns, &sample_pointer_};
  }

  void note(const std::string& text) {
    const std::lock_guard lock(mutex_);
    if (log_ == nullptr) return;
    std::fprintf(log_, "%lld %s\n", static_cast<long long>(now_ns()), text.c_str());
    std::fflush(log_);
  }

  std::mutex mutex_;
  std::FILE* log_ = nullptr;
  std::string fail_;
  std::int64_t frames_ = 0, period_ns_ = 0, read_error_ = -1, write_error_ = -1, gap_ = -1, stall_ = -1;
  std::int64_t stall_ns_ = 0, nan_ = -1, given_ = 0, start_ns_ = 0, written_ = 0;
  bool lock_step_ = false;
  hw_sensor_info_t sensor_{};
  const hw_sensor_info_t* sensor_pointer_ = &sensor_;
  std::string speed_;
  bool old_ = false;
  hw_drive_info_t drive_{};
  hw_robot_info_t robot_{};
  std::vector<hw_point3_t> points_;
  hw_points_t payload_{};
  hw_sample_t sample_{};
  const hw_sample_t* sample_pointer_ = &sample_;
  hw_frame_t frame_{};
  hw_counter_t counter_{};
  hw_counters_t counters_{};
};

}  // namespace

HALLWAY_DRIVER(Fake);
