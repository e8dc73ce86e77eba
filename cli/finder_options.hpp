// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "console.hpp"
#include "isolation_options.hpp"
#include "planes/finder.hpp"
#include "render/picture.hpp"
#include "render/view.hpp"

namespace hallway::cli {

/// What the commands share that find planes with plugins.
struct FinderOptions : OutputOptions {
  std::vector<std::string> settings{};
  unsigned repeat = 1;
  std::string out{};
  std::string view = "perspective";
  std::vector<std::string> plugin_path{};
  IsolationOptions isolation{};
};

/// Adds --repeat and --out.
void add_finder_options(Command& command, FinderOptions& options);
/// Adds --view, --plugin-path, the limits of plugins, --force, --json and --quiet.
void add_finder_output_options(Command& command, FinderOptions& options);

/// A finder for each plugin that --plugin names, with the parameters of --set. Throws what planes::PlaneFinder throws.
std::vector<std::unique_ptr<planes::PlaneFinder>> finders_of(const std::vector<std::string>& plugins,
                                                             const FinderOptions& options);

/// What --view names.
render::View plane_view(const FinderOptions& options);

}  // namespace hallway::cli
