// SPDX-License-Identifier: MIT
#include "editor/commands/shape_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>

#include "base/refuse.hpp"
#include "editor/height_function.hpp"
#include "editor/shapes.hpp"
#include "image/grey_picture.hpp"

namespace hallway::editor {
namespace {

constexpr double kTolerance = 1e-6;  ///< map units

/// A length in map units.
double length(const Edit& edit, const Arguments& arguments, std::string_view name) {
  const double scale = edit.metres_per_unit();
  constexpr double kFine = 1e7;  // of a metre, as Edit::units() has it
  return std::round(arguments.number(name) / scale * (scale * kFine)) / (scale * kFine);
}

/// A length that has another one's value where it is not given.
double length_or(const Edit& edit, const Arguments& arguments, std::string_view name,
                 std::string_view otherwise) {
  return length(edit, arguments, arguments.has(name) ? name : otherwise);
}

Vec3 place(const Edit& edit, const Arguments& arguments, std::string_view name) {
  return edit.units(arguments.place(name));
}

/// A line at one height, from `from` to `to`; the z of `to` may be left out.
std::pair<Vec3, Vec3> level_line(const Edit& edit, const Arguments& arguments, const char* command) {
  const Vec3 from = place(edit, arguments, "from");
  Vec3 to = place(edit, arguments, "to");
  if (to.z() != from.z() && arguments.place("to").z() != 0.0)
    refuse("{}: `from` and `to` are not at one height", command);
  to.z() = from.z();
  return {from, to};
}

/// To the left of a way on the ground, one unit long.
Vec3 left_of(const Vec3& way) {
  return Vec3(-way.y(), way.x(), 0.0) / std::hypot(way.x(), way.y());
}

Vec3 raised(const Vec3& corner, double height) {
  return corner + Vec3(0.0, 0.0, height);
}

std::array<Vec3, 4> strip(const Vec3& from, const Vec3& to, double width) {
  const Vec3 side = left_of(to - from) * (width / 2.0);
  return {tidied(from - side), tidied(to - side), tidied(to + side), tidied(from + side)};
}

double level_length(const Vec3& way) {
  return std::hypot(way.x(), way.y());
}

/// The box from which `box` and `wedge` are made.
Box box_of(const Edit& edit, const Arguments& arguments) {
  const Vec3 a = place(edit, arguments, "from"), b = place(edit, arguments, "to");
  return {a.cwiseMin(b), a.cwiseMax(b)};
}

void set_material(map::Brush& brush, const Vec3& direction, const std::string& material) {
  for (map::Face& face : brush.faces) {
    const auto plane = plane_of(face);
    if (plane && plane->normal.dot(direction) > 0.5) face.material = material;
  }
}

std::string text_or(const Arguments& arguments, std::string_view name, std::string_view otherwise) {
  return arguments.text(arguments.has(name) ? name : otherwise);
}

constexpr std::int64_t kMostColumns = 20'000;

/// The corners of a terrain's grid and the heights over them, map units.
struct Grid {
  std::size_t columns = 0;  ///< cells along x
  std::size_t rows = 0;     ///< along y
  std::vector<Vec3> corners{};

  const Vec3& at(std::size_t column, std::size_t row) const { return corners[row * (columns + 1) + column]; }
};

std::optional<GreyPicture> picture_of(const Edit& edit, const Arguments& arguments) {
  if (!arguments.has("file")) return std::nullopt;
  const std::filesystem::path file = arguments.text("file");
  return read_grey_png(file.is_absolute() ? file : std::filesystem::path(edit.file).parent_path() / file);
}

/// The height over a place of a terrain, given as parts of its size; metres.
class Heights {
 public:
  Heights(const Edit& edit, const Arguments& arguments) : arguments_(arguments) {
    if (arguments.has("function") == arguments.has("file"))
      refuse("terrain: the heights come either from `function` or from `file`");
    if (arguments.has("function")) function_.emplace(arguments.text("function"));
    picture_ = picture_of(edit, arguments);
  }

  double at(double u, double v) {
    const Vec3& size = arguments_.place("size");
    if (function_) return function_->at(u * size.x(), v * size.y());
    return std::lerp(arguments_.number("low"), arguments_.number("high"), picture_->at(u, 1.0 - v));
  }

