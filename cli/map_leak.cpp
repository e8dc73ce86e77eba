// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <utility>

#include "base/file.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "compiled_map.hpp"
#include "console.hpp"
#include "leak_report.hpp"
#include "output_file.hpp"
#include "renderer_option.hpp"
#include "run/pictures/pictures.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

struct LeakOptions {
  std::string map;
  std::string picture;
  std::string points;
  std::optional<std::string> renderer;
  bool json = false;
};

void write_outputs(const LeakOptions& options, render::Renderer renderer, CompiledMap& compiled) {
  const world::CompiledWorld& world = compiled.world;
  const auto& leak = world.partition.enclosure.leak;
  if (!options.points.empty() && leak) {
    write_file_atomically(options.points, way_points(*leak, world.brushes.metres_per_unit));
  }
  if (options.picture.empty()) return;
  std::vector<render::Surface> meshes = model_faces(compiled, false);
  const run::MapSubject subject{.world = world,
                                .title = fs::path(options.map).stem().string(),
                                .meshes = std::move(meshes),
                                .document = &compiled.document};
  write_file_atomically(options.picture,
                        run::draw_map_picture(subject, {}, {.leak = true}, {.renderer = renderer}));
}

std::string text_of(const LeakOptions& options, const world::CompiledWorld& world) {
  const std::string name = printable(fs::path(options.map).filename().string());
  if (world.partition.enclosure.leak) return name + ": leaks\n" + leak_text(world, options.points);
  if (!world.sealed()) return name + ": encloses nothing\n";
  return fmt::format("{}: sealed; {} occupants are inside\n", name,
                     world.occupants.size() - world.partition.enclosure.in_solid.size());
}

int leak(const LeakOptions& options) {
  const render::Renderer renderer = chosen_renderer(options.renderer);
  if (!options.picture.empty()) check_picture_file(options.picture);
  if (!options.points.empty()) check_output_file(options.points);
  CompiledMap compiled = compile_map({.file = options.map});
  const world::CompiledWorld& world = compiled.world;
  write_outputs(options, renderer, compiled);
  const int status = world.sealed() ? 0 : 1;
  if (options.json) {
    print_json({{"schema", "hallway.leak/1"},
                {"status", status},
                {"map", path_text(options.map)},
                {"sealed", world.sealed()},
                {"leak", leak_json(world)},
                {"warnings", compiled.warnings}});
  } else {
    print_result(text_of(options, world));
  }
  return status;
}

}  // namespace

void add_map_leak_command(Command& group) {
  Command& command = group.command("leak", "Show the leak path from inside the map to the outside");
  LeakOptions& options = command.runs(&leak);
  command.argument("map", &options.map, "A .map file").required().value("MAP");
  add_shared(command, Shared::kPicture, &options.picture);
  command.option("--pts", &options.points, "File to write the leak path to, as Quake editors read it")
      .value("FILE");
  add_shared(command, Shared::kJson, &options.json);
  add_renderer_option(command, options.renderer);
  command.footer(
      "Status 1 if the map leaks, 0 if it is sealed.\n"
      "Example: hallway map leak maps/office.map --picture leak.png");
}

}  // namespace hallway::cli
