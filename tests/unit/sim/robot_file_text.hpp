// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace hallway::test {

/// An entity with its keys, such as `"name" "eyes"`, a line each.
inline std::string entity_text(const std::string& classname, const std::string& keys) {
  return "{\n\"classname\" \"" + classname + "\"\n" + keys + "}\n";
}

inline std::string key_text(const std::string& key, const std::string& value) {
  return "\"" + key + "\" \"" + value + "\"\n";
}

inline const std::string kRoundBody = entity_text(
    "hw_body", key_text("radius_m", "0.2") + key_text("bottom_m", "0.05") + key_text("top_m", "0.4"));

/// A robot file in centimetres: what stands in it, with `brushes` in its worldspawn. The first entity begins at line 7 where there are no brushes.
inline std::string robot_text(const std::string& entities, const std::string& brushes = "") {
  return "{\n\"classname\" \"worldspawn\"\n\"_hallway\" \"1\"\n\"_scale\" \"0.01\"\n\"_hallway_robot\" "
         "\"1\"\n" +
         brushes + "}\n" + entities;
}

}  // namespace hallway::test
