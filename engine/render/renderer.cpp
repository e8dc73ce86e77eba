// SPDX-License-Identifier: MIT
#include "render/renderer.hpp"

#include <algorithm>
#include <utility>

#include "render/gl_context.hpp"

namespace hallway::render {

std::optional<Renderer> parse_renderer(std::string_view name) {
  const auto found = std::find(kRendererNames.begin(), kRendererNames.end(), name);
  if (found == kRendererNames.end()) return std::nullopt;
  return static_cast<Renderer>(found - kRendererNames.begin());
}

NoRenderer::NoRenderer(std::string cause)
    : Error(ErrorCode::kIo, "no picture can be drawn: " + cause), cause_(std::move(cause)) {}

std::unique_ptr<GlContext> make_offscreen_context(Renderer renderer) {
  if (renderer == Renderer::kOsmesa) return make_osmesa_context();
  if (renderer == Renderer::kEgl) return make_egl_context();
  std::string causes;
  for (const auto make : {make_osmesa_context, make_egl_context}) {
    try {
      return make();
    } catch (const NoRenderer& missing) {
      causes += (causes.empty() ? "" : "; ") + missing.cause();
    }
  }
  throw NoRenderer(causes);
}

void demand(Renderer renderer) {
  if (renderer != Renderer::kAuto) make_offscreen_context(renderer);
}

}  // namespace hallway::render
