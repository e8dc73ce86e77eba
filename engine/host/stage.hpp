// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "host/activation.hpp"
#include "host/load/plugin_info.hpp"
#include "host/output/outputs.hpp"
#include "host/parameter.hpp"

namespace hallway::host {

/// Receives what a plugin logs: its id, HW_LOG_…, and a text that is safe to print. May be called on any
/// thread, at any time while the plugin lives, and must not throw.
using LogSink =
    std::function<void(const std::string& plugin, std::uint32_t level, const std::string& message)>;

/// What one call took of the plugin alone.
struct CallTime {
  std::int64_t wall_ns = 0;  ///< steady clock
  std::int64_t cpu_ns = 0;   ///< CPU time of the calling thread
};

/// One instance of a plugin, wherever it runs: Plugin in this process, IsolatedPlugin in one of its own. Both give the same outputs and the
/// same errors.
///
/// Every function that calls into the plugin throws PluginFailure with the plugin's own reason, naming the file, the plugin and the call;
/// what the plugin put is checked before it is given to anybody (see OutputCollector). After a failure only close() and the destructor
/// may be used.
class Stage {
 public:
  Stage() = default;
  virtual ~Stage() = default;
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  virtual const PluginInfo& info() const = 0;
  virtual const std::filesystem::path& file() const = 0;

  /// What it declares, in its own order; empty without hw.params/1.
  virtual std::span<const Parameter> parameters() const = 0;
  /// The present value of parameter `index`, as text.
  virtual std::string parameter_text(std::size_t index) = 0;
  /// Whether the plugin has taken the present value of parameter `index` from a sensor's description; false without hw.params/2.
  virtual bool parameter_is_from_sensor(std::size_t index) = 0;
  /// Sets a parameter; only before activate(). Throws Error{wrong_value_at(where)} at `where`: unknown name (with a
  /// suggestion), not a value of its type, outside of its range, a path that text_parameter_value() refuses, or refused by the plugin.
  virtual void set_parameter(std::string_view name, std::string_view value, const Where& where = {}) = 0;

  /// Makes it ready for frames. Throws Error{kBadInput} with the plugin's reason where it does not accept its
  /// parameters or sensors (HW_ERROR_ARGUMENT, HW_ERROR_RANGE, HW_ERROR_UNSUPPORTED), else
  /// PluginFailure.
  virtual void activate(const Activation& facts) = 0;
  /// Forgets the map, as if newly activated.
  virtual void reset() = 0;

  /// How many frames may be submitted and not yet collected.
  virtual std::size_t capacity() const = 0;
  /// Hands over one frame: those of its samples whose kinds it takes (PluginInfo::takes()). Outputs know a sample by its
  /// index in `frame`, which lives until it is collected where capacity() is 1, else until this returns.
  /// @param bytes  the frame as FrameWriter writes it, or nothing: so that one that needs them does not write them again
  virtual void submit(const hw_frame_t& frame, std::span<const std::byte> bytes) = 0;
  void submit(const hw_frame_t& frame) { submit(frame, {}); }
  /// The answer to the oldest frame that was submitted and not yet collected.
  /// @return valid until the next call
  virtual const Outputs& collect() = 0;
  /// submit() and collect(), with nothing else under way.
  const Outputs& process(const hw_frame_t& frame) {
    submit(frame);
    return collect();
  }
  /// The map as it stands or, with `refine`, after what the plugin can still do about it; with no frame under way.
  /// @return valid until the next call
  virtual const Outputs& report(bool refine) = 0;
  /// The time of the last collect() or report().
  virtual const CallTime& last_call() const = 0;

  /// Ends the plugin in good order; what goes wrong in that is thrown here and nowhere else. The destructor does it where nobody did, and
  /// keeps quiet.
  virtual void close() = 0;
};

}  // namespace hallway::host
