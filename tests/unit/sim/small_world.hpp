// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace hallway::test {

/// The smallest scenario that is whole; `more` follows at line 8.
inline std::string scenario_text(const std::string& more = "") {
  return "map = \"small.map\"\n"
         "seed = 5\n"
         "steps = 40\n"
         "period_s = 0.1\n"
         "[robot]\n"
         "path = \"round\"\n"
         "loop_steps = 20\n" +
         more;
}

/// A brush with sides along the axes, in map units.
inline std::string block(int x0, int y0, int z0, int x1, int y1, int z1) {
  const auto point = [](int x, int y, int z) {
    return "( " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + " ) ";
  };
  const std::string rest = "wall [ 1 0 0 0 ] [ 0 -1 0 0 ] 0 1 1\n";
  return "{\n" + point(x0, y0, z0) + point(x0, y0 + 1, z0) + point(x0, y0, z0 + 1) + rest +  //
         point(x0, y0, z0) + point(x0, y0, z0 + 1) + point(x0 + 1, y0, z0) + rest +          //
         point(x0, y0, z0) + point(x0 + 1, y0, z0) + point(x0, y0 + 1, z0) + rest +          //
         point(x1, y1, z1) + point(x1, y1 + 1, z1) + point(x1 + 1, y1, z1) + rest +          //
         point(x1, y1, z1) + point(x1 + 1, y1, z1) + point(x1, y1, z1 + 1) + rest +          //
         point(x1, y1, z1) + point(x1, y1, z1 + 1) + point(x1, y1 + 1, z1) + rest + "}\n";
}

inline std::string waypoint(const std::string& path, int index, const std::string& origin) {
  return "{\n\"classname\" \"hw_waypoint\"\n\"path\" \"" + path + "\"\n\"index\" \"" + std::to_string(index) +
         "\"\n\"origin\" \"" + origin + "\"\n}\n";
}

/// A map in centimetres: a round path `round` of 2 m by 2 m about the origin, an open path `ahead` of 4 m along x at
/// y = 3 m, and a cloud of 40 landmarks to each 100 m of `ahead`. `brushes` stand in worldspawn.
inline std::string map_text(const std::string& brushes, const std::string& more_entities = "") {
  return "{\n\"classname\" \"worldspawn\"\n\"_hallway\" \"1\"\n\"_scale\" \"0.01\"\n\"_points_per_m2\" "
         "\"4\"\n" +
         brushes +
         "}\n{\n\"classname\" \"hw_path\"\n\"name\" \"round\"\n\"closed\" \"1\"\n\"corner_radius_m\" "
         "\"0.25\"\n}\n" +
         waypoint("round", 0, "-100 -100 0") + waypoint("round", 1, "100 -100 0") +
         waypoint("round", 2, "100 100 0") + waypoint("round", 3, "-100 100 0") +
         "{\n\"classname\" \"hw_path\"\n\"name\" \"ahead\"\n}\n" + waypoint("ahead", 0, "0 300 0") +
         waypoint("ahead", 1, "400 300 0") +
         "{\n\"classname\" \"hw_landmark_cloud\"\n\"name\" \"cloud\"\n\"path\" \"ahead\"\n\"per_100m\" "
         "\"400\"\n"
         "\"sideways_m\" \"1\"\n\"height_m\" \"0.5\"\n}\n" +
         more_entities;
}

/// Four blocks around the path `round`, none of them on it, some hiding others.
inline std::string pillars() {
  return block(300, -50, -100, 320, 50, 100) + block(-320, -50, -100, -300, 50, 100) +
         block(-50, 300, -100, 50, 320, 100) + block(400, -200, -100, 420, 200, 100);
}

}  // namespace hallway::test
