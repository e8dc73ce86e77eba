// SPDX-License-Identifier: MIT
//
// A log as a robot: gives the frames of an .mcap log of `hallway run`, `hallway-robot` or `hallway log convert`, and takes no commands.
#include <time.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <hallway/driver.hpp>
#include <limits>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "base/text.hpp"
#include "host/c_activation.hpp"
#include "robot/drivers/recorded_frames.hpp"

namespace {

using hallway::robot::RecordedFrames;
using hallway::sdk::DriverSettings;
using hallway::sdk::Failure;

constexpr const char* kKeys[] = {"log", "pace", "rate_hz", "loop", "steps"};
constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::int64_t now_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * kSecond_ns + now.tv_nsec;
}

void sleep_until_ns(std::int64_t t_ns) {
  const timespec at{.tv_sec = t_ns / kSecond_ns, .tv_nsec = t_ns % kSecond_ns};
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr) != 0) {
  }
}

[[noreturn]] void refuse(const std::string& key, const std::string& value, const char* wanted) {
  throw Failure(HW_ERROR_ARGUMENT, key + ": \"" + hallway::printable(value) + "\" is not " + wanted);
}

bool read_flag(const DriverSettings& settings, const char* key) {
  const std::string value = settings.text(key, "false");
  if (value != "true" && value != "false") refuse(key, value, "true or false");
  return value == "true";
}

class Replay final : public hallway::sdk::Driver {
 public:
  static const hw_driver_info_t* info() {
    static constexpr hw_driver_info_t kInfo = hallway::sdk::driver_info(
        "replay", "Replay", "0.1.0", "Hallway", "Gives the frames of a recorded log.",
        "log      the .mcap log; needed\n"
        "pace     recorded: in real time, as the log's times say; fast: in lock-step, as fast as they are "
        "answered [recorded]\n"
        "rate_hz  frames in a second instead of the log's own times; with pace = recorded [as recorded]\n"
        "loop     begin again at the end; times and numbers go on [false]\n"
        "steps    how many frames to give; 0 for all [0]\n");
    return &kInfo;
  }

  explicit Replay(const hw_host_t* host) : Driver(host) {}

  void open(const DriverSettings& settings) override {
    settings.expect_only(kKeys);
    const std::string log = settings.text("log");
    if (log.empty()) throw Failure(HW_ERROR_ARGUMENT, "log: is missing");
    read_pace(settings);
    loop_ = read_flag(settings, "loop");
    const std::string steps = settings.text("steps", "0");
    const auto parsed = hallway::parse_uint(steps);
    if (!parsed) refuse("steps", steps, "a whole number from 0 on");
    steps_ = *parsed;
    try {
      frames_.emplace(std::filesystem::path(settings.folder()) / log);
    } catch (const hallway::Error& error) {
      throw Failure(error.code() == hallway::ErrorCode::kBadInput ? HW_ERROR_DATA : HW_ERROR_IO,
                    error.what());
    }
    given_ = 0;
  }

  const hw_robot_info_t& describe() override {
    facts_.emplace(frames_->activation());
    robot_ = {};
    robot_.size = sizeof robot_;
    robot_.flags = lock_step_ ? HW_ROBOT_LOCK_STEP : 0;
    robot_.name = "a recorded robot";
    robot_.period_ns = rate_hz_ ? period_ns() : frames_->period_ns();
    facts_->fill(robot_);
    return robot_;
  }

  Reading read(std::int64_t wait_ns) override {
    if (steps_ > 0 && given_ == steps_) return {HW_READ_END, nullptr};
    if (next_ == nullptr) next_ = advance();
    if (next_ == nullptr) return {HW_READ_END, nullptr};
    if (!lock_step_ && !wait_until_due(wait_ns)) return {};
    ++given_;
    const hw_frame_t* frame = std::exchange(next_, nullptr);
    return {HW_READ_FRAME, frame};
  }

  /// A log goes where it went.
  void write(const hw_answer_t&) override {}

  void close() override {
    frames_.reset();
    next_ = nullptr;
  }

 private:
  void read_pace(const DriverSettings& settings) {
    const std::string pace = settings.text("pace", "recorded");
    if (pace != "recorded" && pace != "fast") refuse("pace", pace, "recorded or fast");
    lock_step_ = pace == "fast";
    rate_hz_.reset();
    const std::string rate = settings.text("rate_hz");
    if (rate.empty()) return;
    rate_hz_ = hallway::parse_double(rate);
    if (!rate_hz_ || *rate_hz_ < 0.1 || *rate_hz_ > 10'000.0) {
      refuse("rate_hz", rate, "a number from 0.1 to 10000");
    }
  }

  std::int64_t period_ns() const { return static_cast<std::int64_t>(1e9 / *rate_hz_ + 0.5); }

  const hw_frame_t* advance() {
    try {
      return frames_->next(loop_);
    } catch (const hallway::Error& error) {
      throw Failure(HW_ERROR_DATA, error.what());
    }
  }

  /// False if the next frame is not due within the time.
  bool wait_until_due(std::int64_t wait_ns) {
    const std::int64_t now = now_ns();
    if (given_ == 0) {
      start_ns_ = now;
      first_t_ns_ = next_->t_ns;
    }
    const std::int64_t since =
        rate_hz_ ? static_cast<std::int64_t>(given_) * period_ns() : next_->t_ns - first_t_ns_;
    const std::int64_t due = start_ns_ + since;
    if (due - now > wait_ns) {
      if (wait_ns > 0) sleep_until_ns(now + wait_ns);
      return false;
    }
    if (due > now) sleep_until_ns(due);
    return true;
  }

  bool lock_step_ = false;
  std::optional<double> rate_hz_;
  bool loop_ = false;
  std::uint64_t steps_ = 0;
  std::optional<RecordedFrames> frames_;
  std::optional<hallway::host::CActivation> facts_;  ///< what robot_ points to
  hw_robot_info_t robot_{};
  const hw_frame_t* next_ = nullptr;  ///< read and not yet given
  std::uint64_t given_ = 0;
  std::int64_t start_ns_ = 0;    ///< when the first frame was given, monotonic clock
  std::int64_t first_t_ns_ = 0;  ///< its own time
};

}  // namespace

HALLWAY_DRIVER(Replay);
