// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "render/image.hpp"
#include "render/picture.hpp"
#include "render/renderer.hpp"
#include "run/map_things.hpp"
#include "run/map_view.hpp"
#include "run/record.hpp"
#include "sim/scenario.hpp"

namespace hallway::run {

/// A picture of a run: the map, true and estimated path, true and mapped landmarks with lines between, submaps, and what
/// the sensor saw at the end. Estimates are drawn where the best rigid fit to the truth puts them. Errors too small to be
/// seen are drawn longer, by a power of ten that the legend states.
/// @param faces  which of the map are shown
render::Picture compose_picture(const Record& record, const sim::PictureSpec& spec,
                                const MapView& map_view = {}, render::Faces faces = render::Faces::kAll);

/// A run that is shown beside others of the same input.
struct Compared {
  std::string name;
  const Record& record;
};

/// One picture of several runs, at least one: the map and the truth of the first, and of each the estimated path and the mapped landmarks where
/// its best rigid fit to the truth puts them, in a colour of its own.
render::Picture compose_comparison(const std::vector<Compared>& runs, const sim::PictureSpec& spec,
                                   render::Faces faces = render::Faces::kAll);

/// A map alone, and what is drawn over it.
struct MapSubject {
  const world::CompiledWorld& world;
  std::string title{};                      ///< e.g. the map's name
  std::vector<render::Surface> meshes{};    ///< drawn with the map's own faces
  const map::Document* document = nullptr;  ///< that was compiled; null: no `things` are shown
  MapThings things{};
};

/// How a picture is drawn, beside what its description says.
struct DrawOptions {
  render::Renderer renderer = render::Renderer::kAuto;
  std::optional<Eigen::AlignedBox2d>
      area{};  ///< top view: this ground, metres, as large as fits; else all content
  std::optional<double> vertical_fov{};  ///< perspective: full angle over the height of the map area, rad
};

/// A picture of a map.
render::Picture compose_map_picture(const MapSubject& subject, const MapView& map_view, render::Faces faces);

/// Draws and encodes a picture of a run; opens closed buildings in a top view unless the picture's description says how.
/// @return the bytes of a PNG file
/// Throws render::NoRenderer where there are faces to draw and this machine does not have the renderer.
std::string draw_run_picture(const Record& record, const sim::PictureSpec& spec, const MapView& map_view = {},
                             const DrawOptions& options = {});

/// The same for several runs.
std::string draw_comparison(const std::vector<Compared>& runs, const sim::PictureSpec& spec,
                            const DrawOptions& options = {});

/// The same for a map alone.
std::string draw_map_picture(const MapSubject& subject, const sim::PictureSpec& spec,
                             const MapView& map_view = {}, const DrawOptions& options = {});

}  // namespace hallway::run
