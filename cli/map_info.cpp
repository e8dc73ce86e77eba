// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>

#include "base/text.hpp"
#include "command.hpp"
#include "compiled_map.hpp"
#include "console.hpp"
#include "map/world.hpp"
#include "sense/landmarks.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

using Counts = std::map<std::string, std::size_t>;

/// What a map holds.
struct Facts {
  Counts classes;           ///< entities
  Counts roles;             ///< brushes in the world
  Counts materials;         ///< faces in the world
  std::size_t brushes = 0;  ///< in the file
  std::size_t bad_brushes = 0;
  std::vector<map::LeftOutCount> left_out;
  Box bounds;
  double metres_per_unit = 0.0;
  std::size_t points = 0;           ///< for point sensors
  std::vector<std::string> starts;  ///< names of the robot starts; empty for the unnamed one
};

const char* role_name(map::BrushRole role) {
  switch (role) {
    case map::BrushRole::kAdd:
      return "add";
    case map::BrushRole::kDetail:
      return "detail";
    case map::BrushRole::kSubtract:
      return "subtract";
    case map::BrushRole::kHint:
      return "hint";
  }
  return "";
}

Facts facts_of(const map::Document& document) {
  Facts facts;
  for (const map::Entity& entity : document.entities) {
    ++facts.classes[printable(entity.classname())];
    facts.brushes += entity.brushes.size();
  }
  const map::World world = map::build_world(document);
  for (const map::Solid& solid : world.solids) {
    ++facts.roles[role_name(solid.role)];
    for (const map::SolidFace& face : solid.faces) ++facts.materials[printable(face.material)];
  }
  facts.bad_brushes = world.problems.size();
  facts.left_out = world.left_out;
  facts.bounds = world.bounds;
  facts.metres_per_unit = world.metres_per_unit;
  facts.points = sense::make_landmarks(document, world, csg::build_surface(world)).size();
  for (const map::Entity& entity : document.entities) {
    if (entity.classname() == "hw_robot_start") facts.starts.push_back(printable(entity.value("name"), 60));
  }
  return facts;
}

// ---- text -----------------------------------------------------------------------------------------------------------

/// "12 a, 3 b, 3 c and 40 others", the most frequent first.
std::string list_of(const Counts& counts, std::size_t most) {
  std::vector<std::pair<std::string, std::size_t>> sorted(counts.begin(), counts.end());
  std::ranges::stable_sort(sorted, [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (std::size_t i = 0; i < sorted.size() && i < most; ++i) {
    text += fmt::format("{}{} {}", i == 0 ? "" : ", ", sorted[i].second,
                        sorted[i].first.empty() ? "without a class" : sorted[i].first);
  }
  if (sorted.size() > most) text += fmt::format(" and {} more kinds", sorted.size() - most);
  return text.empty() ? "none" : text;
}

std::string bounds_text(const Box& box) {
  if (box.isEmpty()) return "none";
  const Vec3 size = box.sizes();
  return fmt::format("{:.2f} x {:.2f} x {:.2f} m, from ({:.2f}, {:.2f}, {:.2f}) to ({:.2f}, {:.2f}, {:.2f})",
                     size.x(), size.y(), size.z(), box.min().x(), box.min().y(), box.min().z(), box.max().x(),
                     box.max().y(), box.max().z());
}

std::string starts_text(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names)
    text += (text.empty() ? "" : ", ") + (name.empty() ? "one without a name" : name);
  return text;
}

std::string text_of(const std::string& map, const Facts& facts) {
  constexpr std::size_t kMostNames = 12;
  Counts left_out;
  for (const map::LeftOutCount& entry : facts.left_out)
    left_out[std::string(map::to_string(entry.reason))] = entry.brushes;
  std::string text = printable(fs::path(map).filename().string()) + "\n";
  const Rows row{text, 12};
  std::size_t entities = 0;
  for (const auto& [name, count] : facts.classes) entities += count;
  row("entities", fmt::format("{}: {}", entities, list_of(facts.classes, kMostNames)));
  row("brushes", fmt::format("{}: {}", facts.brushes, list_of(facts.roles, kMostNames)));
  if (!left_out.empty()) row("left out", list_of(left_out, kMostNames));
  if (facts.bad_brushes > 0) row("no solids", fmt::to_string(facts.bad_brushes));
  row("materials", fmt::format("{}: {} faces", facts.materials.size(), list_of(facts.materials, kMostNames)));
  if (!facts.starts.empty()) row("starts", starts_text(facts.starts));
  row("bounds", bounds_text(facts.bounds));
  row("scale", fmt::format("{} m per unit", format_double(facts.metres_per_unit)));
  row("points", fmt::to_string(facts.points));
  return text;
}

// ---- JSON -----------------------------------------------------------------------------------------------------------

Json json_of(const Counts& counts) {
  Json out = Json::object();
  for (const auto& [name, count] : counts) out[name] = count;
  return out;
}

Json document_of(const std::string& map, const Facts& facts) {
  Json left_out = Json::object();
  for (const map::LeftOutCount& entry : facts.left_out)
    left_out[std::string(map::to_string(entry.reason))] = entry.brushes;
  Json bounds = nullptr;
  if (!facts.bounds.isEmpty())
    bounds = {{"low", place_json(facts.bounds.min())}, {"high", place_json(facts.bounds.max())}};
  return {{"schema", "hallway.map/1"},
          {"status", 0},
          {"map", path_text(map)},
          {"entities", json_of(facts.classes)},
          {"brushes",
           {{"in_file", facts.brushes},
            {"roles", json_of(facts.roles)},
            {"left_out", left_out},
            {"no_solids", facts.bad_brushes}}},
          {"materials", json_of(facts.materials)},
          {"robot_starts", facts.starts},
          {"bounds_m", bounds},
          {"metres_per_unit", facts.metres_per_unit},
          {"points", facts.points}};
}

struct InfoOptions {
  std::string map;
  bool json = false;
};

int show_info(const InfoOptions& options) {
  const Facts facts = facts_of(load_map(options.map));
  if (options.json) {
    print_json(document_of(options.map, facts));
  } else {
    print_result(text_of(options.map, facts));
  }
  return 0;
}

}  // namespace

void add_map_info_command(Command& group) {
  Command& command = group.command("info", "List what is in a map");
  InfoOptions& options = command.runs(&show_info);
  command.argument("map", &options.map, "A .map file").required().value("MAP");
  add_shared(command, Shared::kJson, &options.json);
  command.footer("Example: hallway map info maps/office.map");
}

}  // namespace hallway::cli
