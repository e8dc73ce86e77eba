// SPDX-License-Identifier: MIT
#pragma once

#include <random>
#include <string>
#include <vector>

#include "map/document.hpp"
#include "map/texture_axes.hpp"

namespace hallway::map::test {

/// Documents with everything the format can hold, from a seed.
class RandomDocument {
 public:
  explicit RandomDocument(std::uint64_t seed) : random_(seed) {}

  Document make() {
    Document document;
    const int entities = upto(4);
    for (int i = 0; i < entities; ++i) document.entities.push_back(entity());
    document.closing_comments = comments();
    return document;
  }

 private:
  int upto(int largest) { return static_cast<int>(random_() % static_cast<std::uint64_t>(largest + 1)); }

  std::string text(int longest) {
    static const std::vector<std::string> kParts{"a",    "Z",    "7",    " ",  "\t",  "\\", "\"",
                                                 "\\\"", "//",   "{",    "}",  "(",   ";",  "ü",
                                                 "→",    "\xff", "\x1b", "\r", "\\n", "'"};
    std::string made;
    const int parts = upto(longest);
    for (int i = 0; i < parts; ++i)
      made += kParts[static_cast<std::size_t>(upto(static_cast<int>(kParts.size()) - 1))];
    return made;
  }

  std::string name() { return text(6) + "n"; }

  std::vector<std::string> comments() {
    std::vector<std::string> made;
    const int lines = upto(7) - 5;
    for (int i = 0; i < lines; ++i) {
      std::string comment = text(5);
      const std::size_t last = comment.find_last_not_of(" \t\r");
      made.push_back(comment.substr(0, last == std::string::npos ? 0 : last + 1));
    }
    return made;
  }

  double number() {
    const double sign = upto(1) ? 1.0 : -1.0;
    switch (upto(5)) {
      case 0:
        return sign * 0.0;
      case 1:
        return sign * upto(4096);
      case 2:
        return sign * static_cast<double>(random_()) * 1e-15;
      case 3:
        return sign * 1e280 * static_cast<double>(random_());
      case 4:
        return sign * 5e-324 * upto(1000);
      default:
        return sign * static_cast<double>(random_());
    }
  }

  Vec3 vector() {
    const double x = number();
    const double y = number();
    return {x, y, number()};
  }

  Face face() {
    Face made;
    made.comments = comments();
    for (Vec3& point : made.points) point = vector();
    made.material = name();
    made.u_axis = vector();
    made.v_axis = vector();
    for (double* value : {&made.u_offset, &made.v_offset, &made.rotation_deg, &made.u_scale, &made.v_scale}) {
      *value = number();
    }
    if (upto(2) == 0) made.surface_flags = SurfaceFlags{upto(1 << 30), -upto(1 << 30), number()};
    return made;
  }

  Brush brush() {
    Brush made;
    made.comments = comments();
    const int faces = upto(7);
    for (int i = 0; i < faces; ++i) made.faces.push_back(face());
    if (upto(5) == 0) make_primitive(made);
    if (upto(9) == 0) make_unread(made);
    made.closing_comments = comments();
    return made;
  }

  /// As the reader makes it: the axes follow from the points.
  void make_primitive(Brush& brush) {
    for (Face& face : brush.faces) {
      face.texture_matrix = {number(), number(), number(), number(), number(), number()};
      const TextureAxes axes = standard_axes(face.points, 0.0);
      face.u_axis = axes.u;
      face.v_axis = axes.v;
      face.u_offset = face.v_offset = face.rotation_deg = 0.0;
      face.u_scale = face.v_scale = 1.0;
    }
  }

  void make_unread(Brush& brush) {
    brush.faces.clear();
    brush.unread = upto(1) ? "patchDef2\n{\n{ \"}\" // }\n} ; {\n}" : "brushDef3 { }";
  }

  Entity entity() {
    Entity made;
    made.comments = comments();
    const int keys = upto(5);
    for (int i = 0; i < keys; ++i) {
      KeyValue pair;
      pair.comments = comments();
      pair.key = name();
      pair.value = text(8);
      made.keys.push_back(std::move(pair));
    }
    const int brushes = upto(3);
    for (int i = 0; i < brushes; ++i) made.brushes.push_back(brush());
    made.closing_comments = comments();
    return made;
  }

  std::mt19937_64 random_;
};

}  // namespace hallway::map::test
