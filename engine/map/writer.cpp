// SPDX-License-Identifier: MIT
#include "map/writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "map/reader.hpp"
#include "map/tokenizer.hpp"
#include "map/world.hpp"

namespace hallway::map {
namespace {

class Writer {
 public:
  explicit Writer(const Document& document) : document_(document) {}

  std::string write() {
    for (const Entity& entity : document_.entities) write_entity(entity);
    element_.clear();
    write_comments(document_.closing_comments);
    return std::move(out_);
  }

 private:
  void write_entity(const Entity& entity) {
    const int index = static_cast<int>(&entity - document_.entities.data());
    element_ = "entity " + std::to_string(index);
    write_comments(entity.comments);
    out_ += "{\n";
    for (const KeyValue& pair : entity.keys) {
      write_comments(pair.comments);
      if (pair.key.ends_with('\\')) fail("a key that ends in a backslash cannot be written");
      write_quoted(pair.key, kMaxKeyBytes);
      out_ += ' ';
      write_quoted(pair.value, kMaxValueBytes);
      out_ += '\n';
    }
    for (std::size_t i = 0; i < entity.brushes.size(); ++i) {
      element_ = brush_name(index, static_cast<int>(i));
      write_brush(entity.brushes[i]);
    }
    write_comments(entity.closing_comments);
    out_ += "}\n";
  }

  void write_brush(const Brush& brush) {
    write_comments(brush.comments);
    out_ += "{\n";
    if (!brush.unread.empty()) {
      write_unread(brush);
    } else if (is_primitive(brush)) {
      out_ += "brushDef\n{\n";
      for (const Face& face : brush.faces) write_face(face, FaceForm::kMatrix);
      out_ += "}\n";
    } else {
      for (const Face& face : brush.faces) write_face(face, FaceForm::kAxes);
    }
    write_comments(brush.closing_comments);
    out_ += "}\n";
  }

  enum class FaceForm { kAxes, kMatrix };

  static bool is_primitive(const Brush& brush) {
    return !brush.faces.empty() && std::all_of(brush.faces.begin(), brush.faces.end(), [](const Face& face) {
      return face.texture_matrix.has_value();
    });
  }

  void write_unread(const Brush& brush) {
    if (!brush.faces.empty()) fail("a brush of faces and another shape cannot be written");
    if (!is_block(brush.unread)) fail("a shape whose text is no word and block in braces cannot be written");
    out_ += brush.unread;
    out_ += '\n';
  }

  static bool is_block(const std::string& text) {
    if (!text.starts_with("brushDef") && !text.starts_with("patchDef")) return false;
    try {
      return Tokenizer(text).describe_next() != "`brushDef`" && Tokenizer(text).block() == text;
    } catch (const SyntaxFault&) {
      return false;
    }
  }

  void write_face(const Face& face, FaceForm form) {
    write_comments(face.comments);
    for (const Vec3& point : face.points) {
      out_ += "( ";
      write_vector(point);
      out_ += ") ";
    }
    if (form == FaceForm::kMatrix) write_matrix(*face.texture_matrix);
    write_material(face.material);
    if (form == FaceForm::kAxes) write_axes(face);
    if (face.surface_flags) {
      out_ += ' ' + std::to_string(face.surface_flags->contents) + ' ' +
              std::to_string(face.surface_flags->flags) + ' ';
      write_number(face.surface_flags->value);
    }
    out_ += '\n';
  }

  void write_matrix(const std::array<double, 6>& matrix) {
    out_ += "( ( ";
    write_vector({matrix[0], matrix[1], matrix[2]});
    out_ += ") ( ";
    write_vector({matrix[3], matrix[4], matrix[5]});
    out_ += ") ) ";
  }

  void write_axes(const Face& face) {
    write_axis(face.u_axis, face.u_offset);
    write_axis(face.v_axis, face.v_offset);
    for (const double number : {face.rotation_deg, face.u_scale, face.v_scale}) {
      out_ += ' ';
      write_number(number);
    }
  }

  void write_axis(const Vec3& axis, double offset) {
    out_ += " [ ";
    write_vector(axis);
    write_number(offset);
    out_ += " ]";
  }

  /// Each coordinate is followed by a space.
  void write_vector(const Vec3& vector) {
    for (const double coordinate : vector) {
      write_number(coordinate);
      out_ += ' ';
    }
  }

  /// Whole numbers are written without an exponent, which not every program that reads maps understands.
  void write_number(double value) {
    if (!std::isfinite(value)) fail("a number that is not finite cannot be written");
    constexpr double kExact = 9007199254740992.0;  // 2^53
    const bool negative_zero = value == 0.0 && std::signbit(value);
    if (value == std::floor(value) && std::abs(value) < kExact && !negative_zero) {
      out_ += std::to_string(static_cast<std::int64_t>(value));
    } else {
      append_double(out_, value);
    }
  }

  void write_material(const std::string& name) {
    const bool bare =
        !name.empty() && name.find_first_of(" \t\r\n\v\f\"") == std::string::npos &&
        !name.starts_with("//") &&
        !(name.size() == 1 && std::string_view("()[]{}").find(name[0]) != std::string_view::npos);
    if (bare && name.size() <= kMaxKeyBytes) {
      check_text(name);
      out_ += name;
    } else {
      if (name.ends_with('\\')) fail("a material with blanks that ends in a backslash cannot be written");
      write_quoted(name, kMaxKeyBytes);
    }
  }

  void write_quoted(std::string_view text, std::size_t limit) {
    check_text(text);
    if (text.size() > limit)
      fail("a text of more than " + std::to_string(limit) + " bytes cannot be written");
    out_ += '"';
    for (const char c : text) {
      if (c == '"') out_ += '\\';
      out_ += c;
    }
    out_ += '"';
  }

  void write_comments(const std::vector<std::string>& comments) {
    for (const std::string& comment : comments) {
      check_text(comment);
      out_ += comment.empty() ? "//" : "// ";
      out_ += comment;
      out_ += '\n';
    }
  }

  void check_text(std::string_view text) const {
    if (text.find_first_of(std::string_view("\n\0", 2)) != std::string_view::npos) {
      fail("a text with a line break or a NUL byte cannot be written");
    }
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw Error(ErrorCode::kBadInput, message, {document_.file, 0, element_});
  }

  const Document& document_;
  std::string out_;
  std::string element_;
};

}  // namespace

std::string print(const Document& document) {
  return Writer(document).write();
}

}  // namespace hallway::map
