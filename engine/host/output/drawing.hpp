// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/drawing.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hallway::host {

/// A line, a circle or a text of a drawing.
struct DrawingItem {
  std::uint32_t kind = HW_DRAWING_POLYLINE;  ///< one that is known
  std::uint32_t colour = HW_COLOUR_PLAIN;    ///< HW_COLOUR_…
  bool closed = false;                       ///< of a polyline
  double radius_m = 0;                       ///< of a circle
  std::size_t first_point = 0;
  std::size_t n_points = 0;
  std::string text{};  ///< of a text, UTF-8
};

/// The drawing that a plugin put, checked, in memory that is used again.
class Drawing {
 public:
  /// Copies one and checks it: what drawing.h demands. Items of unknown kinds are left out. Throws Malformed. O(items + points).
  /// @param drawing  as large as version 1.6 has it, or larger
  void set(const hw_drawing_t& drawing);

  /// In the order put.
  std::span<const DrawingItem> items() const { return items_; }
  /// All points; body, finite.
  std::span<const hw_drawing_point_t> points() const { return points_; }
  /// The points of one of the items.
  std::span<const hw_drawing_point_t> points_of(const DrawingItem& item) const {
    return std::span(points_).subspan(item.first_point, item.n_points);
  }

 private:
  std::vector<DrawingItem> items_;
  std::vector<hw_drawing_point_t> points_;
};

}  // namespace hallway::host
