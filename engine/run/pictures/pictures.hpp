// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "map/robot_file.hpp"
#include "render/image.hpp"
#include "render/map_surfaces.hpp"
#include "render/picture.hpp"
#include "render/renderer.hpp"
#include "render/view.hpp"
#include "run/pictures/map_things.hpp"
#include "run/pictures/map_view.hpp"
#include "run/pictures/record.hpp"
#include "sim/scenario.hpp"

namespace hallway::run {

/// A picture of a run: the map, true and estimated path, true and mapped landmarks with lines between, submaps, and what
/// the sensor saw at the end. Estimates are drawn where the best rigid fit to the truth puts them, and cut off at the border of frame_of(). Errors too small to be
/// seen are drawn longer, by a power of ten that the legend states.
/// A picture of an iteration shows that moment; the record needs its history then. Throws as instant_of() does.
/// @param faces        which of the map are shown
/// @param error_scale  by how much errors are drawn longer; empty: as error_scale_of() says
render::Picture compose_picture(const Record& record, const sim::PictureSpec& spec,
                                const MapView& map_view = {}, render::Faces faces = render::Faces::kAll,
                                std::optional<double> error_scale = std::nullopt);

/// The power of ten by which the errors of landmarks have to be drawn longer to be seen; empty where there are none. Pictures that are compared have
/// the smallest of theirs in common.
std::optional<double> error_scale_of(const Record& record);

/// How the map of a run is opened in a picture: as its description says, else as the building suggests.
render::Plan picture_plan(const Record& record, const sim::PictureSpec& spec, const MapView& map_view = {});

/// From where a picture is seen, and what draws it.
render::View view_of_plan(const sim::PictureSpec& spec, const render::Plan& plan, render::Renderer renderer);

/// A map alone, and what is drawn over it.
struct MapSubject {
  const world::CompiledWorld& world;
  std::string title{};                      ///< e.g. the map's name
  std::vector<render::Surface> meshes{};    ///< drawn with the map's own faces
  const map::Document* document = nullptr;  ///< that was compiled; null: no `things` are shown
  MapThings things{};
};

/// Throws Error{kUsage} unless the name of a picture to write ends in .png: so no map, journal or log is replaced by one.
void check_picture_name(const std::string& file);

/// How a picture is drawn, beside what its description says.
struct DrawOptions {
  render::Renderer renderer = render::Renderer::kAuto;
  std::optional<Eigen::AlignedBox2d>
      area{};  ///< top view: this ground, metres, as large as fits; else all content
  std::optional<double> vertical_fov{};  ///< perspective: full angle over the height of the map area, rad
  std::optional<double> error_scale{};   ///< of a run: as of compose_picture()
};

/// A picture of a map.
render::Picture compose_map_picture(const MapSubject& subject, const MapView& map_view, render::Faces faces);

/// Draws and encodes a picture of a run; opens closed buildings in a top view unless the picture's description says how.
/// @return the bytes of a PNG file
/// Throws render::NoRenderer where there are faces to draw and this machine does not have the renderer.
std::string draw_run_picture(const Record& record, const sim::PictureSpec& spec, const MapView& map_view = {},
                             const DrawOptions& options = {});

/// The same for a map alone.
std::string draw_map_picture(const MapSubject& subject, const sim::PictureSpec& spec,
                             const MapView& map_view = {}, const DrawOptions& options = {});

/// The same for a robot file.
std::string draw_robot_picture(const map::RobotFile& robot, const std::string& title,
                               const sim::PictureSpec& spec, const MapThings& things = {},
                               const DrawOptions& options = {});

/// A run of points in which planes were found, in four panels as the figures of thesis chapter 5: the mapped walls over the true ones; the points that
/// one frame saw; the planes found in them over the walls; the map by itself, with its submaps' links and its walls' numbers. The frame is the first of
/// those in which the most planes were found. What the run folder does not have is not shown.
/// @param spec  the size of the whole; its view and layers are not read
render::Image draw_panels(const Record& record, const sim::PictureSpec& spec, render::Renderer renderer);

}  // namespace hallway::run
