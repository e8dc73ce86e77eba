// SPDX-License-Identifier: MIT
#include "planes/picture.hpp"

#include <algorithm>

#include "planes/files.hpp"
#include "planes/overlap.hpp"
#include "render/draw.hpp"

namespace hallway::planes {
namespace {

using render::Picture;
using render::Rgb;

constexpr std::size_t kMostPoints = 60'000;
constexpr double kPoint_px = 2.4;

/// Points and rectangles of a set of planes; colour by plane.
struct Layer {
  std::vector<std::size_t> plane_of_point{};  ///< place of its plane, or kNoPlace
  std::vector<Corners> rectangles{};          ///< some may be missing
  std::vector<Rgb> colours{};                 ///< of the planes
};

void add_points(Picture& picture, const std::vector<Vec3>& points, const Layer& layer) {
  const std::size_t step = points.size() / kMostPoints + 1;
  std::vector<render::Markers> marks(layer.colours.size() + 1);
  for (std::size_t i = 0; i < points.size(); i += step) {
    const std::size_t plane = layer.plane_of_point[i];
    marks[plane == kNoPlace ? 0 : plane + 1].positions.push_back(points[i]);
  }
  for (std::size_t i = 0; i < marks.size(); ++i) {
    marks[i].colour = i == 0 ? kNoPlaneColour : layer.colours[i - 1];
    marks[i].size_px = kPoint_px;
    picture.markers.push_back(std::move(marks[i]));
  }
}

void add_rectangle(Picture& picture, const Corners& corners, Rgb colour, double width_px) {
  render::Polyline line{.points = {corners.begin(), corners.end()}, .colour = colour, .width_px = width_px};
  line.points.push_back(corners.front());
  picture.polylines.push_back(std::move(line));
}

Picture picture_of(const std::vector<Vec3>& points, const Layer& layer) {
  Picture picture;
  add_points(picture, points, layer);
  for (std::size_t i = 0; i < layer.rectangles.size(); ++i)
    add_rectangle(picture, layer.rectangles[i], render::mix(layer.colours[i], render::palette::kInk, 0.35),
                  1.6);
  return picture;
}

std::vector<std::size_t> found_of_points(std::size_t points, const std::vector<PlaneObservation>& found) {
  std::vector<std::size_t> places;
  for (const std::int64_t plane : plane_of_points(points, found))
    places.push_back(plane < 0 ? kNoPlace : static_cast<std::size_t>(plane));
  return places;
}

Layer found_layer(const PictureContent& content) {
  Layer layer{.plane_of_point = found_of_points(content.points.size(), content.found)};
  for (std::size_t i = 0; i < content.found.size(); ++i) {
    layer.rectangles.push_back(content.found[i].corners);
    layer.colours.push_back(render::submap_colour(i));
  }
  return layer;
}

Layer true_layer(const Truth& truth) {
  Layer layer{.plane_of_point = places_of_points(truth)};
  const bool all = std::all_of(truth.planes.begin(), truth.planes.end(),
                               [](const TruePlane& plane) { return plane.corners.has_value(); });
  for (std::size_t i = 0; i < truth.planes.size(); ++i) {
    if (all) layer.rectangles.push_back(*truth.planes[i].corners);
    layer.colours.push_back(render::submap_colour(i));
  }
  return layer;
}

/// Middle of the points of a plane of a layer.
Vec3 middle(const std::vector<Vec3>& points, const Layer& layer, std::size_t plane) {
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (layer.plane_of_point[i] != plane) continue;
    sum += points[i];
    count += 1;
  }
  return sum / std::max(count, 1.0);
}

/// Names a fault where its plane is: on the side of the truth what was not found, else on that of the result.
void mark_fault(const PictureContent& content, const Truth& truth, const Fault& fault, const Layer& true_side,
                Picture& left, Picture& right) {
  const std::string text = fault_text(fault, truth);
  const Rgb colour = render::palette::kError;
  const bool on_the_left = fault.kind == FaultKind::kMissing || fault.kind == FaultKind::kSplit;
  if (on_the_left) {
    const std::size_t t = fault.truths.front();
    left.labels.push_back({middle(content.points, true_side, t), text, colour});
    if (t < true_side.rectangles.size()) add_rectangle(left, true_side.rectangles[t], colour, 2.6);
  }
  for (const std::size_t f : fault.found) {
    add_rectangle(right, content.found[f].corners, colour, 2.6);
    right.labels.push_back({content.found[f].centroid, text, colour});
  }
}

render::Image beside(const render::Image& left, const render::Image& right) {
  render::Image both = render::blank_image(left.width_px + right.width_px, left.height_px);
  render::paste(left, 0, 0, both);
  render::paste(right, left.width_px, 0, both);
  return both;
}

}  // namespace

render::Image draw_planes(const PictureContent& content, const render::View& view, const PictureSize& size) {
  Picture picture = picture_of(content.points, found_layer(content));
  picture.title = content.title;
  picture.subtitle = content.subtitle;
  return render::draw(picture, view, size.width_px, size.height_px);
}

render::Image draw_comparison(const PictureContent& content, const Truth& truth, const Score& score,
                              const render::View& view, const PictureSize& size) {
  const Layer true_side = true_layer(truth);
  Layer found_side = found_layer(content);
  for (std::size_t f = 0; f < found_side.colours.size(); ++f)
    found_side.colours[f] = render::submap_colour(truth.planes.size() + f);
  for (const PlanePair& pair : score.pairs) found_side.colours[pair.found] = true_side.colours[pair.truth];
  Picture left = picture_of(content.points, true_side);
  Picture right = picture_of(content.points, found_side);
  for (const Fault& fault : score.faults) mark_fault(content, truth, fault, true_side, left, right);
  left.title = "truth";
  right.title = content.title;
  right.subtitle = content.subtitle;
  return beside(render::draw(left, view, size.width_px, size.height_px),
                render::draw(right, view, size.width_px, size.height_px));
}

}  // namespace hallway::planes
