// SPDX-License-Identifier: MIT
#include "render/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.hpp"

namespace hallway::render {
namespace {

constexpr int kLeastWidth_px = 240;
constexpr int kLeastHeight_px = 180;
constexpr int kLeastLegendWidth_px = 480;
// Lengths at the usual size; multiplied by Layout::unit.
constexpr double kSide = 16.0;
constexpr double kHeader = 48.0;
constexpr double kFooterEdge = 10.0;
constexpr double kRow = 24.0;
constexpr double kScaleBarRoom = 230.0;
constexpr double kScaleBarMost = 150.0;
constexpr double kSymbol = 28.0;
constexpr double kScaleSymbol = 130.0;
constexpr double kSymbolGap = 8.0;
constexpr double kEntryGap = 26.0;
constexpr std::size_t kMostEntries = 16;

void add_entry(std::vector<LegendEntry>& entries, LegendEntry entry, const std::string& label) {
  if (label.empty() || entries.size() >= kMostEntries) return;
  entry.text = printable(label, 120);
  const bool known = std::any_of(entries.begin(), entries.end(), [&](const LegendEntry& other) {
    return other.text == entry.text && other.kind == entry.kind;
  });
  if (!known) entries.push_back(std::move(entry));
}

std::vector<LegendEntry> legend_entries(const Picture& picture) {
  using Kind = LegendEntry::Kind;
  std::vector<LegendEntry> out;
  for (const Swatch& swatch : picture.swatches) add_entry(out, {Kind::kArea, swatch.colour}, swatch.label);
  if (!picture.scale.colours.empty()) {
    LegendEntry entry{Kind::kScale, {}};
    entry.colours = picture.scale.colours;
    add_entry(out, std::move(entry), picture.scale.label);
  }
  for (const Patches& patches : picture.patches) {
    LegendEntry entry{Kind::kArea, patches.colour, patches.outline_px};
    entry.opacity = std::max(0.25, patches.opacity);
    add_entry(out, std::move(entry), patches.label);
  }
  for (const Polyline& line : picture.polylines) {
    LegendEntry entry{line.dashed ? Kind::kDashedLine : Kind::kLine, line.colour, line.width_px};
    add_entry(out, entry, line.label);
  }
  for (const Markers& markers : picture.markers) {
    LegendEntry entry{Kind::kMark, markers.colour, 1.0, markers.size_px, markers.shape};
    add_entry(out, entry, markers.label);
  }
  for (const Segments& segments : picture.segments) {
    add_entry(out,
              {Kind::kThinLine, mix(palette::kPaper, segments.colour, segments.opacity), segments.width_px},
              segments.label);
  }
  if (!picture.frustums.empty())
    add_entry(out, {Kind::kField, picture.frustums.front().colour}, picture.frustums.front().label);
  return out;
}

double symbol_width(const LegendEntry& entry) {
  return entry.kind == LegendEntry::Kind::kScale ? kScaleSymbol : kSymbol;
}

/// Gives each entry its place, row after row; returns the number of rows.
int place_legend(std::vector<LegendEntry>& entries, double unit, double text_px, double left, double right,
                 const Font& font) {
  int row = 0;
  double x = left;
  for (LegendEntry& entry : entries) {
    const double before_text = unit * (symbol_width(entry) + kSymbolGap);
    entry.text = font.shortened(entry.text, text_px, right - left - before_text);
    const double width = before_text + font.width_px(entry.text, text_px);
    if (x > left && x + width > right) {
      ++row;
      x = left;
    }
    entry.at_px = Vec2(x, unit * (kFooterEdge + kRow * (row + 0.5)));
    x += width + unit * kEntryGap;
  }
  return row + 1;
}

Vec2 px(double x, double y) {
  return {x, y};
}

/// A point of something that is drawn on the paper and not in the world.
ScreenPoint on_paper(const Vec2& pixel) {
  return {pixel, 1.0};
}

ScreenSegment flat(const Vec2& a, const Vec2& b) {
  return {on_paper(a), on_paper(b)};
}

void fill_box(Canvas& canvas, double left, double top, double right, double bottom, Rgb colour) {
  const std::array<ScreenPoint, 4> corners{on_paper(px(left, top)), on_paper(px(right, top)),
                                           on_paper(px(right, bottom)), on_paper(px(left, bottom))};
  canvas.fill_convex(corners, colour, 1.0);
}

/// A field of a colour with a rim: as it stands in the picture where it is opaque, else with its own colour around it.
void paint_area(Canvas& canvas, const LegendEntry& entry, double length, double half_height) {
  const Rgb rim = entry.opacity < 1.0 ? entry.colour : mix(entry.colour, palette::kInk, 0.45);
  const double left = entry.at_px.x() + 0.15 * length;
  const double right = entry.at_px.x() + 0.85 * length;
  const double top = entry.at_px.y() - half_height;
  const double bottom = entry.at_px.y() + half_height;
  fill_box(canvas, left, top, right, bottom, mix(palette::kPaper, entry.colour, entry.opacity));
  const std::array<ScreenSegment, 4> sides{
      flat(px(left, top), px(right, top)), flat(px(right, top), px(right, bottom)),
      flat(px(right, bottom), px(left, bottom)), flat(px(left, bottom), px(left, top))};
  canvas.stroke(sides, {rim, 1.2});
}

void paint_colours(Canvas& canvas, const LegendEntry& entry, double length, double half_height) {
  const double step = length / static_cast<double>(entry.colours.size());
  for (std::size_t i = 0; i < entry.colours.size(); ++i) {
    const double left = std::round(entry.at_px.x() + step * static_cast<double>(i));
    const double right = std::round(entry.at_px.x() + step * static_cast<double>(i + 1));
    fill_box(canvas, left, entry.at_px.y() - half_height, right, entry.at_px.y() + half_height,
             entry.colours[i]);
  }
}

void paint_entry(Canvas& canvas, const LegendEntry& entry, const Layout& layout, const Fonts& fonts) {
  using Kind = LegendEntry::Kind;
  const double length = layout.unit * symbol_width(entry);
  const Vec2& at = entry.at_px;
  const Vec2 end = at + px(length, 0.0);
  switch (entry.kind) {
    case Kind::kLine:
    case Kind::kThinLine: {
      const std::array<ScreenSegment, 1> line{flat(at, end)};
      canvas.stroke(line, {entry.colour, std::max(1.0, entry.width_px)});
      break;
    }
    case Kind::kDashedLine: {
      const std::array<ScreenSegment, 2> dashes{flat(at, at + px(0.38 * length, 0.0)),
                                                flat(at + px(0.62 * length, 0.0), end)};
      canvas.stroke(dashes, {entry.colour, std::max(1.0, entry.width_px)});
      break;
    }
    case Kind::kMark:
      canvas.mark({at + px(0.5 * length, 0.0), 1.0}, entry.shape, entry.colour,
                  std::clamp(entry.size_px, 6.0, 16.0));
      break;
    case Kind::kField: {
      const std::array<ScreenPoint, 3> cone{on_paper(at + px(0.1 * length, 0.0)),
                                            on_paper(at + px(length, -0.28 * length)),
                                            on_paper(at + px(length, 0.28 * length))};
      canvas.fill_convex(cone, entry.colour, 0.25);
      const std::array<ScreenSegment, 2> rays{{{cone[0], cone[1]}, {cone[0], cone[2]}}};
      canvas.stroke(rays, {entry.colour, 1.2});
      break;
    }
    case Kind::kArea:
      paint_area(canvas, entry, length, 6.5 * layout.unit);
      break;
    case Kind::kScale:
      paint_colours(canvas, entry, length, 6.5 * layout.unit);
      break;
  }
  canvas.text(fonts.regular, entry.text, layout.text_px,
              at + px(length + layout.unit * kSymbolGap, 0.36 * layout.text_px), palette::kInk);
}

void paint_title(Canvas& canvas, const Picture& picture, const Layout& layout, const Fonts& fonts) {
  const double size = 1.38 * layout.text_px;
  const double base = layout.unit * (0.5 * kHeader) + 0.36 * size;
  const double room = layout.map.width() - layout.unit * 90.0;
  const std::string title = fonts.bold.shortened(printable(picture.title), size, room);
  double x = layout.map.left;
  canvas.text(fonts.bold, title, size, px(x, base), palette::kInk);
  const double used = title.empty() ? 0.0 : fonts.bold.width_px(title, size) + layout.unit * 14.0;
  x += used;
  const std::string subtitle =
      fonts.regular.shortened(printable(picture.subtitle), layout.text_px, room - used);
  canvas.text(fonts.regular, subtitle, layout.text_px, px(x, base), palette::kMutedInk);
}

void paint_axes(Canvas& canvas, const Layout& layout, const Camera& camera, const Fonts& fonts) {
  const double length = layout.unit * 16.0;
  const double text_px = 0.85 * layout.text_px;
  const Vec2 origin(layout.map.right - layout.unit * 34.0, layout.unit * (0.5 * kHeader + 10.0));
  constexpr std::array<const char*, 3> kNames{"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    const Vec2 direction = camera.axes().col(axis).head<2>();
    if (direction.norm() < 0.15) continue;
    const Vec2 tip = origin + length * direction;
    const Vec2 back = direction.normalized() * layout.unit * 4.5;
    const Vec2 side(-back.y(), back.x());
    const std::array<ScreenSegment, 1> shaft{flat(origin, tip)};
    canvas.stroke(shaft, {palette::kMutedInk, 1.3 * layout.unit});
    const std::array<ScreenPoint, 3> head{on_paper(tip + 0.4 * back), on_paper(tip - back + 0.55 * side),
                                          on_paper(tip - back - 0.55 * side)};
    canvas.fill_convex(head, palette::kMutedInk, 1.0);
    const std::string_view name = kNames[static_cast<std::size_t>(axis)];
    const Vec2 centre = tip + 2.0 * back;
    canvas.text(fonts.regular, name, text_px,
                centre + px(-0.5 * fonts.regular.width_px(name, text_px), 0.27 * text_px),
                palette::kMutedInk);
  }
}

void paint_scale_bar(Canvas& canvas, const Layout& layout, const Camera& camera, double middle,
                     const Fonts& fonts) {
  const ScaleBar bar = scale_bar(camera.scale(), layout.unit * kScaleBarMost);
  const double left = layout.map.left;
  const double top = middle - layout.unit * 3.0;
  const double bottom = middle + layout.unit * 3.0;
  const double line = layout.unit;
  fill_box(canvas, left, top, left + bar.length_px, bottom, palette::kInk);
  fill_box(canvas, left + 0.5 * bar.length_px, top + line, left + bar.length_px - line, bottom - line,
           palette::kPaper);
  canvas.text(fonts.regular, length_text(bar.metres), layout.text_px,
              px(left + bar.length_px + layout.unit * 8.0, middle + 0.36 * layout.text_px), palette::kInk);
}

void paint_frame(Canvas& canvas, const PixelRect& map) {
  const Rgb colour = mix(palette::kPaper, palette::kMutedInk, 0.45);
  fill_box(canvas, map.left - 1, map.top - 1, map.right + 1, map.top, colour);
  fill_box(canvas, map.left - 1, map.bottom, map.right + 1, map.bottom + 1, colour);
  fill_box(canvas, map.left - 1, map.top, map.left, map.bottom, colour);
  fill_box(canvas, map.right, map.top, map.right + 1, map.bottom, colour);
}

}  // namespace

Layout make_layout(const Picture& picture, int width_px, int height_px, const Fonts& fonts) {
  Layout layout;
  layout.map = {0, 0, width_px, height_px};
  layout.furniture = width_px >= kLeastWidth_px && height_px >= kLeastHeight_px;
  if (!layout.furniture) return layout;
  const double unit = std::clamp(std::min(width_px / 1280.0, height_px / 800.0), 0.8, 8.0);
  layout.unit = unit;
  layout.text_px = 13.5 * unit;
  if (width_px >= kLeastLegendWidth_px) layout.legend = legend_entries(picture);
  const double left = unit * (kSide + kScaleBarRoom);
  const int rows =
      place_legend(layout.legend, unit, layout.text_px, left, width_px - unit * kSide, fonts.regular);
  // A legend never takes more than half of the picture; what does not fit is left out.
  const int most_rows = std::max(1, static_cast<int>((0.5 * height_px / unit - 2.0 * kFooterEdge) / kRow));
  const int shown_rows = std::min(rows, most_rows);
  const double footer = unit * (2.0 * kFooterEdge + kRow * shown_rows);
  layout.map = {static_cast<int>(unit * kSide), static_cast<int>(unit * kHeader),
                width_px - static_cast<int>(unit * kSide), height_px - static_cast<int>(footer)};
  std::erase_if(layout.legend, [&](const LegendEntry& entry) {
    return entry.at_px.y() > unit * (kFooterEdge + kRow * shown_rows);
  });
  for (LegendEntry& entry : layout.legend) entry.at_px.y() += layout.map.bottom;
  return layout;
}

double round_down_125(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {10.0, 5.0, 2.0}) {
    if (factor * power <= value * (1.0 + 1e-12)) return factor * power;
  }
  return power;
}

