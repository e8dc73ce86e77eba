// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "geometry/se3.hpp"
#include "map/document.hpp"

namespace hallway::map::test {

/// A face in Valve 220 form on one line, with a line break.
inline std::string face_line(const std::string& points, const std::string& material = "wall") {
  return points + " " + material + " [ 1 0 0 0 ] [ 0 -1 0 0 ] 0 1 1\n";
}

/// Six lines of faces: a cube of 128 units around the origin.
inline std::string cube_faces() {
  return face_line("( -64 -64 -64 ) ( -64 -63 -64 ) ( -64 -64 -63 )") +
         face_line("( -64 -64 -64 ) ( -64 -64 -63 ) ( -63 -64 -64 )") +
         face_line("( -64 -64 -64 ) ( -63 -64 -64 ) ( -64 -63 -64 )") +
         face_line("( 64 64 64 ) ( 64 65 64 ) ( 65 64 64 )") +
         face_line("( 64 64 64 ) ( 65 64 64 ) ( 64 64 65 )") +
         face_line("( 64 64 64 ) ( 64 64 65 ) ( 64 65 64 )");
}

/// A map of one worldspawn with one brush of these faces. The faces begin at line 4.
inline std::string map_of(const std::string& faces) {
  return "{\n\"classname\" \"worldspawn\"\n{\n" + faces + "}\n}\n";
}

/// An entity of these key-value pairs on lines of their own.
inline std::string entity_text(const std::vector<std::array<std::string, 2>>& pairs) {
  std::string text = "{\n";
  for (const auto& [key, value] : pairs) text += "\"" + key + "\" \"" + value + "\"\n";
  return text + "}\n";
}

/// The face of the half-space normal . x <= offset (map units), with points about one unit apart times `spread`.
inline Face half_space(const Vec3& normal, double offset, double spread = 1.0) {
  const Vec3 n = normal.normalized();
  const Vec3 u = n.unitOrthogonal() * spread;
  const Vec3 v = n.cross(u);
  const Vec3 p = n * offset;
  Face face;
  face.points = {p, Vec3(p + v), Vec3(p + u)};
  face.material = "wall";
  return face;
}

/// A document of one worldspawn with this brush.
inline Document document_of(Brush brush) {
  Document document;
  document.file = "test.map";
  Entity& world = document.entities.emplace_back();
  world.add("classname", "worldspawn");
  world.add("_scale", "1");
  world.brushes.push_back(std::move(brush));
  return document;
}

}  // namespace hallway::map::test
