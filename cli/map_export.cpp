// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <utility>

#include "base/file.hpp"
#include "base/text.hpp"
#include "compiled_map.hpp"
#include "console.hpp"
#include "map_command.hpp"
#include "mesh/export.hpp"
#include "mesh/load.hpp"
#include "mesh/placement.hpp"
#include "render/colour.hpp"
#include "sense/landmarks.hpp"

namespace hallway::cli {
namespace {

namespace fs = std::filesystem;

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

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorCode::kUsage, message);
}

/// The ending of the output file, in lower case. Throws Error{kUsage} for one that is not written.
std::string format_of(const ExportOptions& options) {
  std::string ending = fs::path(options.out).extension().string();
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  if (ending != ".glb" && ending != ".obj" && ending != ".ply") {
    refuse(fmt::format("--out takes a file that ends in .glb, .obj or .ply, not \"{}\"",
                       printable(options.out)));
  }
  if (options.points && ending != ".ply") refuse("--points writes a .ply file");
  return ending;
}

mesh::Material material_of(const std::string& name) {
  const render::Rgb colour = render::material_colour(name);
  const auto channel = [](std::uint8_t value) { return static_cast<float>(value) / 255.0f; };
  return {.name = name, .base_colour = {channel(colour.r), channel(colour.g), channel(colour.b), 1.0f}};
}

/// The surface of a world as triangles, a material for each of the map's.
mesh::Model model_of(const world::CompiledWorld& world, bool all) {
  const csg::Surface& surface = world.partition.surface;
  const bool inside_only = !all && world.sealed();
  mesh::Model model;
  std::map<std::string, std::uint32_t> materials;
  std::vector<std::int64_t> index_of(surface.vertices.size(), -1);
  const auto vertex = [&](std::uint32_t index) {
    if (index_of[index] < 0) {
      index_of[index] = static_cast<std::int64_t>(model.vertices.size());
      model.vertices.push_back(surface.vertices[index]);
    }
    return static_cast<std::uint32_t>(index_of[index]);
  };
  for (std::size_t i = 0; i < surface.polygons.size(); ++i) {
    const csg::SurfacePolygon& polygon = surface.polygons[i];
    if (inside_only && !world.partition.inside[i]) continue;
    const std::string& name = world.brushes.solids[polygon.solid].faces[polygon.face].material;
    const auto [material, added] =
        materials.emplace(name, static_cast<std::uint32_t>(model.materials.size()));
    if (added) model.materials.push_back(material_of(printable(name)));
    for (const auto& corners : csg::triangulate(surface, polygon)) {
      model.triangles.push_back(
          {{vertex(corners[0]), vertex(corners[1]), vertex(corners[2])}, material->second});
    }
  }
  return model;
}

/// Adds the models that stand in the map; one that cannot be read is left out with a warning.
void add_models(mesh::Model& model, CompiledMap& compiled) {
  const fs::path folder = fs::absolute(compiled.document.file).parent_path();
  for (const mesh::Placement& placement : mesh::placements(compiled.document)) {
    try {
      mesh::Model one = mesh::load_model(mesh::model_path(placement, folder), folder);
      mesh::PlacedMesh placed = mesh::place(one, placement);
      one.vertices = std::move(placed.vertices);
      one.triangles = std::move(placed.triangles);
      mesh::append(model, std::move(one));
    } catch (const Error& error) {
      compiled.warnings.push_back(std::string(error.what()) + "; left out");
      print_warning(compiled.warnings.back());
    }
  }
}

Written write_model(const ExportOptions& options, const std::string& format, const mesh::Model& model) {
  Written written{.files = {options.out}, .triangles = model.triangles.size()};
  if (format == ".glb") write_file_atomically(options.out, mesh::to_glb(model));
  if (format == ".ply") write_file_atomically(options.out, mesh::to_ply(model));
  if (format == ".obj") {
    const fs::path library = fs::path(options.out).replace_extension(".mtl");
    check_output_file(library.string());
    const mesh::ObjFiles files = mesh::to_obj(model, library.filename().string());
    for (const mesh::ObjFiles::File& image : files.images) {
      const fs::path file = library.parent_path() / image.name;
      check_output_file(file.string());
      write_file_atomically(file, image.bytes);
      written.files.push_back(file.string());
    }
    write_file_atomically(library, files.mtl);
    write_file_atomically(options.out, files.obj);
    written.files.push_back(library.string());
  }
  return written;
}

Written write_points(const ExportOptions& options, const map::Document& document, const map::World& brushes) {
  const std::vector<Vec3> points = sense::make_landmarks(document, brushes, csg::build_surface(brushes));
  if (points.empty()) {
    throw Error(ErrorCode::kBadInput, "has no points: neither `_points_per_m2` nor a hw_landmark_cloud",
                {.file = printable(options.map, 4096)});
  }
  write_file_atomically(options.out, mesh::points_to_ply(points));
  return {.files = {options.out}, .points = points.size()};
}

int export_map(const ExportOptions& options) {
  const std::string format = format_of(options);
  check_output_file(options.out);
  CompiledMap compiled = compile_map({.file = options.map});
  Written written;
  if (options.points) {
    written = write_points(options, compiled.document, compiled.world.brushes);
  } else {
    mesh::Model model = model_of(compiled.world, options.all);
    add_models(model, compiled);
    if (model.triangles.empty()) {
      throw Error(ErrorCode::kBadInput, "has no faces to export", {.file = printable(options.map, 4096)});
    }
    written = write_model(options, format, model);
  }
  if (options.json) {
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    for (const std::string& file : written.files) files.push_back(printable(file, 4096));
    print_json({{"schema", "hallway.export/1"},
                {"status", 0},
                {"files", files},
                {"triangles", written.triangles},
                {"points", written.points},
                {"warnings", compiled.warnings}});
    return 0;
  }
  const std::string what = options.points ? fmt::format("{} points", written.points)
                                          : fmt::format("{} triangles", written.triangles);
  print_result(fmt::format("{}: {}\n", printable(options.out, 4096), what));
  return 0;
}

}  // namespace

void add_map_export_command(CLI::App& group, Action& chosen) {
  CLI::App* command = group.add_subcommand(
      "export", "Write a map's surface and its models, or its points, for other programs");
  const auto options = std::make_shared<ExportOptions>();
  command->add_option("map", options->map, "A .map file")->required()->type_name("MAP");
  command
      ->add_option("--out", options->out,
                   "File to write: .glb (y up), .obj with .mtl, or .ply (z up); metres")
      ->required()
      ->type_name("FILE");
  command->add_flag("--all", options->all, "Also the faces of a sealed map that nothing inside can see");
  command->add_flag("--points", options->points, "The points that a point sensor can see, as .ply");
  command->add_flag("--json", options->json, "Print one JSON document");
  command->footer("Example: hallway map export maps/office.map --out office.glb");
  command->callback([&chosen, options] { chosen = [options] { return export_map(*options); }; });
}

}  // namespace hallway::cli
