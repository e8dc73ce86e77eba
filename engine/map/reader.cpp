// SPDX-License-Identifier: MIT
#include "map/reader.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "map/texture_axes.hpp"
#include "map/tokenizer.hpp"
#include "map/world.hpp"

namespace hallway::map {
namespace {

/// Recursive descent without recursion: a map is entities, an entity is keys and brushes, a brush is faces.
class Reader {
 public:
  Reader(std::string_view text, const std::string& file) : tokens_(text) { document_.file = file; }

  Document read() {
    while (tokens_.peek() != '\0') read_entity();
    document_.closing_comments = tokens_.take_comments();
    return std::move(document_);
  }

  /// "entity 3, brush 7" for what is being read, empty outside entities.
  std::string element() const {
    if (!in_entity_) return {};
    const int entity = static_cast<int>(document_.entities.size()) - 1;
    if (!in_brush_) return "entity " + std::to_string(entity);
    return brush_name(entity, static_cast<int>(document_.entities.back().brushes.size()) - 1);
  }

 private:
  void read_entity() {
    tokens_.expect('{', "to begin an entity");
    in_entity_ = true;
    Entity& entity = document_.entities.emplace_back();
    entity.line = tokens_.line();
    entity.comments = tokens_.take_comments();
    while (!tokens_.accept('}')) {
      const char next = tokens_.peek();
      if (next == '"') {
        read_key(entity);
      } else if (next == '{') {
        read_brush(entity);
      } else {
        if (next == '(') refuse_loose_face();
        fail_unclosed("the entity", entity.line, "a quoted key, `{` or `}`");
      }
    }
    entity.closing_comments = tokens_.take_comments();
    in_entity_ = false;
  }

  void read_key(Entity& entity) {
    KeyValue pair;
    pair.comments = tokens_.take_comments();
    pair.line = tokens_.line();
    pair.key = tokens_.quoted(Tokenizer::Quoted::kName, "the key");
    if (tokens_.peek() != '"') {
      throw SyntaxFault{pair.line, "key `" + printable(pair.key, 60) + "` has no value in quotation marks"};
    }
    pair.value = tokens_.quoted(Tokenizer::Quoted::kValue, "the value of `" + printable(pair.key, 60) + "`");
    entity.keys.push_back(std::move(pair));
  }

  void read_brush(Entity& entity) {
    tokens_.expect('{', "to begin a brush");
    in_brush_ = true;
    Brush& brush = entity.brushes.emplace_back();
    brush.line = tokens_.line();
    brush.comments = tokens_.take_comments();
    const char first = tokens_.peek();
    if (first == '(' || first == '}') {
      read_faces(brush, FaceForm::kAxes);
    } else {
      read_other_shape(brush);
      if (!tokens_.accept('}')) fail_unclosed("the brush", brush.line, "`}`");
    }
    brush.closing_comments = tokens_.take_comments();
    in_brush_ = false;
  }

  /// How the faces of a brush say where the texture lies.
  enum class FaceForm { kAxes, kMatrix };

  /// Up to and with the closing brace.
  void read_faces(Brush& brush, FaceForm form) {
    while (!tokens_.accept('}')) {
      if (tokens_.peek() != '(') {
        refuse_other_shapes();
        fail_unclosed("the brush", brush.line, "`(` of a face or `}`");
      }
      brush.faces.push_back(read_face(form));
    }
  }

  /// What begins with a word: brush primitives are read, and patches and the like kept as they stand.
  void read_other_shape(Brush& brush) {
    const std::string word = tokens_.describe_next();
    if (word == "`brushDef`") {
      tokens_.take_word();
      tokens_.expect('{', "after `brushDef`");
      read_faces(brush, FaceForm::kMatrix);
    } else if (is_shape(word)) {
      for (std::string& comment : tokens_.take_comments()) brush.comments.push_back(std::move(comment));
      brush.unread = tokens_.block();
    } else {
      refuse_other_shapes();
      fail_unclosed("the brush", brush.line, "`(` of a face or `}`");
    }
  }

  static bool is_shape(std::string_view quoted_word) {
    return quoted_word.starts_with("`brushDef") || quoted_word.starts_with("`patchDef");
  }

  Face read_face(FaceForm form) {
    Face face;
    face.comments = tokens_.take_comments();
    face.line = tokens_.line();
    for (Vec3& point : face.points) {
      tokens_.expect('(', "to begin a point of the face");
      for (double& coordinate : point) coordinate = tokens_.number("a coordinate of the face");
      tokens_.expect(')', "after the three coordinates of a point");
    }
    if (form == FaceForm::kMatrix) face.texture_matrix = read_matrix();
    face.material = tokens_.material();
    if (form == FaceForm::kMatrix) {
      set_standard_axes(face);
    } else if (tokens_.number_follows()) {
      read_standard_texture(face);
    } else {
      read_valve_texture(face);
    }
    if (tokens_.number_follows() && !is_shape(tokens_.describe_next())) face.surface_flags = read_flags();
    return face;
  }

