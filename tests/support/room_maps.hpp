// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>

namespace hallway::test {

/// A corner in map units.
using Units = std::array<int, 3>;

/// The text of a brush: a box.
inline std::string box_brush(const Units& low, const Units& high, const std::string& material) {
  const std::array<std::array<std::array<int, 3>, 3>, 6> faces{{
      // Each number says whether a coordinate of a point is the low (0) or the high (1) one.
      {{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
      {{{1, 0, 0}, {1, 0, 1}, {1, 1, 0}}},
      {{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}},
      {{{0, 1, 0}, {1, 1, 0}, {0, 1, 1}}},
      {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
      {{{0, 0, 1}, {0, 1, 1}, {1, 0, 1}}},
  }};
  std::string text = "{\n";
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (const auto& point : faces[f]) {
      text += "( ";
      for (std::size_t axis = 0; axis < 3; ++axis) {
        text += std::to_string(point[axis] == 0 ? low[axis] : high[axis]) + " ";
      }
      text += ") ";
    }
    text +=
        material + (f < 4 ? " [ 0.6 0.8 0 0 ] [ 0 0 -1 0 ] 0 1 1\n" : " [ 1 0 0 0 ] [ 0 -1 0 0 ] 0 1 1\n");
  }
  return text + "}\n";
}

/// The text of an entity at a place.
inline std::string point_entity(const std::string& classname, const Units& at, const std::string& more = {}) {
  return "{\n\"classname\" \"" + classname + "\"\n\"origin\" \"" + std::to_string(at[0]) + " " +
         std::to_string(at[1]) + " " + std::to_string(at[2]) + "\"\n" + more + "}\n";
}

/// Two rooms cut out of a block and a passage from one to the other around two corners, so that neither sees into the other. In
/// metres: room A from (0, 0, 0) to (4, 3, 3), room B from (6, 0, 0) to (10, 3, 3), 2 m of solid between them; the passage is 1 m wide and
/// leaves A at x = 1.5, B at x = 7.5, both at y = 3, and runs along y from 6 to 7. A robot starts at (2, 1.5, 0.2), in A.
/// @param more_cut       brushes that are cut out as well
/// @param more_entities  other entities
inline std::string two_rooms(const std::string& more_cut = {}, const std::string& more_entities = {}) {
  return "{\n\"classname\" \"worldspawn\"\n\"_scale\" \"0.01\"\n" +
         box_brush({-100, -100, -100}, {1100, 800, 400}, "concrete") +
         "}\n{\n\"classname\" \"hw_subtract\"\n" + box_brush({0, 0, 0}, {400, 300, 300}, "plaster") +
         box_brush({600, 0, 0}, {1000, 300, 300}, "plaster") +
         box_brush({150, 300, 0}, {250, 600, 300}, "wall") +
         box_brush({750, 300, 0}, {850, 600, 300}, "wall") +
         box_brush({150, 600, 0}, {850, 700, 300}, "wall") + more_cut + "}\n" +
         point_entity("hw_robot_start", {200, 150, 20}) + more_entities;
}

/// An opening of 0.5 m x 2 m from room A through the outer wall, around (-0.5, 1.25, 1.5).
inline std::string hole() {
  return box_brush({-100, 100, 50}, {0, 150, 250}, "wall");
}

}  // namespace hallway::test
