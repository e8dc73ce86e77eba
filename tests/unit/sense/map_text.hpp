// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "geometry/se3.hpp"
#include "map/reader.hpp"

namespace hallway::test {

using Keys = std::vector<std::pair<std::string, std::string>>;

/// A box as the text of a brush; coordinates in map units.
inline std::string box_brush(const Vec3& low, const Vec3& high) {
  std::string text = "{\n";
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool outer : {false, true}) {
      // Three points of the face, clockwise from outside: the third less the first, times the second less the
      // first, is the outward normal.
      std::array<Vec3, 3> points;
      points.fill(outer ? high : low);
      points[outer ? 2 : 1][(axis + 1) % 3] += outer ? -1.0 : 1.0;
      points[outer ? 1 : 2][(axis + 2) % 3] += outer ? -1.0 : 1.0;
      for (const Vec3& p : points) {
        text += "( " + format_double(p.x()) + " " + format_double(p.y()) + " " + format_double(p.z()) + " ) ";
      }
      text += "wall [ 1 0 0 0 ] [ 0 -1 0 0 ] 0 1 1\n";
    }
  }
  return text + "}\n";
}

/// An entity as text.
inline std::string entity(const Keys& keys, const std::vector<std::string>& brushes = {}) {
  std::string text = "{\n";
  for (const auto& [key, value] : keys) text += "\"" + key + "\" \"" + value + "\"\n";
  for (const std::string& brush : brushes) text += brush;
  return text + "}\n";
}

/// The first entity of a map whose unit is the metre.
inline std::string worldspawn(Keys keys, const std::vector<std::string>& brushes = {}) {
  keys.insert(keys.begin(), {{"classname", "worldspawn"}, {"_hallway", "1"}, {"_scale", "1"}});
  return entity(keys, brushes);
}

inline map::Document parse_map(const std::string& text) {
  return map::parse(text, "test.map");
}

}  // namespace hallway::test
