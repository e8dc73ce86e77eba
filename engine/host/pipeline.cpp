// SPDX-License-Identifier: MIT
#include "host/pipeline.hpp"

#include <algorithm>
#include <set>
#include <span>
#include <utility>

#include "base/text.hpp"
#include "host/isolate/isolated_plugin.hpp"
#include "host/output/output_kind.hpp"
#include "host/pipeline_kinds.hpp"
#include "host/plugin.hpp"

namespace hallway::host {
namespace {

bool is_kept_out(const ParameterSetting& setting, std::span<const Parameter> parameters) {
  const auto found = std::ranges::find(parameters, setting.name, &Parameter::name);
  return !setting.may_name_path && found != parameters.end() && found->is_path();
}

}  // namespace

Pipeline::Pipeline(std::vector<StageSpec> stages, std::vector<std::filesystem::path> folders,
                   Activation activation, LogSink log, std::optional<Isolation> isolation)
    : Pipeline(unstarted(std::move(stages), std::move(folders), std::move(activation), std::move(log),
                         std::move(isolation))) {
  start();
}

Pipeline Pipeline::unstarted(std::vector<StageSpec> stages, std::vector<std::filesystem::path> folders,
                             Activation activation, LogSink log, std::optional<Isolation> isolation) {
  Pipeline pipeline;
  pipeline.specs_ = std::move(stages);
  pipeline.folders_ = std::move(folders);
  pipeline.activation_ = std::move(activation);
  pipeline.log_ = std::move(log);
  pipeline.isolation_ = std::move(isolation);
  return pipeline;
}

std::unique_ptr<Stage> Pipeline::make_stage(const std::string& plugin) {
  if (!isolation_) return std::make_unique<Plugin>(find_plugin(plugin, folders_), log_);
  auto stage = std::make_unique<IsolatedPlugin>(plugin, folders_, *isolation_, log_);
  if (log_ && !std::exchange(warned_, true)) {
    for (const std::string& missing : stage->missing()) {
      log_(stage->info().id, HW_LOG_WARNING, "its isolation is not complete: " + missing);
    }
  }
  return stage;
}

void Pipeline::start() {
  facts_.clear();
  try {
    prepare_stages();
    check_kinds();
    activate_stages();
  } catch (...) {
    stages_.clear();
    throw;
  }
  in_turn_ = takes_what_others_find();
  submitted_ = nullptr;
  with_planes_ = nullptr;
  started_ = true;
}

void Pipeline::prepare_stages() {
  for (const StageSpec& spec : specs_) {
    Stage& plugin = *stages_.emplace_back(make_stage(spec.plugin));
    const auto parameters = plugin.parameters();
    facts_.push_back({plugin.info(), plugin.file(), {parameters.begin(), parameters.end()}, {}, {}});
    for (const ParameterSetting& setting : spec.parameters) {
      // Asked for each time: setting a value may start an isolated plugin anew, with a new list.
      if (is_kept_out(setting, plugin.parameters())) {
        if (log_)
          log_(plugin.info().id, HW_LOG_WARNING,
               "the value of `" + printable(setting.name) + "`, a file or folder, is not taken from a log");
      } else {
        plugin.set_parameter(setting.name, setting.value, setting.where);
      }
    }
    note_values(stages_.size() - 1);
  }
}

void Pipeline::activate_stages() {
  for (std::size_t i = 0; i < stages_.size(); ++i) {
    stages_[i]->activate(activation_);
    note_values(i);  // what it has taken from the sensors
  }
}

void Pipeline::note_values(std::size_t stage) {
  StageFacts& facts = facts_[stage];
  std::vector<std::string> values;
  facts.from_sensor.clear();
  for (std::size_t i = 0; i < facts.parameters.size(); ++i) {
    values.push_back(stages_[stage]->parameter_text(i));
    facts.from_sensor.push_back(stages_[stage]->parameter_is_from_sensor(i));
    if (!facts.parameters[i].is_path()) continue;
    for (const ParameterSetting& setting : specs_[stage].parameters) {
      if (setting.name == facts.parameters[i].name && setting.may_name_path) values.back() = setting.value;
    }
  }
  facts.values = std::move(values);
}

void Pipeline::check_kinds() const {
  std::vector<PluginInfo> plugins;
  for (const StageFacts& plugin : facts_) plugins.push_back(plugin.info);
  host::check_kinds(plugins, activation_.sensors);
}

/// Whether a plugin takes samples of a kind that one before it gives.
bool Pipeline::takes_what_others_find() const {
  std::set<std::uint32_t> given;
  for (const StageFacts& plugin : facts_) {
    if (std::ranges::any_of(given, [&](std::uint32_t kind) { return plugin.info.takes(kind); })) return true;
    for (const std::uint32_t output : plugin.info.outputs) {
      if (const auto kind = sample_of_output(output)) given.insert(*kind);
    }
  }
  return false;
}

std::size_t Pipeline::capacity() const {
  if (in_turn_ || stages_.empty()) return 1;
  std::size_t least = stages_.front()->capacity();
  for (const auto& plugin : stages_) least = std::min(least, plugin->capacity());
  return least;
}

/// Whether a frame has something that a plugin takes, or the plugin drives.
bool Pipeline::is_for(std::size_t stage, const hw_frame_t& frame) const {
  const PluginInfo& plugin = facts_[stage].info;
  return stage == driver_ ||
         std::any_of(frame.samples, frame.samples + frame.n_samples,
                     [&](const hw_sample_t* sample) { return plugin.takes(sample->kind); });
}

void Pipeline::submit(const hw_frame_t& frame, std::span<const std::byte> bytes) {
  if (!in_turn_) {
    std::vector<bool>& called = called_.emplace_back();
    for (std::size_t i = 0; i < stages_.size(); ++i) {
      called.push_back(is_for(i, frame));
      if (called.back()) stages_[i]->submit(frame, bytes);
    }
    return;
  }
  if (submitted_ != nullptr) throw Error(ErrorCode::kInternal, "too many frames under way");
  submitted_ = &frame;
  submitted_bytes_ = bytes;
}

const Outputs& Pipeline::collect(std::size_t stage) {
  Stage& plugin = *stages_[stage];
  const Outputs& outputs = plugin.collect();
  last_call_.wall_ns += plugin.last_call().wall_ns;
  last_call_.cpu_ns += plugin.last_call().cpu_ns;
  if (stage == driver_) drive_command_ = outputs.drive_command();
  return outputs;
}

const Outputs& Pipeline::collect_in_turn() {
  if (submitted_ == nullptr) throw Error(ErrorCode::kInternal, "collect() without a frame");
  const hw_frame_t* frame = &found_samples_.begin(*std::exchange(submitted_, nullptr));
  std::span<const std::byte> bytes = submitted_bytes_;
  const Outputs* outputs = nullptr;
  for (std::size_t i = 0; i < stages_.size(); ++i) {
    outputs = &no_outputs_;
    was_called_ = is_for(i, *frame);
    if (!was_called_) continue;
    stages_[i]->submit(*frame, bytes);
    outputs = &collect(i);
    bytes = {};  // of the frame without what is added now
    frame = &found_samples_.add(*outputs);
  }
  with_planes_ = frame;
  return *outputs;
}

const Outputs& Pipeline::collect() {
  last_call_ = {};
  drive_command_.reset();
  if (in_turn_) return collect_in_turn();
  if (called_.empty()) throw Error(ErrorCode::kInternal, "collect() without a frame");
  const std::vector<bool> called = std::move(called_.front());
  called_.pop_front();
  const Outputs* outputs = &no_outputs_;
  for (std::size_t i = 0; i < stages_.size(); ++i) outputs = called[i] ? &collect(i) : &no_outputs_;
  was_called_ = !called.empty() && called.back();
  return *outputs;
}

const Outputs& Pipeline::process(const hw_frame_t& frame, std::span<const std::byte> bytes) {
  submit(frame, bytes);
  return collect();
}

const Outputs& Pipeline::report(bool refine) {
  if (stages_.empty()) return no_outputs_;
  const Outputs& outputs = stages_.back()->report(refine);
  last_call_ = stages_.back()->last_call();
  return outputs;
}

void Pipeline::reset() {
  for (const auto& plugin : stages_) plugin->reset();
}

void Pipeline::restart() {
  started_ = false;
  called_.clear();
  stages_.clear();
  start();
}

void Pipeline::close() {
  for (const auto& plugin : stages_) plugin->close();
}

}  // namespace hallway::host
