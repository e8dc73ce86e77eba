// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/hallway.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/isolate/verdict.hpp"
#include "host/load/search.hpp"
#include "host/samples/sample_selection.hpp"
#include "host/stage.hpp"

namespace hallway::host {

/// One instance of a plugin, run in this process. Not copyable, not movable: the plugin holds its address.
class Plugin final : public Stage {
 public:
  /// Makes an instance with default parameters. Throws Error{kPluginLoad}.
  explicit Plugin(Found found, LogSink log = {});
  ~Plugin() override;

  const PluginInfo& info() const override { return *found_.info; }
  const std::filesystem::path& file() const override { return found_.library->file(); }
  std::span<const Parameter> parameters() const override { return parameters_; }
  std::string parameter_text(std::size_t index) override;
  bool parameter_is_from_sensor(std::size_t index) override;
  void set_parameter(std::string_view name, std::string_view value, const Where& where = {}) override;
  void activate(const Activation& facts) override;
  void reset() override;
  std::size_t capacity() const override { return 1; }
  using Stage::submit;
  void submit(const hw_frame_t& frame, std::span<const std::byte>) override { submitted_ = &frame; }
  const Outputs& collect() override;
  const Outputs& report(bool refine) override;
  const CallTime& last_call() const override { return last_call_; }
  void close() override;

 private:
  static hw_status_t put(void* self, const hw_output_t* output);
  static const void* get_extension(void* self, const char* id);
  static void write_log(void* self, std::uint32_t level, const char* message);

  template <typename Call>
  hw_status_t guarded(const char* name, Call&& call);
  template <typename Call>
  const Outputs& timed(const char* name, Call&& call);
  void read_parameters();
  void read_parameter_functions();
  hw_status_t set_value(std::uint32_t index, std::string_view value, const Where& where);
  [[noreturn]] void fail(ErrorCode code, const char* call, const std::string& reason);

  Found found_;
  LogSink log_;
  hw_host_t host_{};
  hw_plugin_t plugin_{};
  const hw_params_t* params_ = nullptr;
  const hw_params_2_t* params_2_ = nullptr;
  std::vector<Parameter> parameters_;
  const hw_frame_t* submitted_ = nullptr;
  bool active_ = false;
  bool closed_ = false;
  bool faulted_ = false;
  OutputCollector collector_;
  CallTime last_call_;
  hw_error_t error_{};
  SampleSelection selection_;
  std::vector<std::uint32_t> taken_kinds_;
};

}  // namespace hallway::host
