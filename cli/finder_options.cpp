// SPDX-License-Identifier: MIT
#include "finder_options.hpp"

#include "plugin_argument.hpp"
#include "plugin_path.hpp"
#include "plugin_report.hpp"
#include "shared_options.hpp"

namespace hallway::cli {

void add_finder_options(Command& command, FinderOptions& options) {
  add_shared(command, Shared::kRepeat, &options.repeat).show_default();
  add_shared(command, Shared::kOutFolder, &options.out).fallback("none");
}

void add_finder_output_options(Command& command, FinderOptions& options) {
  add_shared(command, Shared::kView, &options.view).choices({"top", "perspective"}).show_default();
  add_plugin_path_option(command, options.plugin_path);
  add_limit_options(command, options.isolation);
  add_output_options(command, options);
}

std::vector<std::unique_ptr<planes::PlaneFinder>> finders_of(const std::vector<std::string>& plugins,
                                                             const FinderOptions& options) {
  std::vector<host::StageSpec> stages;
  for (const std::string& plugin : plugins) stages.push_back(parse_plugin(plugin));
  for (const std::string& setting : options.settings) set_parameter(stages, setting);
  std::vector<std::unique_ptr<planes::PlaneFinder>> finders;
  for (const host::StageSpec& stage : stages)
    finders.push_back(
        std::make_unique<planes::PlaneFinder>(stage, plugin_folders(options.plugin_path), print_plugin_log,
                                              isolation_of(options.isolation, apply(options.isolation, {}))));
  return finders;
}

render::View plane_view(const FinderOptions& options) {
  return {.kind = options.view == "top" ? render::ViewKind::kTop : render::ViewKind::kPerspective};
}

}  // namespace hallway::cli
