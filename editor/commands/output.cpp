// SPDX-License-Identifier: MIT
//
// Plans and models of the map for other programs, and other maps for this one.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/clipboard.hpp"
#include "editor/commands/making.hpp"
#include "editor/commands/topics.hpp"
#include "editor/plan.hpp"
#include "editor/selection.hpp"
#include "editor/transform.hpp"
#include "map/reader.hpp"
#include "mesh/placement.hpp"
#include "run/pictures/map_export.hpp"
#include "world/compiled_world.hpp"

namespace hallway::editor {
namespace {

namespace fs = std::filesystem;

constexpr std::array kPrint{
    ArgSpec{"file", ArgKind::kFile, "a file to write that ends in .svg or .pdf"}.needed(),
    ArgSpec{"height", ArgKind::kLength, "where the building is cut; what is lower is seen from there", "1.2"},
    ArgSpec{"scale", ArgKind::kNumber, "50 means 1:50: a metre is 20 mm long", "50"}.within(0.1, 1e6),
    ArgSpec{"paper", ArgKind::kChoice, "its size", "a4", "a4 a3 a2 a1 letter"},
    ArgSpec{"orientation", ArgKind::kChoice, "how the paper lies", "auto", "landscape portrait auto"},
    ArgSpec{"dimensions", ArgKind::kChoice, "the overall size, and rooms that have a name from wall to wall",
            "on", "on off"},
    ArgSpec{"grid", ArgKind::kLength, "lines so far apart, through the origin [none]"}.within(1e-3, 1e6)};
constexpr std::array kExport{
    ArgSpec{"file", ArgKind::kFile, "a file to write that ends in .glb, .obj or .ply"}.needed(),
    ArgSpec{"all", ArgKind::kChoice, "also the faces of a sealed map that nothing inside can see", "off",
            "on off"}};
constexpr std::array kImport{
    ArgSpec{"file", ArgKind::kFile, "another map"}.needed(),
    ArgSpec{"name", ArgKind::kName, "of the group that its loose brushes become [the file's name]"},
    ArgSpec{"at", ArgKind::kPlace, "where the other map's origin comes to be", "0,0,0"}};

std::string lower_ending(const std::string& file) {
  std::string ending = fs::path(file).extension().string();
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return ending;
}

void print_plan(Edit& edit, const Arguments& arguments) {
  const std::string& file = arguments.text("file");
  const std::string ending = lower_ending(file);
  if (ending != ".svg" && ending != ".pdf")
    refuse("file: a plan is a file that ends in .svg or .pdf, not \"{}\"", printable(file));
  const FloorPlan plan = make_plan(without_hidden(edit.state), edit.file, arguments.number("height"));
  const PlanPaper paper{.name = arguments.text("paper"),
                        .orientation = arguments.text("orientation"),
                        .scale = arguments.number("scale"),
                        .dimensions = arguments.text("dimensions") == "on",
                        .grid_m = arguments.has("grid") ? arguments.number("grid") : 0.0};
  const Sheet sheet = draw_plan(plan, paper);
  write_file_atomically(file, ending == ".svg" ? to_svg(sheet) : to_pdf(sheet));
  edit.report.data["file"] = file;
  edit.report.data["width_mm"] = sheet.width_mm;
  edit.report.data["height_mm"] = sheet.height_mm;
  edit.report.data["solid_m2"] = plan.section.area_m2();
  edit.report.say("drew {}: {} {} at 1:{}, {:.2f} m² solid at {} m", printable(file), paper.name,
                  sheet.width_mm > sheet.height_mm ? "landscape" : "portrait", sheet_number(paper.scale),
                  plan.section.area_m2(), sheet_number(plan.height_m));
  for (const std::string& note : plan.notes) edit.report.note(note);
}

void export_model(Edit& edit, const Arguments& arguments) {
  const std::string& file = arguments.text("file");
  if (!run::model_ending(file)) {
    refuse("file: a model is a file that ends in .glb, .obj or .ply, not \"{}\"", printable(file));
  }
  const map::Document document = document_of(edit.state, edit.file);
  run::check_replaces_no_model(file, document, fs::absolute(edit.file).parent_path());
  world::Settings settings;
  settings.level.reset();
  mesh::Model model = run::surface_model(world::compile(document, settings), arguments.text("all") == "on");
  std::vector<Error> faults;
  run::add_models(model, document, fs::absolute(edit.file).parent_path(), faults);
  if (model.triangles.empty()) refuse("export: the map has no faces");
  const auto files = run::write_model(file, model);
  edit.report.data["files"] = files;
  edit.report.data["triangles"] = model.triangles.size();
  std::string names = printable(files.front());
  for (std::size_t i = 1; i < files.size(); ++i) names += ", " + printable(files[i]);
  edit.report.say("wrote {}: {} triangles", names, model.triangles.size());
  for (const Error& fault : faults) edit.report.note(std::string(fault.what()) + "; left out");
}

/// A text with what a name cannot have left out.
std::string as_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool bad = static_cast<unsigned char>(c) <= ' ' ||
                     std::string_view("*?,=#\";+|'\\").find(c) != std::string_view::npos;
    name += bad ? '_' : c;
  }
  if (name.empty() || parse_double(name)) name = "map-" + name;
  return printable(name);
}

std::string name_in(const State& source, const std::string& wanted) {
  std::set<std::string> taken;
  for (const auto& entity : source.entities) taken.insert(name_of(*entity));
  std::string name = wanted;
  for (int i = 2; taken.contains(name); ++i) name = wanted + "-" + std::to_string(i);
  return name;
}