ScaleBar scale_bar(double pixels_per_metre, double most_px) {
  const double metres = round_down_125(most_px / pixels_per_metre);
  return {metres, metres * pixels_per_metre};
}

std::string length_text(double metres) {
  if (metres >= 1000.0) return fmt::format("{:.6g} km", metres / 1000.0);
  if (metres >= 1.0) return fmt::format("{:.6g} m", metres);
  if (metres >= 0.01) return fmt::format("{:.6g} cm", metres * 100.0);
  return fmt::format("{:.6g} mm", metres * 1000.0);
}

void paint_furniture(Canvas& canvas, const Picture& picture, const Layout& layout, const Camera& camera,
                     int width_px, int height_px, double grid_m, const Fonts& fonts) {
  if (!layout.furniture) return;
  canvas.set_clip({0, 0, width_px, height_px});
  paint_frame(canvas, layout.map);
  paint_title(canvas, picture, layout, fonts);
  paint_axes(canvas, layout, camera, fonts);
  const double middle = layout.map.bottom + layout.unit * (kFooterEdge + 0.5 * kRow);
  if (camera.kind() == ViewKind::kTop) {
    paint_scale_bar(canvas, layout, camera, middle, fonts);
  } else if (grid_m > 0.0) {
    canvas.text(fonts.regular, "grid " + length_text(grid_m), layout.text_px,
                px(layout.map.left, middle + 0.36 * layout.text_px), palette::kMutedInk);
  }
  for (const LegendEntry& entry : layout.legend) paint_entry(canvas, entry, layout, fonts);
}

}  // namespace hallway::render
