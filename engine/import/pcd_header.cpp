// SPDX-License-Identifier: MIT
#include "import/pcd_header.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <optional>

#include "base/text.hpp"
#include "import/lzf.hpp"

namespace hallway::import {
namespace {

constexpr std::size_t kMaxFields = 1000;
constexpr std::uint64_t kMaxFieldValues = 65'536;  ///< of one field: a histogram has hundreds

/// What the lines of a header have said so far.
struct HeaderParts {
  std::vector<PcdField> fields;
  bool sized = false, typed = false;
  std::optional<std::uint64_t> width, height, points;
  std::string_view data;
};

std::optional<Scalar> scalar_of(const PcdField& field) {
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
void expect_a_word_each(const WordLines& lines, const HeaderParts& header) {
  if (header.fields.empty()) throw lines.error("FIELDS must stand before it");
  if (lines.words().size() == header.fields.size() + 1) return;
  throw lines.error(fmt::format("{} values for {} fields", lines.words().size() - 1, header.fields.size()));
}

void read_fields(const WordLines& lines, HeaderParts& header) {
  if (!header.fields.empty()) throw lines.error("FIELDS stands there twice");
  if (lines.words().size() > kMaxFields)
    throw lines.error(fmt::format("more than {} fields", kMaxFields - 1));
  for (std::size_t i = 1; i < lines.words().size(); ++i) header.fields.push_back({.name = lines.words()[i]});
}

void read_types(const WordLines& lines, HeaderParts& header) {
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
bool read_header_line(const WordLines& lines, HeaderParts& header) {
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

PcdData data_named(const WordLines& lines, std::string_view name) {
  if (name == "ascii") return PcdData::kAscii;
  if (name == "binary") return PcdData::kBinary;
  if (name == "binary_compressed") return PcdData::kCompressed;
  throw lines.error(fmt::format("unknown form of data \"{}\"", printable(name, 40)));
}

/// The points as they are behind the two lengths.
std::string decompress(const WordLines& lines, const PcdHeader& header) {
  std::string_view bytes = lines.rest();
  std::uint32_t packed = 0, unpacked = 0;
  if (bytes.size() < 2 * sizeof packed) throw lines.error("the file is cut off before the points");
  std::memcpy(&packed, bytes.data(), sizeof packed);
  std::memcpy(&unpacked, bytes.data() + sizeof packed, sizeof unpacked);
  bytes.remove_prefix(2 * sizeof packed);
  const std::uint64_t needed = header.points * header.point_bytes();
  if (unpacked != needed) {
    throw lines.error(
        fmt::format("{} points take {} bytes, and {} are compressed", header.points, needed, unpacked));
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

}  // namespace

std::uint64_t PcdHeader::point_bytes() const {
  std::uint64_t sum = 0;
  for (const PcdField& field : fields) sum += field.bytes();
  return sum;
}

std::size_t PcdHeader::point_words() const {
  std::size_t sum = 0;
  for (const PcdField& field : fields) sum += static_cast<std::size_t>(field.count);
  return sum;
}

PcdHeader read_pcd_header(WordLines& lines) {
  HeaderParts parts;
  do {
    if (!lines.next()) throw lines.error("the header has no line DATA: the file seems to be cut off");
  } while (read_header_line(lines, parts));
  if (parts.fields.empty() || !parts.sized || !parts.typed || !parts.width) {
    throw lines.error("the header lacks FIELDS, SIZE, TYPE or WIDTH");
  }
  PcdHeader header;
  header.width = *parts.width;
  header.height = parts.height.value_or(1);
  const std::uint64_t area = header.width * header.height;
  header.points = parts.points.value_or(area);
  if (header.points != area || area > kMaxCloudBytes) {
    throw lines.error(fmt::format("{} points where WIDTH and HEIGHT give {}", header.points, area));
  }
  header.fields = std::move(parts.fields);
  header.data = data_named(lines, parts.data);
  return header;
}

Coordinate find_pcd_field(const WordLines& lines, const PcdHeader& header, std::string_view name) {
  const bool planar =
      header.data == PcdData::kCompressed;  // the values of a field of all points are together
  Coordinate place;
  std::size_t word = 0;
  std::uint64_t offset = 0;
  for (const PcdField& field : header.fields) {
    if (field.name == name) {
      const auto type = scalar_of(field);
      if (!type || field.count != 1 || place.found) {
        throw lines.error(fmt::format("field {} is no one number of a known size", field.name));
      }
      place = {.found = true,
               .type = *type,
               .word = word,
               .begin = planar ? offset * header.points : offset,
               .step = planar ? field.bytes() : header.point_bytes()};
    }
    word += static_cast<std::size_t>(field.count);
    offset += field.bytes();
  }
  return place;
}

Coordinates find_pcd_coordinates(const WordLines& lines, const PcdHeader& header) {
  Coordinates coordinates;
  for (std::size_t axis = 0; axis < coordinates.size(); ++axis) {
    coordinates[axis] = find_pcd_field(lines, header, std::string_view("xyz").substr(axis, 1));
  }
  for (const Coordinate& coordinate : coordinates) {
    if (!coordinate.found) throw lines.error("the points have no fields x, y and z");
  }
  return coordinates;
}

std::string_view pcd_point_bytes(const WordLines& lines, const PcdHeader& header, std::string& unpacked) {
  if (header.data == PcdData::kCompressed) {
    unpacked = decompress(lines, header);
    return unpacked;
  }
  const std::string_view bytes = lines.rest();
  if (header.points > bytes.size() / header.point_bytes()) {
    throw lines.error(fmt::format("{} points of {} bytes follow, and {} bytes are there: the file is cut off",
                                  header.points, header.point_bytes(), bytes.size()));
  }
  return bytes;
}

}  // namespace hallway::import
