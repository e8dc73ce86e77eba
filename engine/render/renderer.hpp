// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace hallway::render {

/// What draws the faces of a picture: OpenGL in software, in a library that is opened when the first face is drawn.
/// One renderer gives the same bytes for the same input on one machine; two differ in single samples along edges.
enum class Renderer {
  kAuto,    ///< kOsmesa where its library is installed, else kEgl
  kOsmesa,  ///< Mesa's off-screen library, which Mesa has up to version 25.0
  kEgl,     ///< EGL's software device, or its surfaceless platform where that renders in software
};

/// The names of the renderers, in the order of the enumeration.
inline constexpr std::array<std::string_view, 3> kRendererNames{"auto", "osmesa", "egl"};

/// The renderer of that name; empty for an unknown name.
std::optional<Renderer> parse_renderer(std::string_view name);

/// No face can be drawn, because this machine does not have what the renderer needs. The message names the libraries that
/// were tried and the Debian packages that have them.
class NoRenderer : public Error {
 public:
  explicit NoRenderer(std::string cause);

  /// What is missing, without the words that every such message begins with.
  const std::string& cause() const noexcept { return cause_; }

 private:
  std::string cause_;
};

/// Throws NoRenderer if a renderer that is asked for by name cannot draw on this machine, for those who would find that out late. Says nothing of
/// kAuto, which demands none. Makes a context, some 50 ms.
void demand(Renderer renderer);

}  // namespace hallway::render
