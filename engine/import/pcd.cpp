// SPDX-License-Identifier: MIT
#include "import/pcd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "base/text.hpp"
#include "import/lzf.hpp"
#include "import/point_records.hpp"

namespace hallway::import {
namespace {

constexpr std::size_t kMaxFields = 1000;
constexpr std::uint64_t kMaxFieldValues = 65'536;  ///< of one field: a histogram has hundreds

struct Field {
  std::string_view name;
  std::uint64_t size = 0;   ///< bytes of a value
  char type = 0;            ///< I, U or F
  std::uint64_t count = 1;  ///< values
  std::uint64_t bytes() const { return size * count; }
};

struct Header {
  std::vector<Field> fields;
  bool sized = false, typed = false;
  std::optional<std::uint64_t> width, height, points;
  std::string_view data;

  std::uint64_t point_bytes() const {
    std::uint64_t sum = 0;
    for (const Field& field : fields) sum += field.bytes();
    return sum;
  }
};

std::optional<Scalar> scalar_of(const Field& field) {
  const auto pick = [&](std::array<Scalar, 4> by_size) -> std::optional<Scalar> {
    for (std::size_t i = 0; i < by_size.size(); ++i) {
      if (field.size == 1u << i) return by_size[i];
    }
    return std::nullopt;
  };
  if (field.type == 'I') return pick({Scalar::kInt8, Scalar::kInt16, Scalar::kInt32, Scalar::kInt64});
  if (field.type == 'U') return pick({Scalar::kUint8, Scalar::kUint16, Scalar::kUint32, Scalar::kUint64});
  if (field.size == 4) return Scalar::kFloat32;
  return field.size == 8 ? std::optional(Scalar::kFloat64) : std::nullopt;
}

/// Lines with a word for each field.
void expect_a_word_each(const WordLines& lines, const Header& header) {
  if (header.fields.empty()) throw lines.error("FIELDS must stand before it");
  if (lines.words().size() == header.fields.size() + 1) return;
  throw lines.error(fmt::format("{} values for {} fields", lines.words().size() - 1, header.fields.size()));
}

void read_fields(const WordLines& lines, Header& header) {
  if (!header.fields.empty()) throw lines.error("FIELDS stands there twice");
  if (lines.words().size() > kMaxFields)
    throw lines.error(fmt::format("more than {} fields", kMaxFields - 1));
  for (std::size_t i = 1; i < lines.words().size(); ++i) header.fields.push_back({.name = lines.words()[i]});
}

void read_types(const WordLines& lines, Header& header) {
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    const std::string_view word = lines.words()[i + 1];
    if (word != "I" && word != "U" && word != "F") {
      throw lines.error(fmt::format("I, U or F is needed, \"{}\" found", printable(word, 40)));
    }
    header.fields[i].type = word.front();
  }
  header.typed = true;
}

/// @return false at the last line of the header
bool read_line(const WordLines& lines, Header& header) {
  const std::string_view keyword = lines.words().front();
  if (keyword == "FIELDS" || keyword == "COLUMNS") {
    read_fields(lines, header);
  } else if (keyword == "SIZE") {
    expect_a_word_each(lines, header);
    for (std::size_t i = 0; i < header.fields.size(); ++i) header.fields[i].size = lines.whole(i + 1, 8);
    header.sized = true;
  } else if (keyword == "TYPE") {
    expect_a_word_each(lines, header);
    read_types(lines, header);
  } else if (keyword == "COUNT") {
    expect_a_word_each(lines, header);
    for (std::size_t i = 0; i < header.fields.size(); ++i) {
      header.fields[i].count = lines.whole(i + 1, kMaxFieldValues);
    }
  } else if (keyword == "WIDTH") {
    header.width = lines.whole(1, kMaxCloudBytes);
  } else if (keyword == "HEIGHT") {
    header.height = lines.whole(1, kMaxCloudBytes);
  } else if (keyword == "POINTS") {
    header.points = lines.whole(1, kMaxCloudBytes);
  } else if (keyword == "DATA") {
    header.data = lines.words().size() > 1 ? lines.words()[1] : std::string_view();
    return false;
  } else if (keyword != "VERSION" && keyword != "VIEWPOINT" && !keyword.starts_with('#')) {
    throw lines.error(fmt::format("\"{}\" is no word of a PCD header", printable(keyword, 40)));
  }
  return true;
}

Header read_header(WordLines& lines) {
  Header header;
  do {
    if (!lines.next()) throw lines.error("the header has no line DATA: the file seems to be cut off");
  } while (read_line(lines, header));
  if (header.fields.empty() || !header.sized || !header.typed || !header.width) {
    throw lines.error("the header lacks FIELDS, SIZE, TYPE or WIDTH");
  }
  const std::uint64_t area = *header.width * header.height.value_or(1);
  if (!header.points) header.points = area;
  if (*header.points != area || area > kMaxCloudBytes) {
    throw lines.error(fmt::format("{} points where WIDTH and HEIGHT give {}", *header.points, area));
  }
  return header;
}

/// @param planar  each field's values of all points stand together
Coordinates find_coordinates(const WordLines& lines, const Header& header, bool planar) {
  Coordinates coordinates;
  std::size_t word = 0;
  std::uint64_t offset = 0;
  for (const Field& field : header.fields) {
    if (Coordinate* coordinate = coordinate_named(coordinates, field.name)) {
      const auto type = scalar_of(field);
      if (!type || field.count != 1 || coordinate->found) {
        throw lines.error(fmt::format("field {} is no one number of a known size", field.name));
      }
      *coordinate = {.found = true,
                     .type = *type,
                     .word = word,
                     .begin = planar ? offset * *header.points : offset,
                     .step = planar ? field.bytes() : header.point_bytes()};
    }
    word += static_cast<std::size_t>(field.count);
    offset += field.bytes();
  }
  for (const Coordinate& coordinate : coordinates) {
    if (!coordinate.found) throw lines.error("the points have no fields x, y and z");
  }
  return coordinates;
}

/// The points as they stand behind the two lengths.
std::string decompress(const WordLines& lines, const Header& header) {
  std::string_view bytes = lines.rest();
  std::uint32_t packed = 0, unpacked = 0;
  if (bytes.size() < 2 * sizeof packed) throw lines.error("the file is cut off before the points");
  std::memcpy(&packed, bytes.data(), sizeof packed);
  std::memcpy(&unpacked, bytes.data() + sizeof packed, sizeof unpacked);
  bytes.remove_prefix(2 * sizeof packed);
  const std::uint64_t needed = *header.points * header.point_bytes();
  if (unpacked != needed) {
    throw lines.error(
        fmt::format("{} points take {} bytes, and {} are compressed", *header.points, needed, unpacked));
  }
  if (packed > bytes.size()) {
    throw lines.error(fmt::format("{} compressed bytes follow, and {} are there: the file is cut off", packed,
                                  bytes.size()));
  }
  try {
    return decompress_lzf(bytes.substr(0, packed), unpacked);
  } catch (const Error& error) {
    throw lines.error(error.message());
  }
}

void read_binary(const WordLines& lines, const Header& header, const Coordinates& coordinates,
                 PointCollector& out) {
  const std::string_view bytes = lines.rest();
  if (*header.points > bytes.size() / header.point_bytes()) {
    throw lines.error(fmt::format("{} points of {} bytes follow, and {} bytes are there: the file is cut off",
                                  *header.points, header.point_bytes(), bytes.size()));
  }
  read_binary_points(bytes, *header.points, coordinates, ByteOrder::kLittle, out);
}

}  // namespace

void read_pcd(std::string_view content, const std::string& file, PointCollector& out) {
  WordLines lines(content, file);
  const Header header = read_header(lines);
  const Coordinates coordinates = find_coordinates(lines, header, header.data == "binary_compressed");
  if (header.height.value_or(1) > 1) out.begin_image(*header.width, *header.height);
  if (header.data == "ascii") {
    std::size_t words = 0;
    for (const Field& field : header.fields) words += static_cast<std::size_t>(field.count);
    read_text_points(lines, *header.points, words, coordinates, out);
  } else if (header.data == "binary") {
    read_binary(lines, header, coordinates, out);
  } else if (header.data == "binary_compressed") {
    const std::string points = decompress(lines, header);
    read_binary_points(points, *header.points, coordinates, ByteOrder::kLittle, out);
  } else {
    throw lines.error(fmt::format("unknown form of data \"{}\"", printable(header.data, 40)));
  }
}

}  // namespace hallway::import
