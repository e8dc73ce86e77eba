// SPDX-License-Identifier: MIT
#include "import/ply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "import/point_records.hpp"

namespace hallway::import {
namespace {

enum class Form { kText, kLittle, kBig };

/// What the header says of the vertices.
struct Header {
  std::optional<Form> form;
  std::optional<std::uint64_t> vertices;
  bool in_vertex = false;  ///< the properties that follow are a vertex's
  std::size_t properties = 0;
  std::uint64_t bytes = 0;  ///< of one vertex
  Coordinates coordinates;
};

std::optional<Scalar> scalar_named(std::string_view name) {
  constexpr std::pair<std::string_view, Scalar> kNames[] = {
      {"float", Scalar::kFloat32},   {"float32", Scalar::kFloat32}, {"double", Scalar::kFloat64},
      {"float64", Scalar::kFloat64}, {"char", Scalar::kInt8},       {"int8", Scalar::kInt8},
      {"uchar", Scalar::kUint8},     {"uint8", Scalar::kUint8},     {"short", Scalar::kInt16},
      {"int16", Scalar::kInt16},     {"ushort", Scalar::kUint16},   {"uint16", Scalar::kUint16},
      {"int", Scalar::kInt32},       {"int32", Scalar::kInt32},     {"uint", Scalar::kUint32},
      {"uint32", Scalar::kUint32}};
  for (const auto& [known, type] : kNames) {
    if (known == name) return type;
  }
  return std::nullopt;
}

void read_format(const WordLines& lines, Header& header) {
  const auto& words = lines.words();
  const std::string_view name = words.size() > 1 ? words[1] : std::string_view();
  if (name == "ascii") header.form = Form::kText;
  if (name == "binary_little_endian") header.form = Form::kLittle;
  if (name == "binary_big_endian") header.form = Form::kBig;
  if (!header.form) throw lines.error(fmt::format("unknown format \"{}\"", printable(name, 40)));
}

void read_element(const WordLines& lines, Header& header) {
  const auto& words = lines.words();
  if (words.size() != 3) throw lines.error("an element has a name and a number");
  header.in_vertex = words[1] == "vertex";
  if (header.in_vertex && header.vertices) throw lines.error("the element vertex stands there twice");
  if (header.in_vertex) {
    header.vertices = lines.whole(2, kMaxCloudBytes);
  } else if (!header.vertices) {
    throw lines.error(fmt::format("the first element is \"{}\"; vertex is read only as the first",
                                  printable(words[1], 40)));
  }
}

void read_property(const WordLines& lines, Header& header) {
  if (!header.in_vertex) return;
  const auto& words = lines.words();
  if (words.size() > 1 && words[1] == "list") throw lines.error("vertices with lists are not read");
  const auto type = words.size() == 3 ? scalar_named(words[1]) : std::nullopt;
  if (!type) throw lines.error("a property has a type such as float and a name");
  if (Coordinate* coordinate = coordinate_named(header.coordinates, words[2])) {
    if (coordinate->found) throw lines.error(fmt::format("a vertex has {} twice", words[2]));
    *coordinate = {.found = true, .type = *type, .word = header.properties, .begin = header.bytes};
  }
  ++header.properties;
  header.bytes += size_of(*type);
}

Header read_header(WordLines& lines) {
  Header header;
  if (!lines.next() || lines.line() != "ply")
    throw lines.error("is no PLY file: the first line is not \"ply\"");
  for (;;) {
    if (!lines.next()) throw lines.error("the header has no end_header: the file seems to be cut off");
    const std::string_view keyword = lines.words().front();
    if (keyword == "end_header") break;
    if (keyword == "format") {
      read_format(lines, header);
    } else if (keyword == "element") {
      read_element(lines, header);
    } else if (keyword == "property") {
      read_property(lines, header);
    } else if (keyword != "comment" && keyword != "obj_info") {
      throw lines.error(fmt::format("\"{}\" is no word of a PLY header", printable(keyword, 40)));
    }
  }
  if (!header.form || !header.vertices) throw lines.error("the header names no format or no vertices");
  for (Coordinate& coordinate : header.coordinates) {
    if (!coordinate.found) throw lines.error("the vertices have no properties x, y and z");
    coordinate.step = header.bytes;
  }
  return header;
}

}  // namespace

void read_ply(std::string_view content, const std::string& file, PointCollector& out) {
  WordLines lines(content, file);
  const Header header = read_header(lines);
  if (*header.form == Form::kText) {
    read_text_points(lines, *header.vertices, header.properties, header.coordinates, out);
    return;
  }
  const std::string_view bytes = lines.rest();
  if (*header.vertices > bytes.size() / header.bytes) {
    throw lines.error(
        fmt::format("{} vertices of {} bytes follow, and {} bytes are there: the file is cut off",
                    *header.vertices, header.bytes, bytes.size()));
  }
  read_binary_points(bytes, *header.vertices, header.coordinates,
                     *header.form == Form::kBig ? ByteOrder::kBig : ByteOrder::kLittle, out);
}

}  // namespace hallway::import