  std::array<double, 6> read_matrix() {
    std::array<double, 6> matrix{};
    tokens_.expect('(', "to begin the texture's matrix");
    for (std::size_t i = 0; i < matrix.size(); ++i) {
      if (i % 3 == 0) tokens_.expect('(', "to begin a row of the texture's matrix");
      matrix[i] = tokens_.number("the texture's matrix");
      if (i % 3 == 2) tokens_.expect(')', "after the three numbers of a row");
    }
    tokens_.expect(')', "after the texture's matrix");
    return matrix;
  }

  void read_standard_texture(Face& face) {
    face.u_offset = tokens_.number("the texture's offset");
    face.v_offset = tokens_.number("the texture's offset");
    read_rotation_and_scale(face);
    if (face.u_scale == 0.0) face.u_scale = 1.0;  // as Quake's compilers do
    if (face.v_scale == 0.0) face.v_scale = 1.0;
    set_standard_axes(face);
  }

  static void set_standard_axes(Face& face) {
    const TextureAxes axes = standard_axes(face.points, face.rotation_deg);
    face.u_axis = axes.u;
    face.v_axis = axes.v;
  }

  void read_valve_texture(Face& face) {
    read_axis(face.u_axis, face.u_offset);
    read_axis(face.v_axis, face.v_offset);
    read_rotation_and_scale(face);
  }

  void read_rotation_and_scale(Face& face) {
    face.rotation_deg = tokens_.number("the texture's rotation");
    face.u_scale = tokens_.number("the texture's scale");
    face.v_scale = tokens_.number("the texture's scale");
  }

  void read_axis(Vec3& axis, double& offset) {
    tokens_.expect('[', "to begin a texture axis");
    for (double& coordinate : axis) coordinate = tokens_.number("a texture axis");
    offset = tokens_.number("the texture's offset");
    tokens_.expect(']', "after the four numbers of a texture axis");
  }

  SurfaceFlags read_flags() {
    SurfaceFlags flags;
    flags.contents = whole(tokens_.number("the surface's contents"));
    if (!tokens_.number_follows()) {
      throw SyntaxFault{
          tokens_.line(),
          "one number after the texture's scale, as Hexen II has it, is not read; three (contents, flags, "
          "value) or none are"};
    }
    flags.flags = whole(tokens_.number("the surface's flags"));
    flags.value = tokens_.number("the surface's value");
    return flags;
  }

  std::int64_t whole(double value) const {
    constexpr double kLargest = 4294967295.0;  // flags are sets of 32 bits, signed or not
    if (value != std::floor(value) || std::abs(value) > kLargest) {
      throw SyntaxFault{tokens_.line(), "`" + format_double(value) + "` is no set of surface flags"};
    }
    return static_cast<std::int64_t>(value);
  }

  void refuse_other_shapes() {
    if (tokens_.peek() == '{') {
      throw SyntaxFault{tokens_.line(), "`{` inside a brush: a brush holds faces only"};
    }
    const std::string word = tokens_.describe_next();
    if (is_shape(word)) {
      throw SyntaxFault{tokens_.line(), word + " after faces: a brush holds faces or one such shape"};
    }
  }

  [[noreturn]] void refuse_loose_face() {
    throw SyntaxFault{
        tokens_.line(),
        "a face that is in no brush; faces stand within the braces of a brush, and brushes within those "
        "of an entity (a brush that was copied from an editor has none)"};
  }

  [[noreturn]] void fail_unclosed(const std::string& what, int begun, const std::string& wanted) {
    const std::string found = tokens_.describe_next();
    throw SyntaxFault{tokens_.line(), "expected " + wanted + ", found " + found + " (" + what +
                                          " begins at line " + std::to_string(begun) + ")"};
  }

  Tokenizer tokens_;
  Document document_;
  bool in_entity_ = false;
  bool in_brush_ = false;
};

}  // namespace

Document parse(std::string_view text, const std::string& file) {
  try {
    Reader reader(text, file);
    try {
      return reader.read();
    } catch (const SyntaxFault& fault) {
      throw Error(ErrorCode::kBadInput, fault.message, {file, fault.line, reader.element()});
    }
  } catch (const SyntaxFault& fault) {  // of the encoding, before there is a reader
    throw Error(ErrorCode::kBadInput, fault.message, {file, fault.line, {}});
  }
}

Document load(const std::filesystem::path& path) {
  return parse(read_file(path, kMaxMapBytes), path.string());
}

}  // namespace hallway::map
