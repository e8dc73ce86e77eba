// SPDX-License-Identifier: MIT
#include "plugin_sweep.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::cli {

batch::PluginSweep parse_plugin_sweep(const std::string& text) {
  batch::PluginSweep sweep;
  for (const std::string_view part : split(text, ':')) {
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos) {
      if (!sweep.parameters.empty())
        throw Error(ErrorCode::kUsage,
                    fmt::format("--plugin {}: \"{}\" is no param=value", printable(text), printable(part)));
      sweep.plugin += (sweep.plugin.empty() ? "" : ":") + std::string(part);
      continue;
    }
    batch::PluginSweep::Values values{std::string(part.substr(0, equals)), {}};
    for (const std::string_view value : split(part.substr(equals + 1), ','))
      values.values.emplace_back(value);
    if (sweep.plugin.empty() || values.name.empty() || values.values.empty())
      throw Error(ErrorCode::kUsage,
                  fmt::format("--plugin takes NAME[:param=value,...]..., not \"{}\"", printable(text)));
    sweep.parameters.push_back(std::move(values));
  }
  if (sweep.plugin.empty()) throw Error(ErrorCode::kUsage, "--plugin: a plugin has a name");
  return sweep;
}

}  // namespace hallway::cli
