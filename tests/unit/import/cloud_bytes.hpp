// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"

namespace hallway::test {

using Points = std::vector<std::array<double, 3>>;

/// The bytes of a number, least first or most first.
template <typename T>
std::string bytes_of(T value, bool big_endian = false) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

/// Points that 32-bit floats hold exactly, so that all forms of a file can say the same.
inline Points exact_points(std::size_t count) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const auto n = static_cast<double>(i);
    points.push_back({0.125 * n, -1.0 - 0.0625 * n, 3.5 + static_cast<double>(i % 7)});
  }
  return points;
}

inline std::string ply_header(std::string_view format, std::size_t count, std::string_view type) {
  return fmt::format(
      "ply\nformat {} 1.0\ncomment made by hand\nelement vertex {}\nproperty uchar red\nproperty {} x\n"
      "property {} y\nproperty {} z\nproperty int id\nelement face 0\nproperty list uchar int "
      "vertex_indices\n"
      "end_header\n",
      format, count, type, type, type);
}

inline std::string ascii_ply(const Points& points) {
  std::string text = ply_header("ascii", points.size(), "double");
  for (const auto& [x, y, z] : points) {
    text += fmt::format("255 {} {} {} 7\n", format_double(x), format_double(y), format_double(z));
  }
  return text;
}

/// @tparam T  float or double
template <typename T>
std::string binary_ply(const Points& points, bool big_endian = false) {
  std::string bytes = ply_header(big_endian ? "binary_big_endian" : "binary_little_endian", points.size(),
                                 sizeof(T) == 4 ? "float" : "double");
  for (const auto& point : points) {
    bytes += '\xff';
    for (const double value : point) bytes += bytes_of(static_cast<T>(value), big_endian);
    bytes += bytes_of(std::int32_t{7}, big_endian);
  }
  return bytes;
}

inline std::string pcd_header(std::size_t count, std::size_t size, std::string_view data) {
  return fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS label x y z n\nSIZE 4 {} {} {} 2\n"
      "TYPE U F F F I\nCOUNT 1 1 1 1 3\nWIDTH {}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA {}\n",
      size, size, size, count, count, data);
}

inline std::string ascii_pcd(const Points& points) {
  std::string text = pcd_header(points.size(), 8, "ascii");
  for (const auto& [x, y, z] : points) {
    text += fmt::format("3 {} {} {} 1 2 3\n", format_double(x), format_double(y), format_double(z));
  }
  return text;
}

template <typename T>
std::string binary_pcd(const Points& points) {
  std::string bytes = pcd_header(points.size(), sizeof(T), "binary");
  for (const auto& point : points) {
    bytes += bytes_of(std::uint32_t{3});
    for (const double value : point) bytes += bytes_of(static_cast<T>(value));
    bytes += std::string(6, '\1');
  }
  return bytes;
}

/// LZF data that gives `bytes`: repeats the longest match among the last bytes, else literals. Slow, and only here to be undone.
inline std::string compress_lzf(std::string_view bytes) {
  constexpr std::size_t kFarthest = 300, kLongest = 264, kMostLiterals = 32;
  std::string out, literals;
  const auto flush = [&] {
    if (literals.empty()) return;
    out += static_cast<char>(literals.size() - 1);
    out += literals;
    literals.clear();
  };
  for (std::size_t i = 0; i < bytes.size();) {
    std::size_t best = 0, distance = 0;
    for (std::size_t back = 1; back <= std::min(i, kFarthest); ++back) {
      std::size_t length = 0;
      while (length < kLongest && i + length < bytes.size() && bytes[i + length] == bytes[i + length - back])
        ++length;
      if (length > best) best = length, distance = back;
    }
    if (best < 3) {
      literals += bytes[i++];
      if (literals.size() == kMostLiterals) flush();
      continue;
    }
    flush();
    const std::size_t far = distance - 1, shown = std::min<std::size_t>(best - 2, 7);
    out += static_cast<char>(shown << 5 | far >> 8);
    if (shown == 7) out += static_cast<char>(best - 2 - 7);
    out += static_cast<char>(far & 0xFF);
    i += best;
  }
  flush();
  return out;
}

template <typename T>
std::string compressed_pcd(const Points& points) {
  std::string planes;
  for (std::size_t i = 0; i < points.size(); ++i) planes += bytes_of(std::uint32_t{3});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const auto& point : points) planes += bytes_of(static_cast<T>(point[axis]));
  }
  planes += std::string(6 * points.size(), '\1');
  const std::string packed = compress_lzf(planes);
  return pcd_header(points.size(), sizeof(T), "binary_compressed") +
         bytes_of(static_cast<std::uint32_t>(packed.size())) +
         bytes_of(static_cast<std::uint32_t>(planes.size())) + packed;
}

}  // namespace hallway::test
