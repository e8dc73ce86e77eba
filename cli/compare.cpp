// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <memory>
#include <set>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "batch/table.hpp"
#include "batch_table.hpp"
#include "command.hpp"
#include "console.hpp"
#include "host/plugin_table.hpp"
#include "isolation_options.hpp"
#include "output_file.hpp"
#include "plugin_argument.hpp"
#include "plugin_sweep.hpp"
#include "render/png.hpp"
#include "renderer_option.hpp"
#include "run/scoring/comparison.hpp"
#include "shared_options.hpp"
#include "sim/schema.hpp"

namespace hallway::cli {
namespace {

constexpr const char* kPictureFile = "comparison.png";
constexpr const char* kRunsFolder = "cells";

struct CompareOptions : OutputOptions {
  std::string input;
  std::vector<std::string> plugins;
  std::vector<std::string> settings;
  std::optional<std::uint64_t> seed;
  std::optional<std::uint32_t> steps;
  std::string out;
  std::string view = "top";
  std::vector<std::string> plugin_path;
  std::optional<unsigned> threads;
  IsolationOptions isolation;
  std::optional<std::string> renderer;
  unsigned jobs = 1;
};

bool is_log(const fs::path& input) {
  std::error_code none;
  return input.extension() == ".csv" || input.extension() == ".mcap" || fs::is_directory(input, none);
}

/// Options that every run is given as they are. Throws Error{kUsage} for those of a scenario where the input is a log.
std::vector<std::string> common_arguments(const CompareOptions& options) {
  std::vector<std::string> arguments;
  const auto add = [&](const char* option, const std::string& value) {
    arguments.insert(arguments.end(), {option, value});
  };
  const auto add_of_scenario = [&](const char* option, auto value) {
    if (!value) return;
    if (is_log(options.input))
      refuse("{} is for a scenario, and {} is a log", option, path_text(options.input));
    add(option, fmt::to_string(*value));
  };
  add_of_scenario("--seed", options.seed);
  add_of_scenario("--threads", options.threads);
  if (options.steps) add("--steps", fmt::to_string(*options.steps));
  for (const std::string& folder : options.plugin_path) add("--plugin-path", folder);
  for (const std::string& argument : arguments_of(options.isolation)) arguments.push_back(argument);
  return arguments;
}

/// What is no value of a scenario is a parameter, and of several plugins it is not known whose.
void refuse_bare_parameter(const Override& setting, const std::vector<batch::PluginSweep>& plugins) {
  if (setting.key.find('.') != std::string::npos) return;
  if (std::ranges::find(sim::kTopOverrideKeys, setting.key) != sim::kTopOverrideKeys.end()) return;
  std::set<std::string> names;
  for (const batch::PluginSweep& plugin : plugins) names.insert(host::short_plugin_name(plugin.plugin));
  if (names.size() > 1) refuse_whose(setting, {names.begin(), names.end()});
}

/// What is set of one of the plugins is set where that runs; everything else in every run.
void add_settings(const CompareOptions& options, batch::Dimensions& dimensions) {
  for (const std::string& text : options.settings) {
    const Override setting = parse_setting(text);
    bool of_plugin = false;
    for (batch::PluginSweep& plugin : dimensions.plugins) {
      const std::string prefix = host::short_plugin_name(plugin.plugin) + ".";
      if (!setting.key.starts_with(prefix)) continue;
      plugin.parameters.push_back({setting.key.substr(prefix.size()), {setting.value}});
      of_plugin = true;
    }
    if (!of_plugin) refuse_bare_parameter(setting, dimensions.plugins);
    if (!of_plugin) dimensions.more.insert(dimensions.more.end(), {"--set", text});
  }
}

batch::Plan plan_of(const CompareOptions& options) {
  batch::Dimensions dimensions;
  dimensions.inputs = {options.input};
  for (const std::string& plugin : options.plugins) dimensions.plugins.push_back(parse_plugin_sweep(plugin));
  dimensions.more = common_arguments(options);
  for (const std::string& plugin : options.plugins) refuse_second_values(plugin, options.settings);
  add_settings(options, dimensions);
  return {.cells = batch::combine(dimensions)};
}

/// The picture of all runs that left something. @return whether there was something to draw
bool draw(const CompareOptions& options, render::Renderer renderer, const fs::path& folder,
          const std::vector<batch::Result>& results) {
  std::vector<std::unique_ptr<run::Record>> records;
  std::vector<run::Compared> runs;
  for (const batch::Result& result : results) {
    const fs::path cell = folder / kRunsFolder / result.name;
    if (!run::is_run_folder(cell)) continue;
    records.push_back(std::make_unique<run::Record>(run::read_record(cell)));
    runs.push_back({result.name, *records.back()});
  }
  if (runs.empty()) return false;
  sim::PictureSpec spec;
  spec.view = options.view == "top" ? sim::PictureView::kTop : sim::PictureView::kPerspective;
  spec.show = {sim::PictureLayer::kMap,       sim::PictureLayer::kTruth,  sim::PictureLayer::kEstimate,
               sim::PictureLayer::kLandmarks, sim::PictureLayer::kErrors, sim::PictureLayer::kPlanes};
  spec.width_px = 960;
  spec.height_px = 640;
  write_file_atomically(folder / kPictureFile,
                        render::encode_png(run::draw_comparison(runs, spec, renderer)));
  return true;
}

/// Where the runs are made. What an earlier comparison left stays until this one has something to put in its place.
class WorkingFolder {
 public:
  explicit WorkingFolder(const fs::path& folder)
      : folder_(folder), path_(folder.has_filename() ? folder : folder.parent_path()) {
    path_ += ".part-" + std::to_string(::getpid());
  }
  ~WorkingFolder() {
    std::error_code none;
    fs::remove_all(path_, none);
  }
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;

