// SPDX-License-Identifier: MIT
#include "map/brush_solid.hpp"

#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::map {

Solid solid_of(const Document& document, const Brush& brush, const char* what) {
  Document alone;
  alone.file = document.file;
  Entity& world = alone.entities.emplace_back();
  world.add("classname", "worldspawn");
  world.add("_scale", format_double(document.metres_per_unit()));
  Brush& copy = world.brushes.emplace_back(brush);
  for (Face& face : copy.faces) {
    face.material = "body";
    face.surface_flags.reset();
  }
  World made = build_world(alone);
  if (made.solids.empty()) {
    const Problem* problem = made.problems.empty() ? nullptr : &made.problems.front();
    throw Error(ErrorCode::kBadInput,
                std::string(what) + " is no convex solid: " + (problem ? problem->message : "no shape"),
                {document.file, problem ? problem->line : brush.line, {}});
  }
  return std::move(made.solids.front());
}

}  // namespace hallway::map
