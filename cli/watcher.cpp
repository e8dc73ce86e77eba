// SPDX-License-Identifier: MIT
#include "watcher.hpp"

#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "console.hpp"
#include "plugin_report.hpp"
#include "run/pictures/record.hpp"
#include "watch/make_scene.hpp"

namespace hallway::cli {

host::LogSink Watcher::log_sink() {
  return [this](const std::string& plugin, std::uint32_t level, const std::string& message) {
    if (shows_lines_) {
      keep_(plugin, level, message);
    } else {
      print_plugin_log(plugin, level, message);
    }
  };
}

void Watcher::begin(const sim::Simulator& simulator, const run::Source& source,
                    const nlohmann::ordered_json& manifest) {
  catch_interrupts();
  moments_.emplace(source, log_);
  iterations_ = source.iterations();
  screen_.emplace(watch::scene_of(simulator, source, manifest), style_, false);
}

void Watcher::add_to(run::RunHooks& hooks) {
  moments_->add_to(hooks, [this](const watch::Moment& moment) { show(moment); });
}

void Watcher::show(const watch::Moment& moment) {
  if (!screen_) return;
  screen_->add(moment);
  const bool is_last = moment.iteration + 1 == iterations_;
  const Screen::Next next = is_last ? screen_->show_last() : screen_->next();
  if (next == Screen::Next::kLeave) close();
}

void Watcher::close() {
  screen_.reset();
  shows_lines_ = false;
  for (const foxglove::LogLine& line : log_.take()) print_plugin_log(line.name, line.level, line.text);
}

void Watcher::finish(const std::filesystem::path& folder) {
  if (screen_ && screen_->is_open()) {
    try {
      screen_->set_mapped(watch::scene_of(run::read_record(folder)));
    } catch (const Error&) {  // the view is no reason to fail
    }
    screen_->end();
    while (screen_->next() != Screen::Next::kLeave) {
    }
  }
  close();
}

}  // namespace hallway::cli
