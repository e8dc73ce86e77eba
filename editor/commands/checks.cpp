// SPDX-License-Identifier: MIT
//
// What is wrong with the map, and what it looks like.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <set>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/commands/making.hpp"
#include "editor/commands/topics.hpp"
#include "editor/selection.hpp"
#include "editor/shapes.hpp"
#include "editor/validate.hpp"
#include "map/writer.hpp"
#include "render/map_layers.hpp"
#include "run/pictures/map_view.hpp"
#include "run/pictures/pictures.hpp"
#include "world/compiled_world.hpp"

namespace hallway::editor {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::array kIds{ArgSpec{"id", ArgKind::kText, "only faults of that id, such as `bad-brush`"}};
constexpr std::array kPicture{
    ArgSpec{"picture", ArgKind::kFile, "a PNG file to write: a plan with the leak path"}};
constexpr std::array kRender{
    ArgSpec{"file", ArgKind::kFile, "a PNG file to write"}.needed(),
    ArgSpec{"view", ArgKind::kChoice, "like a plan, or from a viewpoint", "top", "top perspective"},
    ArgSpec{"eye", ArgKind::kPlace, "perspective: from where [what shows everything]"},
    ArgSpec{"target", ArgKind::kPlace, "perspective: the place looked at"},
    ArgSpec{"cut", ArgKind::kLength, "cut away what is above this height [what opens a building]"},
    ArgSpec{"width", ArgKind::kWhole, "pixels", "1280"}.within(16, 16384),
    ArgSpec{"height", ArgKind::kWhole, "pixels", "800"}.within(16, 16384),
    ArgSpec{"show", ArgKind::kChoice, "drawn over the map, or instead of its faces", "",
            "portals leak wireframe bsp-depth"}};

std::string line_of(const State& state, const Fault& fault) {
  std::string text = fault.severity == map::Severity::kError ? "error: " : "warning: ";
  if (const auto thing = find(state, fault.thing)) text += describe(state, *thing) + ": ";
  text += fmt::format("{} [{}]", fault.message, fault.id);
  if (fault.line > 0) text += fmt::format(" (line {})", fault.line);
  return text;
}

std::vector<Fault> faults_of(const Edit& edit, const Arguments& arguments) {
  auto faults = validate(edit.state, edit.file);
  if (arguments.has("id")) {
    const std::vector<std::string> ids = fault_ids();
    if (const std::string& id = arguments.text("id"); std::ranges::find(ids, id) == ids.end())
      refuse("id: there is no finding \"{}\"{}", printable(id), suggestion(id, ids));
  }
  if (arguments.has("id"))
    std::erase_if(faults, [&](const Fault& fault) { return fault.id != arguments.text("id"); });
  return faults;
}

void validate_map(Edit& edit, const Arguments& arguments) {
  const auto faults = faults_of(edit, arguments);
  edit.report.data["faults"] = Json::array();
  for (const Fault& fault : faults) {
    edit.report.say(line_of(edit.state, fault));
    if (!fault.fix.empty()) edit.report.say("  fix: " + printable(fault.fix));
    edit.report.data["faults"].push_back(
        {{"id", fault.id},
         {"severity", fault.severity == map::Severity::kError ? "error" : "warning"},
         {"thing", fault.thing},
         {"line", fault.line},
         {"message", fault.message},
         {"fix", fault.fix}});
    if (fault.severity == map::Severity::kError) edit.report.status = 1;
  }
  if (faults.empty()) edit.report.say("nothing is wrong");
}

/// One fix after the other, each followed by another look: a fix may mend, or bring to light, what is next.
void fix_map(Edit& edit, const Arguments& arguments) {
  constexpr int kMostFixes = 1000;
  std::set<std::string> tried;
  edit.report.data["fixed"] = Json::array();
  for (int i = 0; i < kMostFixes; ++i) {
    const auto faults = faults_of(edit, arguments);
    const auto next = std::ranges::find_if(
        faults, [&](const Fault& fault) { return !fault.fix.empty() && !tried.contains(fault.fix); });
    if (next == faults.end()) break;
    tried.insert(next->fix);
    const Call call = parse_line(next->fix, units_of(edit.state));
    Edit one{edit.state, edit.file};
    std::get<EditFunction>(call.command->run)(one, call.arguments);
    edit.state = std::move(one.state);
    edit.report.say("{}: {}", next->id, printable(next->fix));
    edit.report.data["fixed"].push_back({{"id", next->id}, {"command", next->fix}});
  }
  const auto left = faults_of(edit, arguments).size();
  edit.report.data["left"] = left;
  edit.report.say("{} fixed, {} left for you", edit.report.data["fixed"].size(), left);
}

world::CompiledWorld compiled(const Edit& edit, map::Document& document) {
  document = document_of(edit.state, edit.file);
  world::Settings settings;
  settings.level.reset();
  return world::compile(document, settings);
}

void compile_map(Edit& edit, const Arguments&) {
  map::Document document;
  const world::CompiledWorld world = compiled(edit, document);
  const auto& tree = world.partition.tree;
  edit.report.data["sealed"] = world.sealed();
  edit.report.data["brushes"] = world.brushes.solids.size();
  edit.report.data["polygons"] = world.partition.surface.polygons.size();
  edit.report.data["clusters"] = tree.clusters;
  edit.report.data["portals"] = world.partition.portals.portals.size();
  edit.report.say("{}; {} brushes, {} polygons, {} clusters, {} portals",
                  world.sealed()                   ? "sealed"
                  : world.partition.enclosure.leak ? "leaks"
                                                   : "encloses nothing",
                  world.brushes.solids.size(), world.partition.surface.polygons.size(), tree.clusters,
                  world.partition.portals.portals.size());
  if (!world.sealed()) edit.report.status = 1;
}

/// A picture shows the map without what is hidden.
std::string picture_of(const Edit& edit, const sim::PictureSpec& spec, const run::MapView& view) {
  const Edit shown{without_hidden(edit.state), edit.file};
  map::Document document;
  const world::CompiledWorld world = compiled(shown, document);
  std::vector<Error> faults;
  const run::MapSubject subject{
      .world = world,
      .title = fs::path(edit.file).stem().string(),
      .meshes = run::model_faces(document, fs::path(edit.file).parent_path(), faults),
      .document = &document};
  return run::draw_map_picture(subject, spec, view, {.renderer = edit.renderer});
}

/// The door or window whose cut an opening is in.
std::optional<Thing> cut_at(const Edit& edit, const bsp::Opening& opening) {
  const Vec3 at = opening.at / edit.metres_per_unit();
  for (std::size_t e = 0; e < edit.state.entities.size(); ++e) {
    const EntityItem& entity = *edit.state.entities[e];
    if (!is_opening(entity)) continue;
    for (const BrushItem& brush : entity.brushes) {
      constexpr double kRounding = 0.01;  // map units
      const auto is_behind = [&](const map::Face& face) {
        const auto plane = plane_of(face);
        return plane && plane->distance(at) <= kRounding;
      };
      if (std::ranges::all_of(brush.brush->faces, is_behind)) return Thing{e, {}};
    }
  }
  return std::nullopt;
}

void say_leak(Edit& edit, const map::Occupant& occupant, const bsp::Leak& leak) {
  const Thing who{static_cast<std::size_t>(occupant.entity), {}};
  const bsp::Opening& opening = leak.narrowest;
  std::string line = fmt::format("leaks: {} reaches the void after {}, through {}", describe(edit.state, who),
                                 render::measure_text(leak.length_m), run::opening_text(opening));
  edit.report.data["occupant"] = id_of(edit.state, who);
  edit.report.data["length_m"] = leak.length_m;
  if (opening.is_measured()) {
    edit.report.data["opening"] = {{"at_m", {opening.at.x(), opening.at.y(), opening.at.z()}},
                                   {"width_m", opening.width_m},
                                   {"height_m", opening.height_m}};
    if (const auto cut = cut_at(edit, opening)) {
      line += fmt::format(", which is {}", describe(edit.state, *cut));
      edit.report.data["opening"]["thing"] = id_of(edit.state, *cut);
    }
  }
  edit.report.say(std::move(line));
  edit.report.status = 1;
}

void show_leak(Edit& edit, const Arguments& arguments) {
  if (arguments.has("picture")) run::check_picture_name(arguments.text("picture"));
  map::Document document;
  const world::CompiledWorld world = compiled(edit, document);
  const auto& leak = world.partition.enclosure.leak;
  edit.report.data["sealed"] = world.sealed();
  if (leak) {
    say_leak(edit, world.occupants[leak->occupant], *leak);
  } else {
    edit.report.say(world.sealed() ? "sealed"
                                   : "encloses nothing: there is no start, light or other occupant inside");
    edit.report.status = world.sealed() ? 0 : 1;
  }
  if (arguments.has("picture"))
    write_file_atomically(arguments.text("picture"), picture_of(edit, {}, {.leak = true}));
}

void render_map(Edit& edit, const Arguments& arguments) {
  run::check_picture_name(arguments.text("file"));
  sim::PictureSpec spec;
  spec.file = arguments.text("file");
  spec.view = arguments.text("view") == "top" ? sim::PictureView::kTop : sim::PictureView::kPerspective;
  spec.width_px = static_cast<int>(arguments.whole("width"));
  spec.height_px = static_cast<int>(arguments.whole("height"));
  if (arguments.has("cut")) spec.cut_z_m = arguments.number("cut");
  if (arguments.has("eye") != arguments.has("target")) refuse("render: eye and target are given together");
  if (arguments.has("eye")) {
    if (spec.view == sim::PictureView::kTop) refuse("render: eye and target belong to view=perspective");
    spec.eye_m = arguments.place("eye");
    spec.target_m = arguments.place("target");
  }
  const std::string show = arguments.text_or_empty("show");
  const run::MapView view{.portals = show == "portals",
                          .leak = show == "leak",
                          .wireframe = show == "wireframe",
                          .bsp_depth = show == "bsp-depth"};
  write_file_atomically(arguments.text("file"), picture_of(edit, spec, view));
  edit.report.data["file"] = arguments.text("file");
  edit.report.say("drew {}", printable(arguments.text("file")));
}

constexpr std::array kChecksCommands{
    CommandSpec{.name = "validate",
                .summary = "list faults, and the commands that fix them",
                .details = "Status 1 if there is an error.",
                .arguments = kIds,
                .example = "validate",
                .run = &validate_map},
    CommandSpec{.name = "fix",
                .summary = "run the commands that `validate` proposes",
                .arguments = kIds,
                .example = "fix",
                .run = &fix_map},
    CommandSpec{.name = "leak",
                .summary = "show the leak path on which something reaches the void outside",
                .details =
                    "Names the thing that reaches the void, and the hole by which it does: size and middle. "
                    "Status 1 if the map leaks.",
                .arguments = kPicture,
                .example = "leak",
                .run = &show_leak},
    CommandSpec{.name = "compile",
                .summary = "compile the map as it is now and count what comes of it",
                .details = "Status 1 if it is not sealed.",
                .example = "compile",
                .run = &compile_map},
    CommandSpec{.name = "render",
                .summary = "draw the map as it is now, without what is hidden",
                .arguments = kRender,
                .example = "render plan.png",
                .before = "entity light at 1,1,1",
                .run = &render_map},
};

}  // namespace

std::span<const CommandSpec> check_commands() {
  return kChecksCommands;
}

}  // namespace hallway::editor
