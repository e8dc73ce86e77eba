// SPDX-License-Identifier: MIT
#include "run/pictures/map_export.hpp"

#include <cstdint>
#include <map>
#include <utility>

#include "base/file.hpp"
#include "base/text.hpp"
#include "csg/surface.hpp"
#include "mesh/export.hpp"
#include "mesh/load.hpp"
#include "mesh/placement.hpp"
#include "render/colour.hpp"

namespace hallway::run {
namespace {

namespace fs = std::filesystem;

mesh::Material material_of(const std::string& name) {
  const render::Rgb colour = render::material_colour(name);
  const auto channel = [](std::uint8_t value) { return static_cast<float>(value) / 255.0f; };
  return {.name = name, .base_colour = {channel(colour.r), channel(colour.g), channel(colour.b), 1.0f}};
}

/// The library and the images first: an OBJ that is there is whole.
std::vector<std::string> write_obj(const std::string& out, const mesh::Model& model) {
  std::vector<std::string> written{out};
  const fs::path library = fs::path(out).replace_extension(".mtl");
  const mesh::ObjFiles files = mesh::to_obj(model, library.filename().string());
  for (const mesh::ObjFiles::File& image : files.images) {
    const fs::path file = library.parent_path() / image.name;
    write_file_atomically(file, image.bytes);
    written.push_back(file.string());
  }
  write_file_atomically(library, files.mtl);
  write_file_atomically(out, files.obj);
  written.push_back(library.string());
  return written;
}

}  // namespace

std::optional<std::string> model_ending(const std::string& file) {
  std::string ending = fs::path(file).extension().string();
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  if (ending != ".glb" && ending != ".obj" && ending != ".ply") return std::nullopt;
  return ending;
}

mesh::Model surface_model(const world::CompiledWorld& world, bool all) {
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

void add_models(mesh::Model& model, const map::Document& document, const fs::path& folder,
                std::vector<Error>& faults) {
  for (const mesh::Placement& placement : mesh::placements(document)) {
    try {
      mesh::Model one = mesh::load_model(mesh::model_path(placement, folder), folder);
      mesh::PlacedMesh placed = mesh::place(one, placement);
      one.vertices = std::move(placed.vertices);
      one.triangles = std::move(placed.triangles);
      mesh::append(model, std::move(one));
    } catch (const Error& error) {
      faults.push_back(error);
    }
  }
}

void check_replaces_no_model(const std::string& file, const map::Document& document, const fs::path& folder) {
  std::error_code none;
  for (const mesh::Placement& placement : mesh::placements(document)) {
    if (fs::equivalent(mesh::model_path(placement, folder), file, none))
      throw Error(ErrorCode::kUsage, "is a model of the map, which is not replaced by the map",
                  {.file = printable(file, 4096)});
  }
}

std::vector<std::string> write_model(const std::string& file, const mesh::Model& model) {
  const auto ending = model_ending(file);
  if (!ending) throw Error(ErrorCode::kInternal, "no ending of a model file");
  if (*ending == ".obj") return write_obj(file, model);
  write_file_atomically(file, *ending == ".glb" ? mesh::to_glb(model) : mesh::to_ply(model));
  return {file};
}

}  // namespace hallway::run
