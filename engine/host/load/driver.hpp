// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/driver.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/load/search.hpp"
#include "host/stage.hpp"

namespace hallway::host {

/// A value for a driver's setting, and where it was said.
struct DriverSetting {
  std::string key;
  std::string value;
  Where where;
};

/// What a driver says of the robot behind it, checked and copied.
struct RobotInfo {
  std::string name;            ///< safe to print
  std::int64_t period_ns = 0;  ///< from frame to frame; 0 where it is not regular
  bool lock_step = false;      ///< time is the driver's own: every frame is answered before the next is read
  std::vector<SensorInfo> sensors{};
  std::optional<DriveInfo> drive{};  ///< unset: not known
  std::optional<BodyInfo> body{};    ///< unset: not known
};

/// One instance of a driver, run in this process. Not copyable, not movable: the driver holds its address. All functions but
/// write() are called on one thread; write() may be called on any, one call at a time.
///
/// What a driver says of a failure is thrown as Error naming the file, the driver and the call: kIo, and of open() kBadInput where it does not
/// accept what it was given.
class Driver {
 public:
  /// Makes an instance, closed. Throws Error{kPluginLoad}.
  explicit Driver(FoundDriver found, LogSink log = {});
  ~Driver();
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;

  const DriverInfo& info() const { return *found_.info; }
  const std::filesystem::path& file() const { return found_.library->file(); }

  /// Throws Error{wrong_value_at(its place)} where a key is none of info().settings, with a suggestion.
  void check_settings(std::span<const DriverSetting> settings) const;
  /// Opens the robot.
  /// @param folder  that relative file names in settings are relative to
  void open(std::span<const DriverSetting> settings, const std::filesystem::path& folder);
  /// What robot it is; only while open.
  RobotInfo describe();

  enum class Found { kNothing, kFrame, kEnd };
  struct Reading {
    Found found = Found::kNothing;
    const hw_frame_t* frame = nullptr;  ///< of kFrame; lives until the next read() or close()
  };
  /// Waits for a frame, `wait` at most.
  Reading read(std::chrono::nanoseconds wait);
  void write(const hw_answer_t& answer);
  /// Numbers worth watching, in the driver's words; what is not as output.h says is left out.
  std::vector<Counter> counters();
  void close();

 private:
  template <typename Call>
  void call(const char* name, Call&& call);
  [[noreturn]] void fail(ErrorCode code, const char* name, const std::string& reason) const;

  static hw_status_t put(void* self, const hw_output_t* output);
  static const void* get_extension(void* self, const char* id);
  static void write_log(void* self, std::uint32_t level, const char* message);

  FoundDriver found_;
  LogSink log_;
  hw_host_t host_{};
  hw_driver_t driver_{};
  bool open_ = false;
};

}  // namespace hallway::host
