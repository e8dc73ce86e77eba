// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "base/xml_text.hpp"
#include "study/chart.hpp"
#include "study/chart_sheet.hpp"

namespace hallway::study {
namespace {

std::string colour_text(const render::Rgb& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour.r, colour.g, colour.b);
}

/// Writes the pieces of a sheet as elements.
class SvgWriter {
 public:
  explicit SvgWriter(const ChartSheet& sheet) {
    text_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
        "font-family=\"DejaVu Sans, sans-serif\">\n",
        kChartWidth_px, kChartHeight_px);
    const Vec2 size = sheet.frame_high - sheet.frame_low;
    text_ += fmt::format(
        "<clipPath id=\"frame\"><rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
        "height=\"{:.1f}\"/></clipPath>\n",
        sheet.frame_low.x(), sheet.frame_low.y(), size.x(), size.y());
    text_ += fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", kChartWidth_px, kChartHeight_px,
                         colour_text(render::palette::kPaper));
  }

  void operator()(const SheetLine& line) {
    text_ += "<polyline points=\"";
    for (const Vec2& point : line.points) text_ += fmt::format("{:.1f},{:.1f} ", point.x(), point.y());
    text_.back() = '"';
    text_ +=
        fmt::format(" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.1f}\" stroke-linejoin=\"round\"{}{}/>\n",
                    colour_text(line.colour), line.width_px, line.dashed ? " stroke-dasharray=\"7 5\"" : "",
                    line.clipped ? " clip-path=\"url(#frame)\"" : "");
  }
  void operator()(const SheetDots& dots) {
    text_ += fmt::format("<g fill=\"{}\">\n", colour_text(dots.colour));
    for (const Vec2& place : dots.places)
      text_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>\n", place.x(), place.y(),
                           0.5 * dots.size_px);
    text_ += "</g>\n";
  }
  void operator()(const SheetWords& words) {
    static constexpr const char* kAnchors[] = {"start", "middle", "end"};
    text_ += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:.0f}\" fill=\"{}\" text-anchor=\"{}\"{}>{}</text>\n",
        words.at.x(), words.at.y(), words.size_px, colour_text(words.colour),
        kAnchors[static_cast<int>(words.anchor)], words.bold ? " font-weight=\"bold\"" : "",
        xml_text(words.text));
  }

  std::string finish() { return text_ + "</svg>\n"; }

 private:
  std::string text_;
};

}  // namespace

std::string print_svg(const Chart& chart) {
  const ChartSheet sheet = lay_out(chart);
  SvgWriter writer(sheet);
  for (const SheetPiece& piece : sheet.pieces) std::visit(writer, piece);
  return writer.finish();
}

}  // namespace hallway::study
