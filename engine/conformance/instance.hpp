// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/hallway.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "conformance/call_mark.hpp"
#include "conformance/input_memory.hpp"
#include "conformance/loaded_library.hpp"
#include "conformance/test.hpp"
#include "conformance/test_host.hpp"
#include "conformance/walk.hpp"
#include "host/load/error_text.hpp"
#include "host/parameter.hpp"

namespace hallway::conformance {

/// How a call ended.
struct Ended {
  std::string call{};  ///< the function's name
  hw_status_t status = HW_OK;
  hw_error_t error{};

  bool good() const { return status == HW_OK; }
  /// "process() failed: no room (HW_ERROR_MEMORY)".
  std::string text() const;
  /// Throws Failed unless it ended well.
  void demand_good() const;
  /// Throws Failed where it failed without a reason.
  void demand_reason() const;
};

/// Calls a function of the plugin with an hw_error_t of its own.
template <typename Call>
Ended ended_by(const char* name, Call&& call) {
  Ended ended{.call = name, .error = host::empty_error()};
  ended.status = marked(name, [&] { return call(&ended.error); });
  return ended;
}

/// How process() or report() ended, and what it put.
struct Answer : Ended {
  Collected put{};

  /// Throws Failed unless it ended well and put nothing wrong. @return what was put
  const Collected& demand_valid() const;
  /// Bytes of what was put. Throws Failed unless it ended well.
  const std::string& bytes() const {
    demand_good();
    return put.bytes;
  }
  /// Throws Failed if it failed without a reason, or ended well and put something wrong.
  void demand_survived() const;
};

/// One instance of the plugin with the settings of the subject. Every function is called as the host calls it.
class Instance {
 public:
  /// Makes one. Throws Failed.
  Instance(const LoadedLibrary& library, const Subject& subject, const HostShape& shape = {});
  /// The same with the library that it is in.
  explicit Instance(const Subject& subject, const HostShape& shape = {});
  /// close(), if nobody has.
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  const hw_plugin_t& raw() const { return plugin_; }
  const TestHost& host() const { return host_; }
  /// From now on calls get null instead of an hw_error_t.
  void give_no_errors() { gives_errors_ = false; }
  /// Its parameters, or null. Throws Failed if one of its functions is null.
  const hw_params_t* parameters();
  /// The same of hw_params_2_t.
  const hw_params_2_t* parameters_2();

  /// Its ordinary sensors and frames.
  const Walk& ordinary() const { return walk_; }
  /// For a robot that is the ordinary one, where nothing else is said.
  Ended activate(const std::vector<hw_sensor_info_t>& sensors, const InputShape& shape = {},
                 const RobotFacts& robot = ordinary_robot());
  /// With the ordinary sensors. Throws Failed where they are refused, and what Walk::sensors() throws.
  void activate();
  void deactivate();
  /// Takes the activation's memory away.
  void poison_activation() const { activation_.protect(0); }
  Ended reset();
  /// Throws Failed where it fails.
  void must_reset() { reset().demand_good(); }
  Answer process(const Frame& frame, const InputShape& shape = {});
  /// With frame `step` of the ordinary walk.
  Answer step(std::uint64_t step) { return process(walk_.frame(step)); }
  /// Bytes of everything that was put from frame `begin` to before `end` of the ordinary walk, with a report at the end. Throws Failed where a
  /// call fails.
  std::string walk(std::uint64_t begin, std::uint64_t end);
  /// In memory that the caller has; `indices` says how the samples count in what is put.
  Answer process(const hw_frame_t& frame, std::vector<std::uint32_t> indices);
  /// The same; samples count as they stand.
  Answer process(const hw_frame_t& frame);
  Answer report(std::uint32_t flags, std::uint32_t growth = 0);
  /// Deactivates it, if it is active, and destroys it.
  void close();

 private:
  Instance(std::unique_ptr<const LoadedLibrary> library, const Subject& subject, const HostShape& shape);
  void apply_settings(const Subject& subject);
  Ended apply_setting(const hw_params_t& params, std::uint32_t index, const host::Parameter& parameter,
                      const std::string& value);
  /// ended_by(), but for give_no_errors().
  template <typename Call>
  Ended ended(const char* name, Call&& call) const {
    return ended_by(name, [&](hw_error_t* error) { return call(gives_errors_ ? error : nullptr); });
  }
  /// A call with outputs.
  template <typename Call>
  Answer answer(const char* name, const hw_frame_t* frame, std::vector<std::uint32_t> indices, Call&& call);

  std::unique_ptr<const LoadedLibrary> own_library_;
  Walk walk_;
  TestHost host_;
  hw_plugin_t plugin_{};
  InputMemory activation_;
  bool active_ = false;
  bool gives_errors_ = true;
};

/// An instance that is active, with the ordinary sensors.
struct Active : Instance {
  explicit Active(const Subject& subject, const HostShape& shape = {}) : Instance(subject, shape) {
    activate();
  }
  Active(const LoadedLibrary& library, const Subject& subject, const HostShape& shape = {})
      : Instance(library, subject, shape) {
    activate();
  }
};

/// Throws Failed with `what` unless both are the same.
void demand_same(const std::string& a, const std::string& b, const std::string& what);

}  // namespace hallway::conformance