  const fs::path& path() const { return path_; }

  /// Throws Error{kIo}.
  void commit() const try {
    make_folder(folder_);
    for (const char* name : {kRunsFolder, batch::kTableFile, batch::kDocumentFile, kPictureFile}) {
      fs::remove_all(folder_ / name);
      if (fs::exists(path_ / name)) fs::rename(path_ / name, folder_ / name);
    }
  } catch (const fs::filesystem_error& failure) {
    throw Error(ErrorCode::kIo, failure.code().message(), {.file = path_text(folder_)});
  }

 private:
  fs::path folder_;
  fs::path path_;
};

int compare(const CompareOptions& options) {
  const render::Renderer renderer = chosen_renderer(options.renderer);
  render::demand(renderer);
  const batch::Plan plan = plan_of(options);
  const fs::path folder = output_folder(options.out, fs::path(options.input).stem().string() + "-compared");
  if (std::error_code none; !fs::exists(options.input, none))
    throw Error(ErrorCode::kBadInput, "is not there", {.file = path_text(options.input)});
  check_output_folder(folder, batch::kDocumentFile, options.force);
  check_replaces_no_input((folder / kRunsFolder).string(), std::array{options.input});
  catch_interrupts();
  Progress progress("runs", plan.cells.size(), options.quiet || options.json);
  const WorkingFolder working(folder);
  const std::vector<batch::Result> results =
      batch::run_cells(plan, {.program = fs::read_symlink("/proc/self/exe"),
                              .folder = working.path(),
                              .jobs = options.jobs,
                              .environment = renderer_environment(renderer),
                              .progress = [&](std::size_t done) { progress.update(done); },
                              .stop = interrupted});
  if (results.size() < plan.cells.size()) throw Error(ErrorCode::kInterrupted, "interrupted");
  const bool any_ran = std::ranges::any_of(results, [&](const batch::Result& result) {
    return run::is_run_folder(working.path() / kRunsFolder / result.name);
  });
  if (!any_ran) {  // an earlier comparison stays, and this one may be asked for again
    if (options.json) {
      Json document = batch::to_json(results);
      document["picture"] = nullptr;
      print_json(document);
    } else {
      print_notice(failures_text(results, {}));
    }
    return results.front().status;
  }
  fs::path picture;
  try {
    if (draw(options, renderer, working.path(), results)) picture = folder / kPictureFile;
  } catch (const Error& error) {  // what the runs came to is worth more than their picture
    print_warning(std::string("no picture: ") + error.what());
  }
  Json document = batch::to_json(results);
  document["picture"] = nullptr;
  if (!picture.empty()) document["picture"] = path_text(picture);
  write_file_atomically(working.path() / batch::kTableFile, batch::print_csv(results));
  write_file_atomically(working.path() / batch::kDocumentFile, document.dump(1) + "\n");
  working.commit();
  if (options.json) {
    print_json(document);
  } else if (!options.quiet) {
    print_result(results_table(results) + failures_text(results, {}) +
                 (picture.empty() ? "" : path_text(picture) + "\n"));
  } else if (const std::string failures = failures_text(results, {}); !failures.empty()) {
    print_notice(failures);
  }
  // The first failure's own status says most: a plugin that is not there, or that misbehaved.
  for (const batch::Result& result : results) {
    if (!result.good()) return result.status;
  }
  return 0;
}

}  // namespace

void add_compare_command(Command& app) {
  Command& command = app.command(
      "compare",
      "Run several plugins, or one with several parameters, on the same input, and compare their maps");
  CompareOptions& options = command.runs(&compare);
  command.argument("input", &options.input, "A scenario, a log (.csv, .mcap), or the folder of a run")
      .required()
      .value("SCENARIO|LOG");
  add_shared(command, Shared::kPlugin, &options.plugins).required().repeatable();
  add_shared(command, Shared::kSet, &options.settings).repeatable();
  add_shared(command, Shared::kSeed, &options.seed).fallback("the scenario's");
  add_shared(command, Shared::kSteps, &options.steps).fallback("the input's");
  add_shared(command, Shared::kOutFolder, &options.out).fallback("out/<input>-compared");
  add_shared(command, Shared::kView, &options.view).choices({"top", "perspective"}).show_default();
  add_shared(command, Shared::kJobs, &options.jobs).show_default();
  add_plugin_path_option(command, options.plugin_path);
  add_shared(command, Shared::kThreads, &options.threads).fallback("all processors");
  add_isolation_options(command, options.isolation);
  add_renderer_option(command, options.renderer);
  add_output_options(command, options);
  command.footer(
      "Several values of a parameter are tried each with each: --plugin "
      "slam_point:noise_m=0.01,0.05,mode=thesis.\n"
      "Writes a table (results.csv, results.json), comparison.png with a panel for each run, and the "
      "folder of each run in cells/.\n"
      "Exit status: 0, or that of the first run that failed.\n"
      "Example: hallway compare maps/office.toml --plugin slam_point:noise_m=0.01,0.05 --plugin "
      "build/my_slam.so");
}

}  // namespace hallway::cli
