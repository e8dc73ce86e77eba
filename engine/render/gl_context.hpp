// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

namespace hallway::render {

/// An OpenGL 3.3 core context without a window, current on the thread that made it until it is destroyed there.
class GlContext {
 public:
  GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;
  virtual ~GlContext() = default;

  using Function = void (*)();
  /// The entry point of a GL function; null if the context does not have it.
  virtual Function function(const char* name) const = 0;
};

/// A software context of OSMesa. Throws Error{kIo} if none can be made.
std::unique_ptr<GlContext> make_offscreen_context();

}  // namespace hallway::render
