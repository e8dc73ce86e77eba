// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/se3.hpp"
#include "watch/canvas.hpp"

namespace hallway::watch {

/// Which part of the world a canvas shows: north up, the same scale along both axes; a cell of a terminal is twice as high as wide.
class View {
 public:
  /// Shows a box as a whole, with a margin; an empty one as 10 m around the origin.
  /// @param width, height  of the canvas, in cells
  void fit(const Eigen::AlignedBox2d& box, int width, int height);
  /// Shows less (factor above 1) or more around the centre. The scale stays between 1 mm and 1 km a cell.
  void zoom(double factor);
  /// Moves by shares of what is shown, to the right and up.
  void pan(const Vec2& shares);
  void look_at(const Vec2& centre) { centre_ = centre; }
  /// The size of the canvas has changed; centre and scale stay.
  void resize(int width, int height);

  const Vec2& centre() const { return centre_; }
  /// Metres across a cell.
  double cell_m() const { return cell_m_; }
  /// The width and height that are shown [m].
  Vec2 extent_m() const { return {width_ * cell_m_, height_ * 2.0 * cell_m_}; }
  /// A place of the world on a canvas, in its dots.
  Vec2 dots_of(const Vec2& place, Dots dots) const;

 private:
  Vec2 centre_ = Vec2::Zero();
  double cell_m_ = 0.2;
  int width_ = 1;
  int height_ = 1;
};

}  // namespace hallway::watch
