// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/hallway.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "host/outputs.hpp"
#include "host/parameter.hpp"
#include "host/search.hpp"

namespace hallway::host {

/// Receives what a plugin logs: its id, HW_LOG_…, and a text that is safe to print. May be called on any
/// thread, at any time while the plugin lives, and must not throw.
using LogSink =
    std::function<void(const std::string& plugin, std::uint32_t level, const std::string& message)>;

/// What is known of one sensor; see hw_sensor_info_t. A number that is not known is NaN.
struct SensorInfo {
  std::uint32_t id = 0;                   ///< the number that its samples carry
  std::uint32_t kind = HW_SAMPLE_POINTS;  ///< HW_SAMPLE_… that it gives
  std::string name;                       ///< for people
  hw_pose_t T_body_sensor{{0, 0, 0}, {1, 0, 0, 0}};
  double horizontal_fov = kUnknown;  ///< full angle, radians
  double vertical_fov = kUnknown;    ///< full angle, radians
  double min_range_m = kUnknown;
  double max_range_m = kUnknown;
  double noise_m[3] = {kUnknown, kUnknown,
                       kUnknown};  ///< standard deviation along x, y, z of the sensor's frame

  static constexpr double kUnknown = __builtin_nan("");
};

/// What one call took of the plugin alone.
struct CallTime {
  std::int64_t wall_ns = 0;  ///< steady clock
  std::int64_t cpu_ns = 0;   ///< CPU time of the calling thread
};

/// One instance of a plugin, run in this process. Not copyable, not movable: the plugin holds its address.
///
/// Every function that calls into the plugin throws Error{kPluginFault} with the plugin's own reason, naming
/// the file, the plugin and the call; what the plugin put is checked before it is given to anybody (see
/// OutputCollector). After a fault only the destructor may be used.
class Plugin {
 public:
  /// Makes an instance with default parameters. Throws Error{kPluginLoad}.
  explicit Plugin(Found found, LogSink log = {});
  ~Plugin();
  Plugin(const Plugin&) = delete;
  Plugin& operator=(const Plugin&) = delete;

  const PluginInfo& info() const { return *found_.info; }
  const std::filesystem::path& file() const { return found_.library->file(); }

  /// What it declares, in its own order; empty without hw.params/1.
  std::span<const Parameter> parameters() const { return parameters_; }
  /// The present value of parameter `index`, as text.
  std::string parameter_text(std::size_t index);
  /// Sets a parameter; only before activate(). Throws Error{kBadInput} at `where`: unknown name (with a
  /// suggestion), not a value of its type, outside of its range, or refused by the plugin.
  void set_parameter(std::string_view name, std::string_view value, const Where& where = {});

  /// Makes it ready for frames. Throws Error{kBadInput} with the plugin's reason where it does not accept its
  /// parameters or sensors (HW_ERROR_ARGUMENT, HW_ERROR_RANGE, HW_ERROR_UNSUPPORTED), else
  /// Error{kPluginFault}.
  void activate(std::span<const SensorInfo> sensors);
  /// Forgets the map, as if newly activated.
  void reset();
  /// Feeds one frame: those of its samples whose kinds are among info().inputs. Outputs know a sample by its
  /// index in `frame`.
  /// @return valid until the next call
  const Outputs& process(const hw_frame_t& frame);
  /// The map as it stands or, with `refine`, after what the plugin can still do about it.
  /// @return valid until the next call
  const Outputs& report(bool refine);
  /// The time of the last process() or report().
  const CallTime& last_call() const { return last_call_; }

 private:
  static hw_status_t put(void* self, const hw_output_t* output);
  static const void* get_extension(void* self, const char* id);
  static void write_log(void* self, std::uint32_t level, const char* message);

  template <typename Call>
  hw_status_t guarded(const char* name, Call&& call);
  template <typename Call>
  const Outputs& timed(const char* name, Call&& call);
  void read_parameters();
  const hw_frame_t& select_samples(const hw_frame_t& frame);
  [[noreturn]] void fail(ErrorCode code, const char* call, const std::string& reason);
  void destroy() noexcept;

  Found found_;
  LogSink log_;
  hw_host_t host_{};
  hw_plugin_t plugin_{};
  const hw_params_t* params_ = nullptr;
  std::vector<Parameter> parameters_;
  bool active_ = false;
  bool faulted_ = false;
  OutputCollector collector_;
  CallTime last_call_;
  hw_error_t error_{};
  hw_frame_t selected_{};
  std::vector<const hw_sample_t*> selected_samples_;
  std::vector<std::uint32_t> selected_indices_;
};

}  // namespace hallway::host
