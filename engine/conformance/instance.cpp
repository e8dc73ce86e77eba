// SPDX-License-Identifier: MIT
#include "conformance/instance.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <numeric>

#include "base/error.hpp"
#include "base/text.hpp"
#include "conformance/call_mark.hpp"
#include "conformance/walk.hpp"
#include "host/load/error_text.hpp"
#include "host/text_parameter.hpp"

namespace hallway::conformance {

std::string Ended::text() const {
  return call + "() failed: " + host::error_text(error, status);
}

void Ended::demand_good() const {
  demand(good(), text());
}

void Ended::demand_reason() const {
  demand(good() || error.message[0] != '\0',
         call + "() failed with " + hw_status_name(status) + " and gave no reason");
}

const Collected& Answer::demand_valid() const {
  demand_good();
  demand(put.problem.empty(), call + "() put a wrong output: " + put.problem);
  return put;
}

void Answer::demand_survived() const {
  demand_reason();
  if (good()) demand_valid();
}

Instance::Instance(const LoadedLibrary& library, const Subject& subject, const HostShape& shape)
    : host_(shape) {
  const hw_plugin_info_t& info = library.info(subject.plugin);
  walk_ = Walk(info, subject.seed);
  ended("create", [&](hw_error_t* error) {
    return library.factory().create(&host_.host(), info.id, &plugin_, error);
  }).demand_good();
  demand(plugin_.vtable != nullptr, "create() left the vtable null");
  apply_settings(subject);
}

Instance::Instance(const Subject& subject, const HostShape& shape)
    : Instance(std::make_unique<const LoadedLibrary>(subject.file), subject, shape) {}

Instance::Instance(std::unique_ptr<const LoadedLibrary> library, const Subject& subject,
                   const HostShape& shape)
    : Instance(*library, subject, shape) {
  own_library_ = std::move(library);
}

Instance::~Instance() {
  try {
    close();
  } catch (...) {  // a test that was to notice has called close() itself
  }
}

Ended Instance::apply_setting(const hw_params_t& params, std::uint32_t index,
                              const host::Parameter& parameter, const std::string& value) {
  if (!parameter.is_text()) {
    const hw_param_value_t parsed = parameter.parse(value);
    return ended("set", [&](hw_error_t* error) { return params.set(plugin_.self, index, &parsed, error); });
  }
  const hw_params_2_t* texts = parameters_2();
  demand(texts != nullptr, "declares a text parameter without " HW_EXT_PARAMS_2);
  const std::string text = host::text_parameter_value(parameter, value, {});
  return ended("set_text",
               [&](hw_error_t* error) { return texts->set_text(plugin_.self, index, text.c_str(), error); });
}

void Instance::apply_settings(const Subject& subject) {
  if (subject.settings.empty()) return;
  const hw_params_t* params = parameters();
  for (const auto& [name, value] : subject.settings) {
    const std::uint32_t count = params ? marked("count", [&] { return params->count(plugin_.self); }) : 0;
    bool found = false;
    for (std::uint32_t i = 0; i < count && !found; ++i) {
      const hw_param_info_t* info = marked("describe", [&] { return params->describe(plugin_.self, i); });
      if (info == nullptr || info->name == nullptr || name != info->name) continue;
      found = true;
      const Ended ended = apply_setting(*params, i, host::read_parameter(info), value);
      if (!ended.good())
        throw Error(ErrorCode::kBadInput, "parameter `" + printable(name) + "`: " + ended.text());
    }
    if (!found) throw Error(ErrorCode::kBadInput, "the plugin has no parameter `" + printable(name) + "`");
  }
}

const hw_params_t* Instance::parameters() {
  const auto* params = static_cast<const hw_params_t*>(
      marked("get_extension", [&] { return plugin_.vtable->get_extension(plugin_.self, HW_EXT_PARAMS); }));
  demand(!params || (params->count && params->describe && params->get && params->set),
         "has null functions in " HW_EXT_PARAMS);
  return params;
}

const hw_params_2_t* Instance::parameters_2() {
  const auto* params = static_cast<const hw_params_2_t*>(
      marked("get_extension", [&] { return plugin_.vtable->get_extension(plugin_.self, HW_EXT_PARAMS_2); }));
  demand(!params || (params->get_text && params->set_text && params->origin),
         "has null functions in " HW_EXT_PARAMS_2);
  return params;
}

Ended Instance::activate(const std::vector<hw_sensor_info_t>& sensors, const InputShape& shape,
                         const RobotFacts& robot) {
  const hw_activation_t& activation = activation_.put_activation(sensors, shape, robot);
  const Ended activated = ended("activate", [&](hw_error_t* error) {
    return plugin_.vtable->activate(plugin_.self, &activation, error);
  });
  active_ = activated.good();
  return activated;
}

void Instance::activate() {
  const Ended ended = activate(walk_.sensors());
  demand(ended.good(), "a sensor of " + walk_.kinds() + " with all facts known was refused: " + ended.text());
}

void Instance::deactivate() {
  active_ = false;
  marked("deactivate", [&] { plugin_.vtable->deactivate(plugin_.self); });
}

Ended Instance::reset() {
  return ended("reset", [&](hw_error_t* error) { return plugin_.vtable->reset(plugin_.self, error); });
}

template <typename Call>
Answer Instance::answer(const char* name, const hw_frame_t* frame, std::vector<std::uint32_t> indices,
                        Call&& call) {
  host_.begin(frame, std::move(indices));
  Answer given{ended(name, call)};
  given.put = host_.finish();
  return given;
}

Answer Instance::process(const hw_frame_t& frame, std::vector<std::uint32_t> indices) {
  return answer("process", &frame, std::move(indices),
                [&](hw_error_t* error) { return plugin_.vtable->process(plugin_.self, &frame, error); });
}

Answer Instance::process(const Frame& frame, const InputShape& shape) {
  InputMemory memory;
  return process(memory.put_frame(frame, shape));
}

Answer Instance::process(const hw_frame_t& frame) {
  std::vector<std::uint32_t> indices(frame.n_samples);
  std::iota(indices.begin(), indices.end(), 0u);
  return process(frame, std::move(indices));
}

Answer Instance::report(std::uint32_t flags, std::uint32_t growth) {
  const Block block(sizeof(hw_report_request_t) + growth, false);
  auto& request = *static_cast<hw_report_request_t*>(block.data());
  request.size = static_cast<std::uint32_t>(sizeof request) + growth;
  request.flags = flags;
  return answer("report", nullptr, {},
                [&](hw_error_t* error) { return plugin_.vtable->report(plugin_.self, &request, error); });
}

void Instance::close() {
  if (plugin_.vtable == nullptr) return;
  const hw_plugin_t plugin = std::exchange(plugin_, {});
  if (std::exchange(active_, false)) marked("deactivate", [&] { plugin.vtable->deactivate(plugin.self); });
  marked("destroy", [&] { plugin.vtable->destroy(plugin.self); });
}

std::string Instance::walk(std::uint64_t begin, std::uint64_t end) {
  std::string bytes;
  for (std::uint64_t k = begin; k < end; ++k) bytes += step(k).bytes();
  return bytes + report(0).bytes();
}

void demand_same(const std::string& a, const std::string& b, const std::string& what) {
  if (a == b) return;
  const auto differs = std::mismatch(
      a.begin(), a.begin() + static_cast<std::ptrdiff_t>(std::min(a.size(), b.size())), b.begin());
  throw Failed(what + " (byte " + std::to_string(differs.first - a.begin()) + " of what was put differs)");
}

}  // namespace hallway::conformance
