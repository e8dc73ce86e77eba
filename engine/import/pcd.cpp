// SPDX-License-Identifier: MIT
#include "import/pcd.hpp"

#include "import/pcd_header.hpp"

namespace hallway::import {

void read_pcd(std::string_view content, const std::string& file, PointCollector& out) {
  WordLines lines(content, file);
  const PcdHeader header = read_pcd_header(lines);
  const Coordinates coordinates = find_pcd_coordinates(lines, header);
  if (header.height > 1) out.begin_image(header.width, header.height);
  if (header.data == PcdData::kAscii) {
    read_text_points(lines, header.points, header.point_words(), coordinates, out);
    return;
  }
  std::string unpacked;
  const std::string_view bytes = pcd_point_bytes(lines, header, unpacked);
  read_binary_points(bytes, header.points, coordinates, ByteOrder::kLittle, out);
}

}  // namespace hallway::import
