// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <utility>

#include "base/file.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "compiled_map.hpp"
#include "console.hpp"
#include "mesh/export.hpp"
#include "output_file.hpp"
#include "run/pictures/map_export.hpp"
#include "sense/landmarks.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

struct ExportOptions {
  std::string map;
  std::string out;
  bool all = false;
  bool points = false;
  bool json = false;
};

/// Counts of what was written.
struct Written {
  std::vector<std::string> files{};
  std::size_t triangles = 0;
  std::size_t points = 0;
};

/// Throws Error{kUsage} for an ending that is not written.
void check_format(const ExportOptions& options) {
  const auto ending = run::model_ending(options.out);
  if (!ending) {
    refuse("--out takes a file that ends in .glb, .obj or .ply, not \"{}\"", printable(options.out));
  }
  if (options.points && *ending != ".ply") refuse("--points writes a .ply file");
}

/// The surface with the models that stand in the map; one that cannot be read is left out with a warning.
mesh::Model model_of(CompiledMap& compiled, bool all) {
  mesh::Model model = run::surface_model(compiled.world, all);
  std::vector<Error> faults;
  run::add_models(model, compiled.document, models_folder(compiled), faults);
  warn_of_models(compiled, faults, false);
  return model;
}

Written write_points(const ExportOptions& options, const map::Document& document, const map::World& brushes) {
  const std::vector<Vec3> points = sense::make_landmarks(document, brushes, csg::build_surface(brushes));
  if (points.empty()) {
    throw Error(ErrorCode::kBadInput, "has no points: neither `_points_per_m2` nor a hw_landmark_cloud",
                {.file = path_text(options.map)});
  }
  write_file_atomically(options.out, mesh::points_to_ply(points));
  return {.files = {options.out}, .points = points.size()};
}

int export_map(const ExportOptions& options) {
  check_format(options);
  check_output_file(options.out);
  CompiledMap compiled = compile_map({.file = options.map});
  run::check_replaces_no_model(options.out, compiled.document, models_folder(compiled));
  Written written;
  if (options.points) {
    written = write_points(options, compiled.document, compiled.world.brushes);
  } else {
    const mesh::Model model = model_of(compiled, options.all);
    if (model.triangles.empty()) {
      throw Error(ErrorCode::kBadInput, "has no faces to export", {.file = path_text(options.map)});
    }
    written = {.files = run::write_model(options.out, model), .triangles = model.triangles.size()};
  }
  if (options.json) {
    print_json({{"schema", "hallway.export/1"},
                {"status", 0},
                {"files", path_texts({written.files.begin(), written.files.end()})},
                {"triangles", written.triangles},
                {"points", written.points},
                {"warnings", compiled.warnings}});
    return 0;
  }
  const std::string what = options.points ? fmt::format("{} points", written.points)
                                          : fmt::format("{} triangles", written.triangles);
  print_result("{}: {}\n", path_text(options.out), what);
  return 0;
}

}  // namespace

void add_map_export_command(Command& group) {
  Command& command =
      group.command("export", "Write a map's surface and its models, or its points, for other programs");
  ExportOptions& options = command.runs(&export_map);
  command.argument("map", &options.map, "A .map file").required().value("MAP");
  add_shared(command, Shared::kOutFile, &options.out).required();
  command.flag("--all", &options.all, "Also the faces of a sealed map that nothing inside can see");
  command.flag("--points", &options.points, "The points that a point sensor can see, as .ply");
  add_shared(command, Shared::kJson, &options.json);
  command.footer("Example: hallway map export maps/office.map --out office.glb");
}

}  // namespace hallway::cli
