// SPDX-License-Identifier: MIT
#include "watch/view.hpp"

#include <algorithm>

namespace hallway::watch {
namespace {

constexpr double kMargin = 1.06;
constexpr double kLeast_m = 1e-3;
constexpr double kMost_m = 1e3;

}  // namespace

void View::resize(int width, int height) {
  width_ = std::max(width, 1);
  height_ = std::max(height, 1);
}

void View::fit(const Eigen::AlignedBox2d& box, int width, int height) {
  resize(width, height);
  Eigen::AlignedBox2d shown = box;
  if (shown.isEmpty()) shown = Eigen::AlignedBox2d(Vec2(-5.0, -5.0), Vec2(5.0, 5.0));
  centre_ = shown.center();
  const Vec2 size = kMargin * shown.sizes();
  cell_m_ = std::clamp(std::max(size.x() / width_, size.y() / (2.0 * height_)), kLeast_m, kMost_m);
}

void View::zoom(double factor) {
  cell_m_ = std::clamp(cell_m_ / factor, kLeast_m, kMost_m);
}

void View::pan(const Vec2& shares) {
  centre_ += shares.cwiseProduct(extent_m());
}

Vec2 View::dots_of(const Vec2& place, Dots dots) const {
  const DotShape shape = shape_of(dots);
  const Vec2 cells((place.x() - centre_.x()) / cell_m_ + 0.5 * width_,
                   (centre_.y() - place.y()) / (2.0 * cell_m_) + 0.5 * height_);
  return {cells.x() * shape.columns, cells.y() * shape.rows};
}

}  // namespace hallway::watch
