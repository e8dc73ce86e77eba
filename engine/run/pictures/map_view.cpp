// SPDX-License-Identifier: MIT
#include "run/pictures/map_view.hpp"

#include <fmt/format.h>

#include <iterator>
#include <map>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "bsp/point_location.hpp"
#include "mesh/load.hpp"
#include "mesh/placement.hpp"
#include "render/map_layers.hpp"

namespace hallway::run {
namespace {

std::vector<bool> clusters_seen_from(const world::CompiledWorld& world, const Vec3& place) {
  if (!world.visible) {
    throw Error(ErrorCode::kBadInput,
                "the map leaks, so nothing is known of what can see what; `hallway map leak` shows where");
  }
  const std::int32_t cluster = bsp::cluster_at(world.partition.tree, place);
  if (cluster < 0) {
    throw Error(ErrorCode::kBadInput,
                fmt::format("the place {} is in solid or outside of the map", place_text(place)));
  }
  std::vector<bool> seen(world.visible->clusters(), false);
  for (const std::uint32_t other : world.visible->visible_from(static_cast<std::uint32_t>(cluster))) {
    seen[other] = true;
  }
  return seen;
}

void add_sight(render::Picture& picture, const world::CompiledWorld& world, const Vec3& place,
               render::Faces faces) {
  const std::vector<bool> seen = clusters_seen_from(world, place);
  picture.surfaces = render::map_surfaces(world.brushes, world.partition, faces,
                                          render::sight_colours(world.partition.tree, seen));
  render::add_sight_legend(picture, seen);
  picture.markers.push_back({.positions = {place},
                             .shape = render::MarkerShape::kDiamond,
                             .colour = render::palette::kError,
                             .size_px = 15.0,
                             .label = "viewpoint " + place_text(place)});
}

void add_faces(render::Picture& picture, const world::CompiledWorld& world, const MapView& view,
               render::Faces faces) {
  const bsp::Tree& tree = world.partition.tree;
  if (view.pvs_from_m) {
    add_sight(picture, world, *view.pvs_from_m, faces);
  } else if (view.bsp_depth) {
    picture.surfaces =
        render::map_surfaces(world.brushes, world.partition, faces, render::depth_colours(tree));
    render::add_depth_legend(picture, tree);
  } else {
    picture.surfaces = render::map_surfaces(world.brushes, world.partition, faces);
  }
  if (!view.wireframe) return;
  picture.surfaces.clear();
  render::add_wireframe(picture, world.partition.surface, world.partition.inside, faces);
}

/// A model whose images became textures.
struct ModelLook {
  mesh::Model model;
  render::Textures textures;
};

ModelLook load_look(const std::filesystem::path& file, const std::filesystem::path& folder) {
  ModelLook look{mesh::load_model(file, folder), {}};
  look.textures = render::model_textures(std::exchange(look.model.images, {}));
  return look;
}

}  // namespace

void add_map(render::Picture& picture, const world::CompiledWorld& world, const MapView& view,
             render::Faces faces, const std::vector<render::Surface>& models) {
  add_faces(picture, world, view, faces);
  if (view.portals) render::add_portals(picture, world.partition.portals);
  const auto& leak = world.partition.enclosure.leak;
  if (view.leak && leak) render::add_leak(picture, *leak, occupant_text(world.occupants[leak->occupant]));
  if (!view.wireframe) picture.surfaces.insert(picture.surfaces.end(), models.begin(), models.end());
}

std::vector<render::Surface> model_faces(const map::Document& document, const std::filesystem::path& folder,
                                         std::vector<Error>& faults) {
  std::vector<render::Surface> faces;
  std::map<std::filesystem::path, ModelLook> looks;
  for (const mesh::Placement& placement : mesh::placements(document)) {
    try {
      const std::filesystem::path file = mesh::model_path(placement, folder);
      auto look = looks.find(file);
      if (look == looks.end()) look = looks.emplace(file, load_look(file, folder)).first;
      const mesh::Model& model = look->second.model;
      std::vector<render::Surface> more =
          render::mesh_surfaces(model, look->second.textures, mesh::place(model, placement));
      faces.insert(faces.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    } catch (const Error& error) {
      faults.push_back(error);
    }
  }
  return faces;
}

std::string occupant_text(const map::Occupant& occupant) {
  const std::string name =
      occupant.name.empty() ? std::string() : fmt::format(" \"{}\"", printable(occupant.name, 60));
  return fmt::format("{}{} (line {})", printable(occupant.classname, 60), name, occupant.line);
}

std::string opening_text(const bsp::Opening& opening) {
  if (opening.is_measured()) {
    return fmt::format("an opening of {} x {} at {}", render::measure_text(opening.width_m),
                       render::measure_text(opening.height_m), place_text(opening.at));
  }
  if (opening.width_m > 0.0) {
    return fmt::format("a gap {} wide at {}, of uncertain length", render::measure_text(opening.width_m),
                       place_text(opening.at));
  }
  return "an opening of uncertain size and place";
}

std::string place_text(const Vec3& place) {
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", place.x(), place.y(), place.z());
}

}  // namespace hallway::run
