// SPDX-License-Identifier: MIT
#include "renderer_option.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "base/refuse.hpp"
#include "base/text.hpp"
#include "shared_options.hpp"

namespace hallway::cli {

void add_renderer_option(Command& command, std::optional<std::string>& name) {
  add_shared(command, Shared::kRenderer, &name)
      .choices({render::kRendererNames.begin(), render::kRendererNames.end()})
      .fallback(fmt::format("{}, else auto", kRendererVariable));
}

render::Renderer chosen_renderer(const std::optional<std::string>& name) {
  const char* variable = name ? nullptr : std::getenv(kRendererVariable);
  const bool named = name || (variable != nullptr && *variable != '\0');
  if (!named) return render::Renderer::kAuto;
  const std::string wanted = name ? *name : variable;
  if (const auto renderer = render::parse_renderer(wanted)) return *renderer;
  refuse("{}: there is no renderer \"{}\"; there are: {}", name ? "--renderer" : kRendererVariable,
         printable(wanted), fmt::join(render::kRendererNames, ", "));
}

std::vector<std::string> renderer_environment(render::Renderer renderer) {
  return {
      fmt::format("{}={}", kRendererVariable, render::kRendererNames[static_cast<std::size_t>(renderer)])};
}

}  // namespace hallway::cli
