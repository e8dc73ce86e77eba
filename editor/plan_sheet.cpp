// SPDX-License-Identifier: MIT
#include "editor/plan_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/utf8.hpp"
#include "base/xml_text.hpp"

namespace hallway::editor {
namespace {

/// Advance widths of Helvetica for U+0020 to U+007E, thousandths of the size (Adobe's font metrics).
constexpr std::array<std::uint16_t, 95> kAdvance{
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333,  278, 278, 556, 556, 556,
    556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667,
    611, 778, 722, 278, 500, 667, 556, 833, 722, 778, 667, 778, 722, 667,  611, 722, 667, 944, 667,
    667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278,  556, 556, 222, 222, 500,
    222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500,  500, 334, 260, 334, 584};
constexpr double kOtherAdvance = 556.0;

std::string hex(const SheetColour& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour.r, colour.g, colour.b);
}

class SvgWriter {
 public:
  explicit SvgWriter(const Sheet& sheet) : sheet_(sheet) {}

  std::string write() {
    const std::string width = sheet_number(sheet_.width_mm), height = sheet_number(sheet_.height_mm);
    out_ = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    out_ += fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"{0}mm\" height=\"{1}mm\" "
        "viewBox=\"0 0 {0} {1}\">\n",
        width, height);
    out_ += fmt::format("<title>{}</title>\n", xml_text(sheet_.title));
    out_ += fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>\n", width, height);
    for (const SheetLayer& layer : sheet_.layers) {
      out_ += fmt::format("<g class=\"{}\">\n", xml_text(layer.name));
      for (const auto& item : layer.items) std::visit([this](const auto& one) { add(one); }, item);
      out_ += "</g>\n";
    }
    return out_ + "</svg>\n";
  }

 private:
  void add_points(const std::vector<Vec2>& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      out_ += fmt::format("{}{} {}", i == 0 ? "M" : " L", sheet_number(points[i].x()),
                          sheet_number(sheet_.height_mm - points[i].y()));
    }
  }

  void add(const SheetLine& line) {
    out_ += "<path d=\"";
    add_points(line.points);
    out_ += fmt::format("\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"",
                        hex(line.pen.colour), sheet_number(line.pen.width_mm));
    if (line.pen.dash_mm > 0.0) {
      out_ += fmt::format(" stroke-dasharray=\"{} {}\"", sheet_number(line.pen.dash_mm),
                          sheet_number(line.pen.gap_mm));
    }
    out_ += "/>\n";
  }

  void add(const SheetFill& fill) {
    out_ += "<path d=\"";
    for (const auto& loop : fill.loops) {
      add_points(loop);
      out_ += " Z";
    }
    out_ += fmt::format("\" fill=\"{}\" fill-rule=\"evenodd\"/>\n", hex(fill.colour));
  }

  void add(const SheetText& text) {
    const std::string x = sheet_number(text.at.x()), y = sheet_number(sheet_.height_mm - text.at.y());
    out_ += fmt::format(
        "<text x=\"{}\" y=\"{}\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"{}\" fill=\"{}\"",
        x, y, sheet_number(text.size_mm), hex(text.colour));
    if (text.anchor != SheetText::Anchor::kStart) {
      out_ +=
          fmt::format(" text-anchor=\"{}\"", text.anchor == SheetText::Anchor::kMiddle ? "middle" : "end");
    }
    if (text.upwards) out_ += fmt::format(" transform=\"rotate(-90 {} {})\"", x, y);
    out_ += fmt::format(">{}</text>\n", xml_text(text.text));
  }

  const Sheet& sheet_;
  std::string out_;
};

}  // namespace

std::vector<std::uint32_t> code_points(std::string_view utf8) {
  constexpr std::uint32_t kReplacement = 0xFFFD;
  std::vector<std::uint32_t> codes;
  while (!utf8.empty()) {
    const Utf8Code code = first_utf8_code(utf8);
    codes.push_back(code.length > 0 ? static_cast<std::uint32_t>(code.value) : kReplacement);
    utf8.remove_prefix(std::max<std::size_t>(code.length, 1));
  }
  return codes;
}

double text_width_mm(std::string_view utf8, double size_mm) {
  double sum = 0.0;
  for (const std::uint32_t code : code_points(utf8))
    sum += code >= 0x20 && code < 0x7F ? kAdvance[code - 0x20] : kOtherAdvance;
  return sum * size_mm / 1000.0;
}

std::string sheet_number(double value) {
  std::string text = fmt::format("{:.6f}", value);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string to_svg(const Sheet& sheet) {
  return SvgWriter(sheet).write();
}

}  // namespace hallway::editor
