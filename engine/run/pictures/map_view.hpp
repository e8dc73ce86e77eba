// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "geometry/se3.hpp"
#include "map/document.hpp"
#include "render/map_surfaces.hpp"
#include "render/picture.hpp"
#include "world/compiled_world.hpp"

namespace hallway::run {

/// What a picture shows of a compiled map, besides its faces.
struct MapView {
  bool portals = false;
  bool leak = false;
  bool wireframe = false;  ///< edges instead of faces
  bool bsp_depth = false;  ///< faces coloured by the depth of their leaves
  std::optional<Vec3>
      pvs_from_m{};  ///< faces coloured by what may be seen from there; not together with `bsp_depth`

  bool anything() const { return portals || leak || wireframe || bsp_depth || pvs_from_m; }
};

/// Adds a map to a picture. Of a map that does not leak, `leak` shows nothing.
/// Throws Error{kBadInput} for a `pvs_from_m` in solid, or of a map without visible sets.
void add_map(render::Picture& picture, const world::CompiledWorld& world, const MapView& view,
             render::Faces faces, const std::vector<render::Surface>& models);

/// The models that stand in a map (`hw_mesh`), as faces.
/// @param folder  the map's
/// @param faults  gets why models that are left out could not be read
std::vector<render::Surface> model_faces(const map::Document& document, const std::filesystem::path& folder,
                                         std::vector<Error>& faults);

/// "robot start (hw_robot_start, line 12)": how messages and pictures name an occupant.
std::string occupant_text(const map::Occupant& occupant);

/// What a leak path passes: "an opening of 0.90 m x 2.10 m at (8.10, 3.00, 1.05)"; where its outline is not known, what is known of it.
std::string opening_text(const bsp::Opening& opening);

/// "(1.25, 0.00, -3.10)": how messages and pictures name a place, metres.
std::string place_text(const Vec3& place);

}  // namespace hallway::run
