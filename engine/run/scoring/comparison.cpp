// SPDX-License-Identifier: MIT
#include "run/scoring/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/text.hpp"
#include "render/draw.hpp"
#include "run/pictures/picture_frame.hpp"
#include "run/pictures/pictures.hpp"

namespace hallway::run {
namespace {

/// How the panels stand in the picture.
struct Grid {
  int columns = 1;
  int rows = 1;
  int width_px = 0;  ///< of a panel
  int height_px = 0;
};

Grid grid_of(std::size_t runs, const sim::PictureSpec& spec) {
  constexpr int kLeastSide_px = 200;
  Grid grid;
  const auto count = static_cast<int>(runs);
  while (grid.columns * grid.columns < count) ++grid.columns;
  grid.rows = (count + grid.columns - 1) / grid.columns;
  // Up to four panels are as large as asked for; more of them share the width of two.
  const double shrink = grid.columns <= 2 ? 1.0 : 2.0 / grid.columns;
  grid.width_px = std::max(static_cast<int>(spec.width_px * shrink), kLeastSide_px);
  grid.height_px = std::max(static_cast<int>(spec.height_px * shrink), kLeastSide_px);
  render::check_image_size(std::int64_t{grid.columns} * grid.width_px,
                           std::int64_t{grid.rows} * grid.height_px);
  return grid;
}

/// The corners of a box that is not empty.
std::vector<Vec3> corners_of(const Box& box) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.push_back(box.corner(static_cast<Box::CornerType>(i)));
  return corners;
}

/// The view that shows a frame in the map area of a panel.
render::View fixed_view(const render::Picture& panel, const Box& frame, render::View view, const Grid& grid) {
  if (frame.isEmpty()) return view;
  const render::PixelRect area = render::map_area(panel, grid.width_px, grid.height_px);
  if (view.kind == render::ViewKind::kTop) {
    view.crop = crop_of(frame, area);
    return view;
  }
  if (view.eye) return view;
  const render::Camera camera = render::make_camera(view, area, corners_of(frame));
  view.eye = camera.eye();
  view.target = camera.eye() + Vec3(camera.axes().row(2).transpose());
  return view;
}

/// What all runs have in common: the smallest, so that none is drawn out of the picture.
std::optional<double> common_error_scale(const std::vector<Compared>& runs) {
  std::optional<double> common;
  for (const Compared& run : runs) {
    const auto scale = error_scale_of(run.record);
    if (scale) common = std::min(common.value_or(*scale), *scale);
  }
  return common;
}

}  // namespace

render::Image draw_comparison(const std::vector<Compared>& runs, const sim::PictureSpec& spec,
                              render::Renderer renderer) {
  const Grid grid = grid_of(runs.size(), spec);
  const std::optional<double> error_scale = common_error_scale(runs);
  render::Image image;
  std::optional<Box> frame;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const render::Plan plan = picture_plan(runs[i].record, spec);
    render::Picture panel = compose_picture(runs[i].record, spec, {}, plan.faces, error_scale);
    panel.title = printable(runs[i].name);
    if (!frame) frame = frame_of(runs[i].record, panel.surfaces);
    const render::View view = fixed_view(panel, *frame, view_of_plan(spec, plan, renderer), grid);
    const render::Image drawn = render::draw(panel, view, grid.width_px, grid.height_px);
    if (i == 0)
      image = render::blank_image(grid.columns * grid.width_px, grid.rows * grid.height_px, drawn.at(0, 0));
    const int at = static_cast<int>(i);
    render::paste(drawn, at % grid.columns * grid.width_px, at / grid.columns * grid.height_px, image);
  }
  return image;
}

}  // namespace hallway::run
