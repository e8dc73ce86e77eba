// SPDX-License-Identifier: MIT
//
// A robot in real time that gives 50 frames at once: points, and a sample of a kind that Hallway does not have and of which none may be missed.
#include <cstdint>
#include <hallway/driver.hpp>

#include "support/made_up_sample.h"

namespace {

using hallway::sdk::DriverSettings;

constexpr std::uint64_t kFrames = 50;

class GivesMadeUp final : public hallway::sdk::Driver {
 public:
  static const hw_driver_info_t* info() {
    static constexpr hw_driver_info_t kInfo = hallway::sdk::driver_info(
        "gives_made_up", "Gives made-up samples", "1.0.0", "Hallway", "A robot of two sensors.", "");
    return &kInfo;
  }

  explicit GivesMadeUp(const hw_host_t* host) : Driver(host) {}

  void open(const DriverSettings&) override {}
  void close() override {}
  void write(const hw_answer_t&) override {}

  const hw_robot_info_t& describe() override {
    describe(eyes_, 0, HW_SAMPLE_POINTS, "eyes");
    describe(nose_, 1, hallway::test::kMadeUpSample, "nose");
    robot_.size = sizeof robot_;
    robot_.name = "two";
    robot_.sensors = sensors_;
    robot_.n_sensors = 2;
    return robot_;
  }

  Reading read(std::int64_t) override {
    if (given_ == kFrames) return {HW_READ_END, nullptr};
    const auto t_ns = static_cast<std::int64_t>(given_ * 1000);
    points_ = {};
    points_.size = sizeof points_;
    points_.stride = sizeof point_;
    points_.count = 1;
    points_.points = &point_;
    seen_ = {sizeof seen_, HW_SAMPLE_POINTS, 0, 0, given_, t_ns, t_ns, &points_};
    smelt_ = {sizeof smelt_, hallway::test::kMadeUpSample, 0, 1, given_, t_ns, t_ns, &made_up_};
    frame_ = {sizeof frame_, 2, given_, t_ns, samples_};
    ++given_;
    return {HW_READ_FRAME, &frame_};
  }

 private:
  static void describe(hw_sensor_info_t& sensor, std::uint32_t id, std::uint32_t kind, const char* name) {
    sensor.size = sizeof sensor;
    sensor.id = id;
    sensor.kind = kind;
    sensor.name = name;
    sensor.T_body_sensor.orientation[0] = 1.0;
  }

  std::uint64_t given_ = 0;
  hw_sensor_info_t eyes_{}, nose_{};
  const hw_sensor_info_t* sensors_[2] = {&eyes_, &nose_};
  hw_robot_info_t robot_{};
  hw_point3_t point_{1, 2, 3};
  hw_points_t points_{};
  hallway::test::MadeUp made_up_{};
  hw_sample_t seen_{}, smelt_{};
  const hw_sample_t* samples_[2] = {&seen_, &smelt_};
  hw_frame_t frame_{};
};

}  // namespace

HALLWAY_DRIVER(GivesMadeUp);
