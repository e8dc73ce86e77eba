// SPDX-License-Identifier: MIT
#include "host/plugin.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <utility>

#include "base/origin.hpp"
#include "base/text.hpp"
#include "host/c_activation.hpp"
#include "host/load/error_text.hpp"
#include "host/load/load_step.hpp"
#include "host/text_parameter.hpp"

namespace hallway::host {
namespace {

constexpr std::uint32_t kMaxParameters = 10000;
constexpr std::size_t kMaxLogBytes = 4000;

/// What a plugin is told of the host. The same in every program, so that nothing can depend on it.
constexpr const char* kHostName = "hallway";
constexpr const char* kHostVersion = "0.1.0";

std::int64_t thread_cpu_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
}

/// Whether an activation that failed so was refused for what it was given, not for a fault of the plugin.
bool is_refusal(hw_status_t status) {
  return status == HW_ERROR_ARGUMENT || status == HW_ERROR_RANGE || status == HW_ERROR_UNSUPPORTED;
}

}  // namespace

Plugin::Plugin(Found found, LogSink log) : found_(std::move(found)), log_(std::move(log)) {
  static constexpr hw_host_vtable_t kVtable{&Plugin::put, &Plugin::get_extension};
  host_.size = sizeof host_;
  host_.abi = {HW_ABI_MAJOR, HW_ABI_MINOR};
  host_.vtable = &kVtable;
  host_.self = this;
  host_.name = kHostName;
  host_.version = kHostVersion;
  plugin_ = found_.library->create(info(), host_);
  taken_kinds_ = info().inputs;
  taken_kinds_.insert(taken_kinds_.end(), info().optional_inputs.begin(), info().optional_inputs.end());
  try {
    read_parameters();
  } catch (...) {
    close();
    throw;
  }
}

Plugin::~Plugin() {
  close();
}

void Plugin::close() {
  if (closed_) return;
  closed_ = true;
  try {
    if (active_) plugin_.vtable->deactivate(plugin_.self);
    plugin_.vtable->destroy(plugin_.self);
  } catch (...) {  // it is gone, and nothing that it gave is worth less for it
  }
}

void Plugin::fail(ErrorCode code, const char* call, const std::string& reason) {
  faulted_ = true;
  const std::string message = fmt::format("{}(): {}", call, reason);
  throw PluginFailure(code, message, {file().string(), 0, fmt::format("plugin `{}`", info().id)},
                      {.what = Misdeed::kFault, .call = call, .plugin = info().id, .message = message});
}

template <typename Call>
hw_status_t Plugin::guarded(const char* name, Call&& call) {
  if (closed_) throw Error(ErrorCode::kInternal, fmt::format("{}() after close()", name));
  if (faulted_) fail(ErrorCode::kPluginFault, name, "is not called, the plugin has failed before");
  error_.size = sizeof error_;
  error_.status = HW_OK;
  error_.message[0] = '\0';
  try {
    return call();
  } catch (const std::exception& exception) {
    fail(ErrorCode::kPluginFault, name, "let a C++ exception escape: " + printable(exception.what()));
  } catch (...) {
    fail(ErrorCode::kPluginFault, name, "let a C++ exception escape");
  }
}

template <typename Call>
const Outputs& Plugin::timed(const char* name, Call&& call) {
  using Clock = std::chrono::steady_clock;
  if (!active_) throw Error(ErrorCode::kInternal, fmt::format("{}() before activate()", name));
  const std::int64_t cpu_begin = thread_cpu_ns();
  const Clock::time_point begin = Clock::now();
  const hw_status_t status = guarded(name, call);
  const Clock::time_point end = Clock::now();
  last_call_.cpu_ns = thread_cpu_ns() - cpu_begin;
  last_call_.wall_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(end - begin).count();
  // A wrong output comes first: it is the cause of the failure that the plugin makes of it.
  const std::string problem = collector_.finish();
  if (!problem.empty()) fail(ErrorCode::kPluginFault, name, "put a wrong output: " + problem);
  if (status != HW_OK) fail(ErrorCode::kPluginFault, name, error_text(error_, status));
  return collector_.outputs();
}

