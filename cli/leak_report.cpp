// SPDX-License-Identifier: MIT
#include "leak_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "compiled_map.hpp"
#include "console.hpp"
#include "render/map_layers.hpp"
#include "run/pictures/map_view.hpp"

namespace hallway::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kPointSpacing_m = 0.5;
constexpr double kMostPointsOnLine = 1e5;

Json occupant_json(const map::Occupant& occupant) {
  return {{"classname", printable(occupant.classname)},
          {"name", printable(occupant.name)},
          {"entity", occupant.entity},
          {"line", occupant.line},
          {"position_m", place_json(occupant.position_m)}};
}

/// null where nothing is known; a height that is not known is null.
Json opening_json(const bsp::Opening& opening) {
  if (opening.width_m == 0.0) return nullptr;
  return {{"at_m", place_json(opening.at)},
          {"width_m", opening.width_m},
          {"height_m", opening.is_measured() ? Json(opening.height_m) : Json(nullptr)}};
}

void add_line(std::string& out, const Vec3& point_m, double metres_per_unit) {
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0) out += ' ';
    append_double(out, point_m[axis] / metres_per_unit);
  }
  out += '\n';
}

}  // namespace

std::string leak_text(const world::CompiledWorld& world, const std::string& way_file) {
  const bsp::Enclosure& enclosure = world.partition.enclosure;
  const bsp::Leak& leak = *enclosure.leak;
  std::string text;
  const Rows row{text, 12};
  row("leak", fmt::format("{} of {} occupants reach the void; the nearest to it:", enclosure.leaking.size(),
                          world.occupants.size()));
  const map::Occupant& occupant = world.occupants[leak.occupant];
  row("from", run::occupant_text(occupant) + " at " + run::place_text(occupant.position_m));
  row("leak path",
      fmt::format("{}, to {}", render::measure_text(leak.length_m), run::place_text(leak.way.back())));
  row("through", run::opening_text(leak.narrowest));
  if (!way_file.empty()) row("points", path_text(way_file));
  return text;
}

Json leak_json(const world::CompiledWorld& world) {
  const bsp::Enclosure& enclosure = world.partition.enclosure;
  if (!enclosure.leak) return nullptr;
  const bsp::Leak& leak = *enclosure.leak;
  Json way = Json::array();
  for (const Vec3& point : leak.way) way.push_back(place_json(point));
  Json leaking = Json::array();
  for (const std::size_t index : enclosure.leaking) leaking.push_back(occupant_json(world.occupants[index]));
  return {{"occupant", occupant_json(world.occupants[leak.occupant])},
          {"length_m", leak.length_m},
          {"way_m", way},
          {"opening", opening_json(leak.narrowest)},
          {"leaking", leaking}};
}

std::string way_points(const bsp::Leak& leak, double metres_per_unit) {
  std::string out;
  if (leak.way.empty()) return out;
  add_line(out, leak.way.front(), metres_per_unit);
  for (std::size_t i = 1; i < leak.way.size(); ++i) {
    const Vec3 step = leak.way[i] - leak.way[i - 1];
    const double pieces = std::clamp(std::ceil(step.norm() / kPointSpacing_m), 1.0, kMostPointsOnLine);
    for (double k = 1.0; k < pieces; k += 1.0)
      add_line(out, leak.way[i - 1] + k / pieces * step, metres_per_unit);
    add_line(out, leak.way[i], metres_per_unit);
  }
  return out;
}

}  // namespace hallway::cli
