// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "watch/canvas.hpp"
#include "watch/moment.hpp"
#include "watch/past.hpp"
#include "watch/scene.hpp"
#include "watch/view.hpp"

namespace hallway::watch {

/// What layers draw from.
struct Subject {
  const Scene& scene;
  const Past& past;
  const Moment& moment;
};

/// A canvas, and how the world lies on it.
struct Drawing {
  Canvas& canvas;
  const View& view;
  Dots dots = Dots::kBraille;

  Vec2 at(const Vec2& place) const { return view.dots_of(place, dots); }
  void line(const Line& line, Role role, int every = 1) const {
    canvas.line(at(line.first), at(line.second), role, every);
  }
  void dot(const Vec2& place, Role role) const { canvas.dot(at(place), role); }
  void glyph(const Vec2& place, char32_t glyph, Role role) const { canvas.glyph(at(place), glyph, role); }
  /// Characters from a cell to the right, as Grid::put() shows them; in ASCII, others are `?`.
  /// @param dots_in_cell  a place in the first cell, in dots of the canvas
  void text(Vec2 dots_in_cell, std::string_view text, Role role) const;
};

/// A layer of the drawing: a row of one table. A new layer is a new row.
struct Layer {
  char key = 0;  ///< shows and hides it
  std::string_view name{};
  std::string_view help{};
  void (*draw)(const Subject&, const Drawing&) = nullptr;
  bool is_of_points = false;  ///< many, which hide a plan
};

/// In the order in which they are drawn: later ones are in front.
std::span<const Layer> layers();

/// Which layers are shown, by their index in layers().
class ShownLayers {
 public:
  ShownLayers() = default;
  /// All but those of many points, which would hide the plan of a scene that has one.
  explicit ShownLayers(const Scene& scene);
  bool has(std::size_t index) const { return ((hidden_ >> index) & 1u) == 0; }
  /// Shows or hides the layer of a key. @return whether there is one
  bool toggle(int key);

 private:
  std::uint32_t hidden_ = 0;
};

/// Draws all that are shown.
void draw_layers(const Subject& subject, const ShownLayers& shown, const Drawing& drawing);

}  // namespace hallway::watch
