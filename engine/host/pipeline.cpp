// SPDX-License-Identifier: MIT
#include "host/pipeline.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace hallway::host {
namespace {

/// Sensors are the only producers: no kind of output is a kind of sample.
void check_producers(const Plugin& plugin, std::span<const SensorInfo> sensors) {
  std::set<std::uint32_t> produced;
  for (const SensorInfo& sensor : sensors) produced.insert(sensor.kind);
  for (const std::uint32_t kind : plugin.info().inputs) {
    if (produced.contains(kind)) continue;
    std::vector<std::string> names;
    for (const std::uint32_t there : produced) names.push_back(sample_kind_name(there));
    throw Error(ErrorCode::kBadInput,
                fmt::format("plugin `{}` needs {}, which no sensor gives; the sensors give: {}",
                            plugin.info().id, sample_kind_name(kind),
                            names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "))));
  }
}

}  // namespace

Pipeline::Pipeline(std::span<const StageSpec> stages, std::span<const std::filesystem::path> folders,
                   std::span<const SensorInfo> sensors, const LogSink& log) {
  if (stages.empty()) throw Error(ErrorCode::kBadInput, "the pipeline has no plugin");
  for (const StageSpec& spec : stages) {
    Plugin& plugin = *stages_.emplace_back(std::make_unique<Plugin>(find_plugin(spec.plugin, folders), log));
    for (const ParameterSetting& setting : spec.parameters) {
      plugin.set_parameter(setting.name, setting.value, setting.where);
    }
    check_producers(plugin, sensors);
  }
  for (const auto& plugin : stages_) plugin->activate(sensors);
}

const Outputs& Pipeline::process(const hw_frame_t& frame) {
  last_call_ = {};
  const Outputs* outputs = nullptr;
  for (const auto& plugin : stages_) {
    outputs = &plugin->process(frame);
    last_call_.wall_ns += plugin->last_call().wall_ns;
    last_call_.cpu_ns += plugin->last_call().cpu_ns;
  }
  return *outputs;
}

const Outputs& Pipeline::report(bool refine) {
  const Outputs& outputs = stages_.back()->report(refine);
  last_call_ = stages_.back()->last_call();
  return outputs;
}

void Pipeline::reset() {
  for (const auto& plugin : stages_) plugin->reset();
}

}  // namespace hallway::host
