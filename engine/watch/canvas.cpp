// SPDX-License-Identifier: MIT
#include "watch/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace hallway::watch {
namespace {

constexpr std::array<std::string_view, 3> kNames{"braille", "blocks", "ascii"};  // in the order of Dots

/// The bit of Unicode's braille patterns for dot (column, row).
constexpr std::array<std::array<unsigned, 2>, 4> kBrailleBits{
    {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}}};

/// By the bits upper left, upper right, lower left, lower right, in this order from the lowest.
constexpr std::u32string_view kQuarters = U" ▘▝▀▖▌▞▛▗▚▐▜▄▙▟█";

/// One dot a cell leaves the shape of the character to say what it is.
char32_t ascii_of(Role role) {
  switch (role) {
    case Role::kWall:
      return U'#';
    case Role::kRay:
      return U'.';
    case Role::kTruth:
      return U'+';
    case Role::kEstimate:
      return U'o';
    case Role::kContact:
      return U'x';
    case Role::kMapped:
      return U':';
    default:
      return U'*';
  }
}

}  // namespace

DotShape shape_of(Dots dots) {
  return dots == Dots::kBraille ? DotShape{2, 4} : dots == Dots::kBlocks ? DotShape{2, 2} : DotShape{1, 1};
}

std::optional<Dots> dots_named(std::string_view name) {
  const auto found = std::ranges::find(kNames, name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<Dots>(found - kNames.begin());
}

std::string_view name_of(Dots dots) {
  return kNames[static_cast<std::size_t>(dots)];
}

bool clip(Vec2& from, Vec2& to, double width, double height) {
  const Vec2 way = to - from;
  double begin = 0.0;
  double end = 1.0;
  // Each edge as p t <= q, where the line is from + t way.
  const std::array<std::array<double, 2>, 4> edges{{{-way.x(), from.x()},
                                                    {way.x(), width - from.x()},
                                                    {-way.y(), from.y()},
                                                    {way.y(), height - from.y()}}};
  for (const auto& [p, q] : edges) {
    if (p == 0.0) {
      if (q < 0.0) return false;
    } else if (p < 0.0) {
      begin = std::max(begin, q / p);
    } else {
      end = std::min(end, q / p);
    }
  }
  if (begin > end) return false;
  to = from + end * way;
  from += begin * way;
  return true;
}

Canvas::Canvas(int width, int height, Dots dots)
    : width_(std::max(width, 1)),
      height_(std::max(height, 1)),
      dots_(dots),
      shape_(shape_of(dots)),
      cells_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {}

bool Canvas::holds(const Vec2& place) const {
  return place.x() >= 0.0 && place.y() >= 0.0 && place.x() < dot_columns() && place.y() < dot_rows();
}

Canvas::DotCell& Canvas::cell_at(int dot_column, int dot_row) {
  const int index = dot_row / shape_.rows * width_ + dot_column / shape_.columns;
  return cells_[static_cast<std::size_t>(index)];
}

void Canvas::set(int dot_column, int dot_row, Role role) {
  DotCell& cell = cell_at(dot_column, dot_row);
  const int bit = dot_row % shape_.rows * shape_.columns + dot_column % shape_.columns;
  cell.bits = static_cast<std::uint8_t>(cell.bits | (1 << bit));
  if (cell.glyph == 0) cell.role = role;
}

void Canvas::dot(const Vec2& place, Role role) {
  if (holds(place)) set(static_cast<int>(place.x()), static_cast<int>(place.y()), role);
}

void Canvas::line(const Vec2& from, const Vec2& to, Role role, int every) {
  if (!from.allFinite() || !to.allFinite()) return;
  Vec2 a = from;
  Vec2 b = to;
  if (!clip(a, b, dot_columns(), dot_rows())) return;
  const Vec2 way = b - a;
  const int steps = static_cast<int>(std::ceil(way.cwiseAbs().maxCoeff()));
  for (int i = 0; i <= steps; i += every) {
    const Vec2 at = steps == 0 ? a : Vec2(a + way * i / steps);
    // An end on the far edge belongs to the last dot.
    set(std::min(static_cast<int>(at.x()), dot_columns() - 1),
        std::min(static_cast<int>(at.y()), dot_rows() - 1), role);
  }
}

void Canvas::glyph(const Vec2& place, char32_t glyph, Role role) {
  if (!holds(place)) return;
  DotCell& cell = cell_at(static_cast<int>(place.x()), static_cast<int>(place.y()));
  cell.glyph = glyph;
  cell.role = role;
}

bool Canvas::has_dot(int column, int row) const {
  const int index = row / shape_.rows * width_ + column / shape_.columns;
  const int bit = row % shape_.rows * shape_.columns + column % shape_.columns;
  return ((cells_[static_cast<std::size_t>(index)].bits >> bit) & 1) != 0;
}

char32_t Canvas::glyph_of(const DotCell& cell) const {
  if (cell.glyph != 0) return cell.glyph;
  if (dots_ == Dots::kAscii) return ascii_of(cell.role);
  if (dots_ == Dots::kBlocks) return kQuarters[cell.bits];
  unsigned pattern = 0;
  for (unsigned bit = 0; bit < 8; ++bit) {
    if ((cell.bits >> bit) & 1u) pattern |= kBrailleBits[bit / 2][bit % 2];
  }
  return U'\u2800' + pattern;
}

void Canvas::put(Grid& grid, int column, int row) const {
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const DotCell& cell = cells_[static_cast<std::size_t>(y * width_ + x)];
      if (cell.bits != 0 || cell.glyph != 0) grid.put(column + x, row + y, Cell{glyph_of(cell), cell.role});
    }
  }
}

}  // namespace hallway::watch
