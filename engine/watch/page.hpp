// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "watch/grid.hpp"
#include "watch/layers.hpp"
#include "watch/player.hpp"

namespace hallway::watch {

/// A part of a terminal, in cells.
struct Area {
  int column = 0;
  int row = 0;
  int width = 0;
  int height = 0;
};

/// Where things are on a page: the title in its first row, the help line in its last.
struct PageLayout {
  Area canvas{};
  Area panel{};  ///< beside the canvas, or below it on a narrow page
  Area lines{};  ///< of the log, below them
};

/// The least page that is drawn.
inline constexpr int kLeastWidth = 40;
inline constexpr int kLeastHeight = 12;

/// @param width, height  at least the above
PageLayout layout_of(int width, int height);

/// A line of the panel.
using PanelLine = std::pair<std::string, Role>;

/// The state of a moment: frame, time, true pose, the plugin's answer, the drive, the sensors; the most important first.
std::vector<PanelLine> panel_lines(const Subject& subject);

/// How a page shows its moment.
struct PageState {
  const Player& player;
  const View& view;
  const ShownLayers& layers;
  Dots dots = Dots::kBraille;
  bool follows = false;
  bool shows_help = false;
  std::string note{};  ///< what keeps the view from going on; empty: nothing
};

/// Draws a page. One that is smaller than the least says so.
Grid draw_page(int width, int height, const Subject& subject, const PageState& state);

/// A page with one line of text.
Grid text_page(int width, int height, const std::string& text);

}  // namespace hallway::watch
