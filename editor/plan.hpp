// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "editor/plan_section.hpp"
#include "editor/plan_sheet.hpp"
#include "editor/state.hpp"

namespace hallway::editor {

struct PlanName {
  std::string text{};
  Vec2 at = Vec2::Zero();  ///< the middle of what it names, or near that; of a wall, beside it
  bool beside = false;     ///< what it names is solid there, so that the text starts beside it
  bool upwards = false;
};

struct PlanStart {
  Vec2 at = Vec2::Zero();
  Vec2 ahead = Vec2::UnitX();  ///< where it looks
};

/// What a floor plan shows, metres, x to the right and y up.
struct FloorPlan {
  std::string title{};
  double height_m = 0.0;
  Section section{};
  std::vector<PlanLine> below{};  ///< edges of what is lower, as seen from above
  std::vector<PlanStart> starts{};
  std::vector<std::vector<Vec2>> paths{};  ///< as far as they are seen
  std::vector<Vec2> lights{};
  std::vector<PlanName> names{};
  std::vector<PlanLine> widths{};  ///< of rooms that have a name, from wall to wall
  std::vector<std::string> notes{};

  /// Of all that is drawn but texts.
  PlanBox bounds() const;
};

/// Looks down on a map from a height. Robot start, paths and lights are shown where no floor or ceiling is between them and the cut. What is
/// wrong with them is in `notes`.
/// Throws Error{kUsage} where nothing is solid at that height.
FloorPlan make_plan(const State& state, const std::string& file, double height_m);

struct PlanPaper {
  std::string name = "a4";           ///< a4, a3, a2, a1, letter
  std::string orientation = "auto";  ///< portrait, landscape, auto: the one that fits, and suits the plan
  double scale = 50.0;               ///< 1:scale
  bool dimensions = true;
  double grid_m = 0.0;  ///< 0: none
};

/// The page with the plan in the middle and a title block at its foot. Throws Error{kUsage} where it does not fit, naming paper and scale
/// that would do, and for a grid too fine to be drawn.
Sheet draw_plan(const FloorPlan& plan, const PlanPaper& paper);

}  // namespace hallway::editor
