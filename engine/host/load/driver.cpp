// SPDX-License-Identifier: MIT
#include "host/load/driver.hpp"

#include <fmt/format.h>
#include <hallway/ext/log.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <utility>

#include "base/bytes.hpp"
#include "base/origin.hpp"
#include "base/text.hpp"
#include "base/unit_quaternion.hpp"
#include "host/c_activation.hpp"
#include "host/c_sensor.hpp"
#include "host/load/error_text.hpp"
#include "host/load/info_text.hpp"

namespace hallway::host {
namespace {

constexpr std::size_t kMaxLogBytes = 4000;
constexpr std::size_t kMaxCounterName = 64;
constexpr std::uint32_t kMaxSensors = 1000;
constexpr std::uint64_t kMaxCounters = 1000;

/// Throws a text.
void demand(bool condition, const char* text) {
  if (!condition) throw Error(ErrorCode::kIo, text);
}

std::string text_of(const char* text) {
  demand(text != nullptr, "a name that is null");
  return printable({text, strnlen(text, kMaxInfoTextBytes)}, kMaxInfoTextBytes);
}

SensorInfo sensor_of(const hw_sensor_info_t* info) {
  demand(info != nullptr, "a sensor that is null");
  demand(HW_HAS(info, hw_sensor_info_t, noise_m), "a sensor of a wrong size");
  const hw_pose_t& mount = info->T_body_sensor;
  demand(is_pose(mount.position, mount.orientation), "a sensor whose mount is no pose");
  SensorInfo sensor;
  sensor.name = text_of(info->name);
  copy_sensor_facts(*info, sensor);
  take_later_facts(*info, sensor);
  return sensor;
}

RobotInfo robot_of(const hw_robot_info_t* info) {
  demand(info != nullptr, "no robot");
  demand(HW_HAS(info, hw_robot_info_t, n_sensors), "a robot of a wrong size");
  demand(info->period_ns >= 0, "a period below 0");
  demand(info->n_sensors <= kMaxSensors, "more than 1000 sensors");
  demand(info->n_sensors == 0 || info->sensors != nullptr, "sensors that are null");
  RobotInfo robot{.name = text_of(info->name),
                  .period_ns = info->period_ns,
                  .lock_step = (info->flags & HW_ROBOT_LOCK_STEP) != 0,
                  .sensors = {}};
  if (HW_HAS(info, hw_robot_info_t, drive) && info->drive != nullptr) robot.drive = drive_of(*info->drive);
  if (HW_HAS(info, hw_robot_info_t, body) && info->body != nullptr) robot.body = body_of(*info->body);
  std::set<std::uint32_t> ids;
  for (std::uint32_t i = 0; i < info->n_sensors; ++i) {
    robot.sensors.push_back(sensor_of(info->sensors[i]));
    demand(ids.insert(robot.sensors.back().id).second, "two sensors of one id");
  }
  return robot;
}

/// Whether an open() that failed so was refused for what it was given.
bool is_refusal(hw_status_t status) {
  return status == HW_ERROR_ARGUMENT || status == HW_ERROR_RANGE || status == HW_ERROR_NOT_FOUND ||
         status == HW_ERROR_UNSUPPORTED || status == HW_ERROR_DATA;
}

}  // namespace

Driver::Driver(FoundDriver found, LogSink log) : found_(std::move(found)), log_(std::move(log)) {
  static constexpr hw_host_vtable_t kVtable{&Driver::put, &Driver::get_extension};
  host_.size = sizeof host_;
  host_.abi = {HW_ABI_MAJOR, HW_ABI_MINOR};
  host_.vtable = &kVtable;
  host_.self = this;
  host_.name = "hallway";
  host_.version = "0.1.0";
  driver_ = found_.library->create(info(), host_);
}

Driver::~Driver() {
  close();
  try {
    driver_.vtable->destroy(driver_.self);
  } catch (...) {  // it is gone, and there is nobody left to tell
  }
}

void Driver::fail(ErrorCode code, const char* name, const std::string& reason) const {
  throw Error(code, fmt::format("{}(): {}", name, reason),
              {file().string(), 0, fmt::format("driver `{}`", info().id)});
}

template <typename Call>
void Driver::call(const char* name, Call&& call) {
  hw_error_t error = empty_error();
  hw_status_t status = HW_OK;
  try {
    status = call(&error);
  } catch (...) {
    fail(ErrorCode::kIo, name, "let a C++ exception escape");
  }
  if (status == HW_OK) return;
  const bool refusal = std::string_view(name) == "open" && is_refusal(status);
  fail(refusal ? ErrorCode::kBadInput : ErrorCode::kIo, name, error_text(error, status));
}

void Driver::check_settings(std::span<const DriverSetting> settings) const {
  const std::vector<std::string> known = info().setting_keys();
  for (const DriverSetting& setting : settings) {
    if (std::ranges::find(known, setting.key) != known.end()) continue;
    std::string names;
    for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
    throw Error(
        wrong_value_at(setting.where),
        fmt::format("driver `{}` has no setting `{}`{}; it has: {}", info().id, printable(setting.key),
                    suggestion(setting.key, known), names.empty() ? "none" : names),
        setting.where);
  }
}

void Driver::open(std::span<const DriverSetting> settings, const std::filesystem::path& folder) {
  check_settings(settings);
  std::vector<hw_setting_t> pairs;
  for (const DriverSetting& setting : settings) pairs.push_back({setting.key.c_str(), setting.value.c_str()});
  const std::string folder_text = folder.string();
  hw_driver_settings_t given{};
  given.size = sizeof given;
  given.n_settings = static_cast<std::uint32_t>(pairs.size());
  given.settings = pairs.data();
  given.folder = folder_text.c_str();
  call("open", [&](hw_error_t* error) { return driver_.vtable->open(driver_.self, &given, error); });
  open_ = true;
}

RobotInfo Driver::describe() {
  const hw_robot_info_t* robot = nullptr;
  call("describe", [&](hw_error_t* error) { return driver_.vtable->describe(driver_.self, &robot, error); });
  try {
    return robot_of(robot);
  } catch (const Error& error) {
    fail(ErrorCode::kIo, "describe", "gave " + error.message());
  }
}

Driver::Reading Driver::read(std::chrono::nanoseconds wait) {
  std::uint32_t found = HW_READ_NOTHING;
  const hw_frame_t* frame = nullptr;
  call("read", [&](hw_error_t* error) {
    return driver_.vtable->read(driver_.self, wait.count(), &found, &frame, error);
  });
  if (found == HW_READ_NOTHING) return {};
  if (found == HW_READ_END) return {.found = Found::kEnd, .frame = nullptr};
  if (found != HW_READ_FRAME) fail(ErrorCode::kIo, "read", fmt::format("found {}, which is nothing", found));
  if (frame == nullptr) fail(ErrorCode::kIo, "read", "gave a frame that is null");
  return {.found = Found::kFrame, .frame = frame};
}

void Driver::write(const hw_answer_t& answer) {
  call("write", [&](hw_error_t* error) { return driver_.vtable->write(driver_.self, &answer, error); });
}

std::vector<Counter> Driver::counters() {
  const hw_counters_t* counters = driver_.vtable->counters(driver_.self);
  if (counters == nullptr || !HW_HAS(counters, hw_counters_t, counters)) return {};
  if (counters->stride < sizeof(hw_counter_t) || counters->stride % 8 != 0) return {};
  std::vector<Counter> copied;
  for (std::uint64_t i = 0; i < std::min(counters->count, kMaxCounters); ++i) {
    const auto counter =
        load<hw_counter_t>(static_cast<const char*>(counters->counters) + i * counters->stride);
    if (counter.name == nullptr || !std::isfinite(counter.value)) continue;
    copied.push_back({printable({counter.name, strnlen(counter.name, kMaxCounterName)}), counter.value});
  }
  return copied;
}

void Driver::close() {
  if (!std::exchange(open_, false)) return;
  try {
    driver_.vtable->close(driver_.self);
  } catch (...) {  // closed it is, and nothing that it gave is worth less for it
  }
}

hw_status_t Driver::put(void*, const hw_output_t*) {
  return HW_ERROR_UNSUPPORTED;
}

const void* Driver::get_extension(void*, const char* id) {
  static constexpr hw_log_t kLog{&Driver::write_log};
  return id != nullptr && std::strcmp(id, HW_EXT_LOG) == 0 ? &kLog : nullptr;
}

void Driver::write_log(void* self, std::uint32_t level, const char* message) {
  const auto& driver = *static_cast<const Driver*>(self);
  if (!driver.log_ || message == nullptr) return;
  try {
    driver.log_(driver.info().id, level, printable({message, strnlen(message, kMaxLogBytes)}, kMaxLogBytes));
  } catch (...) {  // out of memory: a message is lost, nothing else
  }
}

}  // namespace hallway::host
