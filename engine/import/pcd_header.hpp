// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "import/point_records.hpp"
#include "import/word_lines.hpp"

namespace hallway::import {

/// A field of the points of a PCD file.
struct PcdField {
  std::string_view name;    ///< in the file's text
  std::uint64_t size = 0;   ///< bytes of a value
  char type = 0;            ///< I, U or F
  std::uint64_t count = 1;  ///< values

  std::uint64_t bytes() const { return size * count; }
};

/// The forms of the points of a PCD file.
enum class PcdData { kAscii, kBinary, kCompressed };

/// The header of a PCD file.
struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint64_t width = 0;
  std::uint64_t height = 1;  ///< above 1: the points are the pixels of an image
  std::uint64_t points = 0;
  PcdData data{};

  std::uint64_t point_bytes() const;
  /// Words of a point's line in text.
  std::size_t point_words() const;
};

/// Reads the header of a PCD file, versions up to 0.7; the points follow the line that `lines` is left at. Throws Error{kBadInput} with the line.
PcdHeader read_pcd_header(WordLines& lines);

/// Where the values of a field are; not found where the points have no such field. Throws Error{kBadInput} for a field that is not one number of a known
/// size, and for one that is there twice.
Coordinate find_pcd_field(const WordLines& lines, const PcdHeader& header, std::string_view name);

/// x, y and z. Throws Error{kBadInput} where one is missing.
Coordinates find_pcd_coordinates(const WordLines& lines, const PcdHeader& header);

/// The bytes of the points of a binary file, in which find_pcd_field() gives places. Throws Error{kBadInput} for a file that is cut off, and for
/// compressed bytes that are damaged.
/// @param unpacked  has the bytes of a compressed file
std::string_view pcd_point_bytes(const WordLines& lines, const PcdHeader& header, std::string& unpacked);

}  // namespace hallway::import
