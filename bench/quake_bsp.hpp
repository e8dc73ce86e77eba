// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "geometry/se3.hpp"

namespace hallway::bench {

/// What of a compiled Quake map (BSP version 29) tells which points may see each other: another compiler's answer to compare with.
class QuakeBsp {
 public:
  explicit QuakeBsp(const std::filesystem::path& file) : bytes_(read_file(file)) {
    if (get<std::int32_t>(0) != 29) throw std::runtime_error("not a BSP of version 29");
    planes_ = lump(1);
    visibility_ = lump(4);
    nodes_ = lump(5);
    leaves_ = lump(10);
    head_ = get<std::int32_t>(lump(14) + 9 * 4);
    visibility_end_ = visibility_ + get<std::uint32_t>(4 + 4 * 8 + 4);
  }

  /// The leaf that holds a point, in map units.
  std::int32_t leaf_at(const Vec3& point) const {
    std::int32_t at = head_;
    while (at >= 0) {
      const std::size_t node = nodes_ + static_cast<std::size_t>(at) * 24;
      const std::size_t plane = planes_ + static_cast<std::size_t>(get<std::int32_t>(node)) * 20;
      double distance = -get<float>(plane + 12);
      for (std::size_t k = 0; k < 3; ++k)
        distance += get<float>(plane + 4 * k) * point[static_cast<Eigen::Index>(k)];
      at = get<std::int16_t>(node + 4 + (distance < 0.0 ? 2 : 0));
    }
    return ~at;
  }
  bool is_empty(std::int32_t leaf) const { return get<std::int32_t>(leaf_record(leaf)) == -1; }
  /// For each leaf whether it may be seen from this one.
  std::vector<bool> visible_from(std::int32_t leaf, std::size_t leaves) const {
    const std::int32_t offset = get<std::int32_t>(leaf_record(leaf) + 4);
    if (offset < 0) return std::vector<bool>(leaves, true);
    std::vector<bool> row(leaves, false);
    std::size_t next = 1;  // leaf 0 is the common solid one and has no bit
    for (std::size_t at = visibility_ + static_cast<std::size_t>(offset);
         next < leaves && at < visibility_end_; ++at) {
      const auto byte = get<std::uint8_t>(at);
      if (byte == 0) {
        next += 8u * get<std::uint8_t>(++at);
        continue;
      }
      for (unsigned bit = 0; bit < 8 && next < leaves; ++bit, ++next) row[next] = ((byte >> bit) & 1u) != 0;
    }
    return row;
  }
  std::size_t leaves() const { return get<std::uint32_t>(4 + 10 * 8 + 4) / 28; }

 private:
  std::size_t lump(std::size_t index) const { return get<std::uint32_t>(4 + index * 8); }
  std::size_t leaf_record(std::int32_t leaf) const { return leaves_ + static_cast<std::size_t>(leaf) * 28; }
  template <typename T>
  T get(std::size_t at) const {
    if (at + sizeof(T) > bytes_.size()) throw std::runtime_error("the BSP is cut off");
    T value;
    std::memcpy(&value, bytes_.data() + at, sizeof(T));
    return value;
  }

  std::string bytes_;
  std::size_t planes_ = 0, visibility_ = 0, visibility_end_ = 0, nodes_ = 0, leaves_ = 0;
  std::int32_t head_ = 0;
};

}  // namespace hallway::bench
