// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "render/canvas.hpp"
#include "render/font.hpp"
#include "render/image.hpp"
#include "render/png.hpp"
#include "study/chart.hpp"
#include "study/chart_sheet.hpp"

namespace hallway::study {
namespace {

using render::Canvas;
using render::Font;
using render::ScreenSegment;

/// Adds the parts of a segment that a dashed line shows. @param done_px  length of the line before it
void add_dashes(const Vec2& from, const Vec2& to, double done_px, std::vector<ScreenSegment>& out) {
  constexpr double kDash = 7.0, kPeriod = 12.0;
  const double length = (to - from).norm();
  if (length == 0.0) return;
  const Vec2 along = (to - from) / length;
  for (double k = std::floor(done_px / kPeriod); k * kPeriod < done_px + length; k += 1.0) {
    const double begin = std::max(k * kPeriod - done_px, 0.0);
    const double end = std::min(k * kPeriod + kDash - done_px, length);
    if (begin < end) out.push_back({{from + begin * along, 0.0}, {from + end * along, 0.0}});
  }
}

/// Paints the pieces of a sheet.
class PngPainter {
 public:
  explicit PngPainter(const ChartSheet& sheet) : sheet_(sheet), canvas_(image_) {}

  void operator()(const SheetLine& line) {
    canvas_.set_clip(line.clipped ? frame() : whole());
    std::vector<ScreenSegment> segments;
    double done = 0.0;
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
      const Vec2 &from = line.points[i], &to = line.points[i + 1];
      if (line.dashed) {
        add_dashes(from, to, done, segments);
      } else {
        segments.push_back({{from, 0.0}, {to, 0.0}});
      }
      done += (to - from).norm();
    }
    canvas_.stroke(segments, {.colour = line.colour, .width_px = line.width_px});
  }
  void operator()(const SheetDots& dots) {
    canvas_.set_clip(whole());
    for (const Vec2& place : dots.places)
      canvas_.mark({place, 0.0}, render::MarkerShape::kDot, dots.colour, dots.size_px);
  }
  void operator()(const SheetWords& words) {
    canvas_.set_clip(whole());
    const Font& font = words.bold ? bold_ : regular_;
    const double width = font.width_px(words.text, words.size_px);
    const double back = words.anchor == SheetWords::Anchor::kStart    ? 0.0
                        : words.anchor == SheetWords::Anchor::kMiddle ? 0.5 * width
                                                                      : width;
    canvas_.text(font, words.text, words.size_px, words.at - Vec2(back, 0.0), words.colour);
  }

  std::string finish() const { return render::encode_png(image_); }

 private:
  static render::PixelRect whole() { return {0, 0, kChartWidth_px, kChartHeight_px}; }
  render::PixelRect frame() const {
    const auto whole_number = [](double value) { return static_cast<int>(std::lround(value)); };
    return {whole_number(sheet_.frame_low.x()), whole_number(sheet_.frame_low.y()),
            whole_number(sheet_.frame_high.x()), whole_number(sheet_.frame_high.y())};
  }

  const ChartSheet& sheet_;
  render::Image image_ = render::blank_image(kChartWidth_px, kChartHeight_px);
  Canvas canvas_;
  Font regular_{Font::Weight::kRegular};
  Font bold_{Font::Weight::kBold};
};

}  // namespace

std::string print_png(const Chart& chart) {
  const ChartSheet sheet = lay_out(chart);
  PngPainter painter(sheet);
  for (const SheetPiece& piece : sheet.pieces) std::visit(painter, piece);
  return painter.finish();
}

}  // namespace hallway::study
