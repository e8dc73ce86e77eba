// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "render/renderer.hpp"

namespace hallway::cli {

/// The environment variable that names a renderer where --renderer does not.
inline constexpr const char* kRendererVariable = "HALLWAY_RENDERER";

/// Adds --renderer to a command that draws faces.
void add_renderer_option(Command& command, std::optional<std::string>& name);

/// The renderer that the command line names, or else the environment; kAuto where neither does. Throws Error{kUsage} for an unknown name,
/// with those that there are.
render::Renderer chosen_renderer(const std::optional<std::string>& name);

/// Variables for programs of ours that are started to draw, so that they draw with the same renderer.
std::vector<std::string> renderer_environment(render::Renderer renderer);

}  // namespace hallway::cli
