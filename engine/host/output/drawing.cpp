// SPDX-License-Identifier: MIT
#include "host/output/drawing.hpp"

#include <algorithm>
#include <cmath>

#include "host/output/plugin_text.hpp"
#include "host/samples/strided.hpp"

namespace hallway::host {
namespace {

/// What is wrong with an item, but for its points and text, null if nothing.
const char* item_problem(const hw_drawing_item_t& item, std::uint64_t n_points) {
  if (item.colour > HW_COLOUR_HIGHLIGHT) return "an unknown colour";
  if (!lies_within(item.first_point, item.n_points, n_points)) return "points beyond their list";
  if (item.kind == HW_DRAWING_POLYLINE)
    return item.n_points >= 2 ? nullptr : "fewer than 2 points, and is a polyline";
  if (item.n_points != 1) return "not one point, and is no polyline";
  if (item.kind == HW_DRAWING_CIRCLE && !(std::isfinite(item.radius_m) && item.radius_m > 0))
    return "a radius that is no finite number above 0";
  return nullptr;
}

DrawingItem copy_item(const hw_drawing_item_t& item) {
  DrawingItem copy{.kind = item.kind,
                   .colour = item.colour,
                   .closed = item.kind == HW_DRAWING_POLYLINE && (item.flags & HW_DRAWING_CLOSED) != 0,
                   .radius_m = item.kind == HW_DRAWING_CIRCLE ? item.radius_m : 0.0,
                   .first_point = item.first_point,
                   .n_points = item.n_points};
  if (item.kind != HW_DRAWING_TEXT) return copy;
  copy.text = copy_plugin_text(item.text, HW_MAX_DRAWING_TEXT_BYTES, "text");
  demand(!copy.text.empty(), "a text that is empty");
  return copy;
}

}  // namespace

void Drawing::set(const hw_drawing_t& drawing) {
  if (drawing.count > HW_MAX_DRAWING_ITEMS)
    throw Malformed{fmt::format("{} items, more than {}", drawing.count, HW_MAX_DRAWING_ITEMS)};
  if (drawing.n_points > HW_MAX_DRAWING_POINTS)
    throw Malformed{fmt::format("{} points, more than {}", drawing.n_points, HW_MAX_DRAWING_POINTS)};
  items_.clear();
  points_.clear();
  const Strided<hw_drawing_item_t> items(drawing.items, drawing.count, drawing.stride);
  Strided<hw_drawing_point_t>(drawing.points, drawing.n_points, drawing.point_stride).append_to(points_);
  const bool finite = std::ranges::all_of(points_, [](const hw_drawing_point_t& point) {
    return std::isfinite(point.x_m) && std::isfinite(point.y_m);
  });
  demand(finite, "a point that is not finite");
  for (std::size_t i = 0; i < items.size(); ++i) {
    const hw_drawing_item_t item = items[i];
    if (item.kind < HW_DRAWING_POLYLINE || item.kind > HW_DRAWING_TEXT) continue;
    if (const char* problem = item_problem(item, points_.size()))
      throw Malformed{fmt::format("item {} has {}", i, problem)};
    items_.push_back(copy_item(item));
  }
}

}  // namespace hallway::host