/// A map that is to be added to another one: worldspawn's brushes as a group, editors' layers as groups.
class Guest {
 public:
  Guest(const std::string& file, const std::string& name) {
    const map::Document document = map::load(file);
    if (document.worldspawn() == nullptr) {
      throw Error(ErrorCode::kBadInput, "holds no map: it has no entity of class worldspawn",
                  {.file = printable(file, 4096)});
    }
    state_ = state_of(document);
    for (std::size_t e = 0; e < state_.entities.size(); ++e) layer_to_group(e);
    for (std::size_t e = 0; e < state_.entities.size(); ++e) join_layer(e);
    gather_brushes(name);
  }

  State take() { return std::move(state_); }

 private:
  void layer_to_group(std::size_t index) {
    const EntityItem& entity = *state_.entities[index];
    if (entity.classname() != "func_group" || entity.value("_tb_type") != "_tb_layer") return;
    const std::string number = std::to_string(next_group_number(state_));
    layers_.emplace(entity.value("_tb_id"), number);
    set_key(state_, index, "_tb_type", "_tb_group");
    set_key(state_, index, "_tb_id", number);
    for (const char* key : {"_tb_layer_sort_index", "_tb_layer_hidden", "_tb_layer_locked"})
      set_key(state_, index, key, "");
  }

  void join_layer(std::size_t index) {
    const std::string layer = state_.entities[index]->value("_tb_layer");
    if (layer.empty()) return;
    set_key(state_, index, "_tb_layer", "");
    const auto found = layers_.find(layer);
    if (found != layers_.end() && state_.entities[index]->value("_tb_group").empty())
      set_key(state_, index, "_tb_group", found->second);
  }

  void gather_brushes(const std::string& name) {
    std::vector<Thing> loose = all_things(state_);
    std::erase_if(loose, [](const Thing& thing) { return !thing.brush; });
    if (loose.empty()) return;
    map::Entity group = new_group(state_, name_in(state_, name));
    for (const Thing& thing : loose) group.brushes.push_back(brush_at(state_, thing));
    remove(state_, loose);
    add_entity(state_, std::move(group));
  }

  State state_;
  std::map<std::string, std::string> layers_;  ///< numbers of the groups that layers have become
};

/// Names of models count from the folder of their map.
void follow_models(Edit& edit, State& source, const std::string& file) {
  const fs::path from = fs::absolute(file).lexically_normal().parent_path();
  const fs::path to = fs::absolute(edit.file).lexically_normal().parent_path();
  for (std::size_t e = 0; from != to && e < source.entities.size(); ++e) {
    const std::string* model = source.entities[e]->head->find("model");
    if (source.entities[e]->classname() != "hw_mesh" || model == nullptr || fs::path(*model).is_absolute())
      continue;
    const std::string now = (from / *model).lexically_relative(to).generic_string();
    if (now.starts_with("..")) {
      edit.report.note(
          fmt::format("the model \"{}\" is not in the folder of this map; put it there", printable(*model)));
    } else {
      set_key(source, e, "model", now);
    }
  }
}

void import_map(Edit& edit, const Arguments& arguments) {
  worldspawn(edit.state);
  const std::string& file = arguments.text("file");
  const std::string name = arguments.text_or_empty("name");
  check_new_name(edit.state, name);
  State source = Guest(file, name.empty() ? as_name(fs::path(file).stem().string()) : name).take();
  const auto things = all_things(source);
  if (things.empty()) refuse("import: there is nothing in {} but an empty world", printable(file));
  follow_models(edit, source, file);
  const Copies copies = add_copies(edit, source, things);
  for (const std::string& note : copies.notes) edit.report.note(note);
  const auto made = things_of(edit.state, copies.ids);
  const double from = units_of(source).metres_per_unit, to = edit.metres_per_unit();
  if (from != to) transform_things(edit, made, change_units(from, to));
  const Vec3 way = edit.units(arguments.place("at"));
  if (!way.isZero(0.0)) transform_things(edit, made, move_by(way));
  say_made(edit, copies.ids);
}

constexpr std::array kOutputCommands{
    CommandSpec{
        .name = "print",
        .summary = "draw a floor plan to scale, as SVG or PDF",
        .details =
            "What is solid at the height is filled; edges of what is lower are drawn thin, as one sees them "
            "from above. Robot start, paths (dashed) and lights are shown where no floor or ceiling is "
            "between "
            "them and the cut, groups with their names. y points up, to the north. What is hidden is left "
            "out. "
            "A plan that does not fit on the paper is refused.",
        .arguments = kPrint,
        .example = "print plan.svg scale=100",
        .before = "room from 0,0 to 4,3 height 2.7 name=kitchen\ndoor in kitchen side south at 1.5",
        .run = &print_plan},
    CommandSpec{.name = "export",
                .summary = "write the map as it is now as a model for other programs",
                .details =
                    "The same as `hallway map export`: binary glTF (y up), OBJ with its materials or PLY "
                    "(z up), metres. Without `all`, faces of a sealed map that nothing inside can see "
                    "are left out.",
                .arguments = kExport,
                .example = "export house.glb",
                .before = "box from 0,0 to 2,1,1 name=table",
                .run = &export_model},
    CommandSpec{
        .name = "import",
        .summary = "add another map's brushes and entities to this one",
        .details =
            "They keep their size in metres. Brushes of the other map's world become a group; names that are "
            "taken get a number behind. Keys of its world are not taken over, and its robot start without a "
            "name only where this map has none; starts with names are. What it subtracts is subtracted from "
            "whatever is there.",
        .arguments = kImport,
        .example = "import kitchen.map at 4,0",
        .run = &import_map},
};

}  // namespace

std::span<const CommandSpec> output_commands() {
  return kOutputCommands;
}

}  // namespace hallway::editor