 private:
  const Arguments& arguments_;
  std::optional<HeightFunction> function_{};
  std::optional<GreyPicture> picture_{};
};

Grid grid_of(const Edit& edit, const Arguments& arguments) {
  const Vec3& size = arguments.place("size");
  if (size.x() <= 0.0 || size.y() <= 0.0) refuse("terrain: `size` is two lengths, X,Y, above 0");
  const std::int64_t columns = arguments.whole("cells");
  const std::int64_t rows =
      arguments.has("rows")
          ? arguments.whole("rows")
          : std::max<std::int64_t>(
                1, std::llround(std::min(1e6, static_cast<double>(columns) * size.y() / size.x())));
  if (2 * columns * rows > kMostColumns)
    refuse("terrain: {} x {} cells are {} brushes; {} are the most", columns, rows, 2 * columns * rows,
           kMostColumns);
  Grid grid{static_cast<std::size_t>(columns), static_cast<std::size_t>(rows), {}};
  Heights heights(edit, arguments);
  const Edit no_grid = without_grid(edit.state);
  const Vec3 at = edit.metres_per_unit() * place(edit, arguments, "at");
  for (std::size_t row = 0; row <= grid.rows; ++row) {
    for (std::size_t column = 0; column <= grid.columns; ++column) {
      const double u = static_cast<double>(column) / static_cast<double>(grid.columns);
      const double v = static_cast<double>(row) / static_cast<double>(grid.rows);
      const double height = heights.at(u, v);
      constexpr double kHighest_m = 1e5;
      if (std::abs(height) > kHighest_m) refuse("terrain: a height is beyond 100 km");
      grid.corners.push_back(no_grid.units(at + Vec3(u * size.x(), v * size.y(), height)));
    }
  }
  return grid;
}

}  // namespace

Parts box_parts(const Edit& edit, const Arguments& arguments) {
  const bool corners = arguments.has("from") && arguments.has("to");
  const bool middle = arguments.has("at") && arguments.has("size");
  const bool any_corner = arguments.has("from") || arguments.has("to");
  const bool any_middle = arguments.has("at") || arguments.has("size");
  if (!(corners && !any_middle) && !(middle && !any_corner))
    refuse("box: either `from` and `to`, two opposite corners, or `at` (the middle of its floor) and `size`");
  const std::string& material = arguments.text("material");
  if (corners) {
    const Box box = box_of(edit, arguments);
    if (box.sizes().z() <= kTolerance)
      refuse("box: `from` and `to` are at one height; give `to` three numbers, X,Y,Z, such as to 1,1,2.5");
    return {.added = {box_brush(box.min(), box.max(), material)}};
  }
  const Vec3& size = arguments.place("size");
  if (size.minCoeff() <= 0.0) refuse("box: `size` is three lengths, X,Y,Z, above 0");
  const Vec3 low = arguments.place("at") - Vec3(size.x() / 2.0, size.y() / 2.0, 0.0);
  return {.added = {box_brush(edit.units(low), edit.units(low + size), material)}};
}

Parts wedge_parts(const Edit& edit, const Arguments& arguments) {
  const Box box = box_of(edit, arguments);
  const Vec3 low = box.min(), high = box.max();
  if ((high - low).minCoeff() <= kTolerance) refuse("wedge: between `from` and `to` is no volume");
  const std::array<Vec3, 4> bottom{
      low, {high.x(), low.y(), low.z()}, {high.x(), high.y(), low.z()}, {low.x(), high.y(), low.z()}};
  const std::string& side = arguments.text("high");
  std::array<Vec3, 4> top = bottom;
  for (Vec3& corner : top) {
    const bool is_high =
        (side == "east" && corner.x() == high.x()) || (side == "west" && corner.x() == low.x()) ||
        (side == "north" && corner.y() == high.y()) || (side == "south" && corner.y() == low.y());
    if (is_high) corner.z() = high.z();
  }
  return {.added = {column(bottom, top, arguments.text("material"))}};
}

Parts cylinder_parts(const Edit& edit, const Arguments& arguments) {
  const Vec3 at = place(edit, arguments, "at");
  const double radius = length(edit, arguments, "radius"), height = length(edit, arguments, "height");
  const auto sides = static_cast<int>(arguments.whole("sides"));
  const Eigen::Index along = axis_of(arguments.text("axis"));
  const Eigen::Index first = (along + 1) % 3, second = (along + 2) % 3;
  std::vector<Vec3> base;
  for (int i = 0; i < sides; ++i) {
    // Half a step on, so that a flat side faces along the first axis.
    const double angle = (2.0 * i + 1.0) * std::numbers::pi / sides;
    Vec3 corner = at;
    corner[first] += radius * std::cos(angle);
    corner[second] += radius * std::sin(angle);
    base.push_back(tidied(corner));
  }
  return {.added = {extrusion(base, height * Vec3::Unit(along), arguments.text("material"))}};
}

Parts prism_parts(const Edit& edit, const Arguments& arguments) {
  std::vector<Vec3> corners;
  for (const Vec3& corner : arguments.places("polygon")) {
    corners.push_back(edit.units(corner));
    if (corners.back().z() != corners.front().z())
      refuse("prism: the corners of `polygon` are not at one height");
  }
  const double foot = length(edit, arguments, "z"), height = length(edit, arguments, "height");
  Parts parts;
  for (auto& part : convex_parts(corners)) {
    for (Vec3& corner : part) corner.z() += foot;
    parts.added.push_back(extrusion(part, height * Vec3::UnitZ(), arguments.text("material")));
  }
  return parts;
}

WallStretch wall_stretch(const Edit& edit, const Arguments& arguments) {
  const auto [from, to] = level_line(edit, arguments, "wall");
  if (level_length(to - from) <= kTolerance) refuse("wall: `from` and `to` are one place");
  const Vec3 along = (to - from).normalized();
  const auto more = [&](const char* name) -> Vec3 {
    return arguments.has(name) ? Vec3(length(edit, arguments, name) * along) : Vec3::Zero();
  };
  const auto outline =
      strip(tidied(from - more("before")), tidied(to + more("behind")), length(edit, arguments, "thickness"));
  return {from, to, {outline.begin(), outline.end()}};
}

Parts wall_parts(const Edit& edit, const Arguments& arguments) {
  const double height = length(edit, arguments, "height");
  return {.added = {extrusion(wall_stretch(edit, arguments).outline, height * Vec3::UnitZ(),
                              arguments.text("material"))},
          .remembered = true};  // for the corners with walls to come
}

std::vector<WallStretch> arc_stretches(const Edit& edit, const Arguments& arguments) {
  const Vec3 centre = place(edit, arguments, "centre");
  const double radius = length(edit, arguments, "radius");
  const double start = arguments.number("from");
  double sweep = arguments.number("to") - start;
  constexpr double kTurn = 2.0 * std::numbers::pi, kSmall = 1e-9;
  if (sweep <= kSmall) sweep += kTurn;
  if (sweep > kTurn + kSmall || sweep <= kSmall) refuse("arc: from `from` to `to` is more than one turn");
  const auto count = static_cast<int>(arguments.whole("segments"));
  const double step = sweep / count;
  if (step > 2.0 * std::numbers::pi / 3.0 + kSmall)
    refuse("arc: a segment spans more than 120 degrees; it takes more `segments`");
  // The middle line runs on chords of the circle; the joints lie on its radii.
  const double half = length(edit, arguments, "thickness") / 2.0 / std::cos(step / 2.0);
  if (radius - half <= kTolerance) refuse("arc: the wall is too thick for its radius");
  const auto at = [&](int i, double distance) {
    const double angle = start + (std::abs(sweep - kTurn) <= kSmall ? i % count : i) * step;
    return tidied(centre + distance * Vec3(std::cos(angle), std::sin(angle), 0.0));
  };
  std::vector<WallStretch> stretches;
  for (int i = 0; i < count; ++i) {
    stretches.push_back(
        {at(i, radius),
         at(i + 1, radius),
         {at(i, radius - half), at(i, radius + half), at(i + 1, radius + half), at(i + 1, radius - half)}});
  }
  return stretches;
}

Parts arc_parts(const Edit& edit, const Arguments& arguments) {
  const Vec3 up = length(edit, arguments, "height") * Vec3::UnitZ();
  Parts parts;
  for (const WallStretch& stretch : arc_stretches(edit, arguments))
    parts.added.push_back(extrusion(stretch.outline, up, arguments.text("material")));
  return parts;
}

Box room_inside(const Edit& edit, const Arguments& arguments) {
  const auto [from, to] = level_line(edit, arguments, "room");
  const Vec3 low = from.cwiseMin(to);
  const Vec3 high = raised(from.cwiseMax(to), length(edit, arguments, "height"));
  if ((high - low).minCoeff() <= kTolerance)
    refuse("room: `from` and `to` are no opposite corners of a floor");
  return {low, high};
}

Parts room_parts(const Edit& edit, const Arguments& arguments) {
  const Box inside = room_inside(edit, arguments);
  const double wall = length(edit, arguments, "wall");
  const Vec3 below(wall, wall, length_or(edit, arguments, "floor", "wall"));
  const Vec3 above(wall, wall, length_or(edit, arguments, "ceiling", "wall"));
  Parts parts;
  const std::string& material = arguments.text("material");
  parts.added.push_back(box_brush(tidied(inside.min() - below), tidied(inside.max() + above), material));
  map::Brush cut = box_brush(inside.min(), inside.max(), material);
  for (map::Brush* brush : {&parts.added.front(), &cut}) {
    // The face of the cut that looks down is the floor that one sees.
    set_material(*brush, -Vec3::UnitZ(), text_or(arguments, "floor_material", "material"));
    set_material(*brush, Vec3::UnitZ(), text_or(arguments, "ceiling_material", "material"));
  }
  parts.subtracted.push_back(std::move(cut));
  return parts;
}

Parts stairs_parts(const Edit& edit, const Arguments& arguments) {
  const auto [from, to] = level_line(edit, arguments, "stairs");
  if (level_length(to - from) <= kTolerance) refuse("stairs: `from` and `to` are one place");
  const double width = length(edit, arguments, "width"), rise = length(edit, arguments, "rise");
  const auto steps = static_cast<int>(arguments.whole("steps"));
  const auto outline = strip(from, to, width);
  Parts parts;
  for (int i = 0; i < steps; ++i) {
    const auto along = [&](std::size_t a, std::size_t b, int k) {
      const double part = static_cast<double>(k) / steps;
      return tidied(k == steps ? outline[b] : outline[a] + part * (outline[b] - outline[a]));
    };
    const std::array<Vec3, 4> tread{along(0, 1, i), along(0, 1, i + 1), along(3, 2, i + 1), along(3, 2, i)};
    parts.added.push_back(
        extrusion(tread, rise * (i + 1) / steps * Vec3::UnitZ(), arguments.text("material")));
  }
  return parts;
}

Parts ramp_parts(const Edit& edit, const Arguments& arguments) {
  const Vec3 from = place(edit, arguments, "from"), to = place(edit, arguments, "to");
  if (level_length(to - from) <= kTolerance)
    refuse("ramp: `from` and `to` are over each other; a ramp leads from one place to another");
  if (std::abs(to.z() - from.z()) <= kTolerance)
    refuse("ramp: `from` and `to` are at one height; `box` makes what is level");
  const auto top = strip(from, to, length(edit, arguments, "width"));
  auto bottom = top;
  for (Vec3& corner : bottom) {
    if (arguments.has("thickness")) {
      corner.z() -= length(edit, arguments, "thickness");
    } else {
      corner.z() = std::min(from.z(), to.z());
    }
  }
  return {.added = {column(bottom, top, arguments.text("material"))}};
}

Parts terrain_parts(const Edit& edit, const Arguments& arguments) {
  const Grid grid = grid_of(edit, arguments);
  double foot = grid.corners.front().z();
  for (const Vec3& corner : grid.corners) foot = std::min(foot, corner.z());
  foot -= length(edit, arguments, "depth");
  Parts parts;
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const std::array<Vec3, 3> top{a, b, c};
    std::array<Vec3, 3> bottom = top;
    for (Vec3& corner : bottom) corner.z() = foot;
    parts.added.push_back(column(bottom, top, arguments.text("material")));
  };
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t i = 0; i < grid.columns; ++i) {
      add(grid.at(i, row), grid.at(i + 1, row), grid.at(i + 1, row + 1));
      add(grid.at(i, row), grid.at(i + 1, row + 1), grid.at(i, row + 1));
    }
  }
  return parts;
}

}  // namespace hallway::editor