void Plugin::read_parameter_functions() {
  const auto& vtable = *plugin_.vtable;
  params_ = static_cast<const hw_params_t*>(vtable.get_extension(plugin_.self, HW_EXT_PARAMS));
  if (params_ == nullptr) return;
  if (!params_->count || !params_->describe || !params_->get || !params_->set)
    throw Error(ErrorCode::kPluginLoad, "has null functions in " HW_EXT_PARAMS);
  params_2_ = static_cast<const hw_params_2_t*>(vtable.get_extension(plugin_.self, HW_EXT_PARAMS_2));
  if (params_2_ && (!params_2_->get_text || !params_2_->set_text || !params_2_->origin))
    throw Error(ErrorCode::kPluginLoad, "has null functions in " HW_EXT_PARAMS_2);
}

void Plugin::read_parameters() {
  const Where where{file().string(), 0, fmt::format("plugin `{}`", info().id)};
  enter(LoadStep::kParameters);
  try {
    read_parameter_functions();
    if (params_ == nullptr) return;
    const std::uint32_t count = params_->count(plugin_.self);
    if (count > kMaxParameters) {
      throw Error(ErrorCode::kPluginLoad, fmt::format("declares {} parameters", count));
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      Parameter parameter = read_parameter(params_->describe(plugin_.self, i));
      for (const Parameter& other : parameters_) {
        if (other.name != parameter.name) continue;
        throw Error(ErrorCode::kPluginLoad, fmt::format("declares the parameter `{}` twice", parameter.name));
      }
      if (parameter.is_text() && params_2_ == nullptr) {
        throw Error(ErrorCode::kPluginLoad, fmt::format("declares the text parameter `{}` without {}",
                                                        parameter.name, HW_EXT_PARAMS_2));
      }
      parameters_.push_back(std::move(parameter));
    }
  } catch (const Error& error) {
    const std::string parameter = error.where().element.empty() ? "" : error.where().element + ": ";
    throw Error(error.code(), parameter + error.message(), where);
  } catch (...) {
    throw Error(ErrorCode::kPluginLoad, "let a C++ exception escape while it declared its parameters", where);
  }
}

bool Plugin::parameter_is_from_sensor(std::size_t index) {
  if (params_2_ == nullptr) return false;
  std::uint32_t origin = HW_PARAM_FROM_DEFAULT;
  guarded("origin", [&] {
    origin = params_2_->origin(plugin_.self, static_cast<std::uint32_t>(index));
    return HW_OK;
  });
  return origin == HW_PARAM_FROM_SENSOR;
}

std::string Plugin::parameter_text(std::size_t index) {
  if (parameters_.at(index).is_text()) {
    const char* text = nullptr;
    const hw_status_t got = guarded("get_text", [&] {
      return params_2_->get_text(plugin_.self, static_cast<std::uint32_t>(index), &text, &error_);
    });
    if (got != HW_OK) fail(ErrorCode::kPluginFault, "get_text", error_text(error_, got));
    if (text == nullptr) fail(ErrorCode::kPluginFault, "get_text", "gave null");
    return printable({text, strnlen(text, HW_PARAM_TEXT_BYTES)}, HW_PARAM_TEXT_BYTES);
  }
  hw_param_value_t value{};
  const hw_status_t status = guarded(
      "get", [&] { return params_->get(plugin_.self, static_cast<std::uint32_t>(index), &value, &error_); });
  if (status != HW_OK) fail(ErrorCode::kPluginFault, "get", error_text(error_, status));
  return parameters_.at(index).print(value);
}

