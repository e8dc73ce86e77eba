// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "render/renderer.hpp"

namespace hallway::render {

/// An OpenGL 3.3 core context without a window, current on the thread that made it until it is destroyed there. It may have no default
/// framebuffer: everything is drawn into framebuffer objects.
class GlContext {
 public:
  GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;
  virtual ~GlContext() = default;

  using Function = void (*)();
  /// The entry point of a GL function of version 3.3; may be null, or a pointer that must not be called, for any other name.
  virtual Function function(const char* name) const = 0;
};

/// A context of that renderer. Throws NoRenderer if this machine does not have it; with kAuto, if it has none.
std::unique_ptr<GlContext> make_offscreen_context(Renderer renderer);

/// A context of OSMesa. Throws NoRenderer.
std::unique_ptr<GlContext> make_osmesa_context();

/// A context of EGL that renders in software. Throws NoRenderer.
std::unique_ptr<GlContext> make_egl_context();

}  // namespace hallway::render
