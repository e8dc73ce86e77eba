// SPDX-License-Identifier: MIT
//
// PDF 1.4 (Adobe, PDF Reference, third edition) with what a page of lines, areas and texts needs: six objects and a table of where
// they begin.
#include <fmt/format.h>

#include "editor/plan_sheet.hpp"

namespace hallway::editor {
namespace {

constexpr double kPointsPerMm = 72.0 / 25.4;

/// A string object. Latin-1 stands in WinAnsiEncoding where it stands in Unicode.
std::string pdf_text(std::string_view utf8) {
  std::string out = "(";
  for (const std::uint32_t code : code_points(utf8)) {
    if (code == '(' || code == ')' || code == '\\') {
      out += '\\';
      out += static_cast<char>(code);
    } else if (code >= 0x20 && code < 0x7F) {
      out += static_cast<char>(code);
    } else if (code >= 0xA0 && code <= 0xFF) {
      out += fmt::format("\\{:03o}", code);
    } else {
      out += '?';
    }
  }
  return out + ")";
}

std::string colour_operands(const SheetColour& colour) {
  return fmt::format("{} {} {}", sheet_number(colour.r / 255.0), sheet_number(colour.g / 255.0),
                     sheet_number(colour.b / 255.0));
}

/// The operators that draw a page, in millimetres.
class Content {
 public:
  explicit Content(const Sheet& sheet) {
    const std::string factor = fmt::format("{:.12f}", kPointsPerMm);
    out_ = fmt::format("{0} 0 0 {0} 0 0 cm\n1 j\n", factor);
    for (const SheetLayer& layer : sheet.layers) {
      for (const auto& item : layer.items) std::visit([this](const auto& one) { add(one); }, item);
    }
  }
  const std::string& text() const { return out_; }

 private:
  void add_points(const std::vector<Vec2>& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      out_ += fmt::format("{} {} {}\n", sheet_number(points[i].x()), sheet_number(points[i].y()),
                          i == 0 ? "m" : "l");
    }
  }

  void add(const SheetLine& line) {
    out_ += fmt::format("{} RG {} w [", colour_operands(line.pen.colour), sheet_number(line.pen.width_mm));
    if (line.pen.dash_mm > 0.0) out_ += sheet_number(line.pen.dash_mm) + " " + sheet_number(line.pen.gap_mm);
    out_ += "] 0 d\n";
    add_points(line.points);
    out_ += "S\n";
  }

  void add(const SheetFill& fill) {
    out_ += colour_operands(fill.colour) + " rg\n";
    for (const auto& loop : fill.loops) {
      add_points(loop);
      out_ += "h\n";
    }
    out_ += "f*\n";
  }

  void add(const SheetText& text) {
    const double width = text_width_mm(text.text, text.size_mm);
    const double back = text.anchor == SheetText::Anchor::kStart    ? 0.0
                        : text.anchor == SheetText::Anchor::kMiddle ? width / 2.0
                                                                    : width;
    const Vec2 at =
        text.upwards ? Vec2(text.at.x(), text.at.y() - back) : Vec2(text.at.x() - back, text.at.y());
    out_ += fmt::format("{} rg BT /F1 {} Tf {} {} {} Tm {} Tj ET\n", colour_operands(text.colour),
                        sheet_number(text.size_mm), text.upwards ? "0 1 -1 0" : "1 0 0 1",
                        sheet_number(at.x()), sheet_number(at.y()), pdf_text(text.text));
  }

  std::string out_;
};

}  // namespace

std::string to_pdf(const Sheet& sheet) {
  const std::string content = Content(sheet).text();
  const std::vector<std::string> objects{
      "<< /Type /Catalog /Pages 2 0 R >>",
      "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
      fmt::format("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {} {}] /Contents 4 0 R "
                  "/Resources << /Font << /F1 5 0 R >> >> >>",
                  sheet_number(sheet.width_mm * kPointsPerMm), sheet_number(sheet.height_mm * kPointsPerMm)),
      fmt::format("<< /Length {} >>\nstream\n{}\nendstream", content.size(), content),
      "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica /Encoding /WinAnsiEncoding >>",
      fmt::format("<< /Title {} >>", pdf_text(sheet.title))};
  std::string out = "%PDF-1.4\n";
  std::string table = fmt::format("xref\n0 {}\n0000000000 65535 f \n", objects.size() + 1);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    table += fmt::format("{:010} 00000 n \n", out.size());
    out += fmt::format("{} 0 obj\n{}\nendobj\n", i + 1, objects[i]);
  }
  const std::size_t table_at = out.size();
  out += table;
  out += fmt::format("trailer\n<< /Size {} /Root 1 0 R /Info 6 0 R >>\nstartxref\n{}\n%%EOF\n",
                     objects.size() + 1, table_at);
  return out;
}

}  // namespace hallway::editor