hw_status_t Plugin::set_value(std::uint32_t index, std::string_view value, const Where& where) {
  const Parameter& parameter = parameters_[index];
  if (parameter.is_text()) {
    const std::string text = text_parameter_value(parameter, value, where);
    return guarded("set_text",
                   [&] { return params_2_->set_text(plugin_.self, index, text.c_str(), &error_); });
  }
  const hw_param_value_t parsed = parameter.parse(value);
  return guarded("set", [&] { return params_->set(plugin_.self, index, &parsed, &error_); });
}

void Plugin::set_parameter(std::string_view name, std::string_view value, const Where& where) {
  if (active_) throw Error(ErrorCode::kInternal, "set_parameter() after activate()");
  const auto found = std::ranges::find_if(parameters_, [&](const Parameter& p) { return p.name == name; });
  if (found == parameters_.end()) {
    std::vector<std::string> names;
    for (const Parameter& parameter : parameters_) names.push_back(parameter.name);
    throw Error(wrong_value_at(where),
                fmt::format("plugin `{}` has no parameter `{}`{}; it has: {}", info().id, printable(name),
                            suggestion(name, names),
                            names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))),
                where);
  }
  try {
    const auto index = static_cast<std::uint32_t>(found - parameters_.begin());
    const hw_status_t status = set_value(index, value, where);
    if (status != HW_OK) {
      throw Error(ErrorCode::kBadInput,
                  fmt::format("parameter `{}`: {}", found->name, error_text(error_, status)));
    }
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kBadInput && error.code() != ErrorCode::kIo) throw;
    throw Error(error.code() == ErrorCode::kIo ? ErrorCode::kIo : wrong_value_at(where),
                fmt::format("plugin `{}`: {}", info().id, error.message()), where);
  }
}

void Plugin::activate(const Activation& facts) {
  const CActivation activation(facts);
  const hw_status_t status =
      guarded("activate", [&] { return plugin_.vtable->activate(plugin_.self, &activation.get(), &error_); });
  if (status != HW_OK) {
    fail(is_refusal(status) ? ErrorCode::kBadInput : ErrorCode::kPluginFault, "activate",
         error_text(error_, status));
  }
  active_ = true;
}

void Plugin::reset() {
  const hw_status_t status = guarded("reset", [&] { return plugin_.vtable->reset(plugin_.self, &error_); });
  if (status != HW_OK) fail(ErrorCode::kPluginFault, "reset", error_text(error_, status));
}

const Outputs& Plugin::collect() {
  if (submitted_ == nullptr) throw Error(ErrorCode::kInternal, "collect() without a frame");
  const hw_frame_t& selected = selection_.select(*std::exchange(submitted_, nullptr), taken_kinds_);
  collector_.begin(&selected, selection_.indices());
  return timed("process", [&] { return plugin_.vtable->process(plugin_.self, &selected, &error_); });
}

const Outputs& Plugin::report(bool refine) {
  hw_report_request_t request{};
  request.size = sizeof request;
  request.flags = refine ? HW_REPORT_REFINE : 0;
  collector_.begin(nullptr, {});
  return timed("report", [&] { return plugin_.vtable->report(plugin_.self, &request, &error_); });
}

hw_status_t Plugin::put(void* self, const hw_output_t* output) {
  return static_cast<Plugin*>(self)->collector_.put(output);
}

const void* Plugin::get_extension(void*, const char* id) {
  static constexpr hw_log_t kLog{&Plugin::write_log};
  return id != nullptr && std::strcmp(id, HW_EXT_LOG) == 0 ? &kLog : nullptr;
}

void Plugin::write_log(void* self, std::uint32_t level, const char* message) {
  const auto& plugin = *static_cast<const Plugin*>(self);
  if (!plugin.log_ || message == nullptr) return;
  try {
    plugin.log_(plugin.info().id, level, printable({message, strnlen(message, kMaxLogBytes)}, kMaxLogBytes));
  } catch (...) {  // out of memory: a message is lost, nothing else
  }
}

}  // namespace hallway::host
