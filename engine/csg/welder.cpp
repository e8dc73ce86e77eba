// SPDX-License-Identifier: MIT
#include "csg/welder.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hallway::csg {
namespace {

std::uint64_t hash_of(const std::array<std::int64_t, 3>& cell) {
  std::uint64_t hash = 0x9e3779b97f4a7c15ull;
  for (const std::int64_t part : cell) {
    hash = (hash ^ static_cast<std::uint64_t>(part)) * 0xff51afd7ed558ccdull;
    hash ^= hash >> 33;
  }
  return hash;
}

}  // namespace

std::uint32_t Welder::number_of(const Vec3& point) {
  std::array<std::array<std::int64_t, 2>, 3> range{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double value = point[static_cast<Eigen::Index>(k)];
    range[k] = {static_cast<std::int64_t>(std::floor((value - distance_) / cell_)),
                static_cast<std::int64_t>(std::floor((value + distance_) / cell_))};
  }
  constexpr std::uint32_t kNone = ~0u;
  std::uint32_t found = kNone;
  for (std::int64_t x = range[0][0]; x <= range[0][1]; ++x) {
    for (std::int64_t y = range[1][0]; y <= range[1][1]; ++y) {
      for (std::int64_t z = range[2][0]; z <= range[2][1]; ++z) {
        const auto cell = cells_.find(hash_of({x, y, z}));
        if (cell == cells_.end()) continue;
        for (const std::uint32_t number : cell->second) {
          if (number < found && (points_[number] - point).cwiseAbs().maxCoeff() <= distance_) found = number;
        }
      }
    }
  }
  if (found != kNone) return found;
  const auto number = static_cast<std::uint32_t>(points_.size());
  points_.push_back(point);
  std::array<std::int64_t, 3> own{};
  for (std::size_t k = 0; k < 3; ++k)
    own[k] = static_cast<std::int64_t>(std::floor(point[static_cast<Eigen::Index>(k)] / cell_));
  cells_[hash_of(own)].push_back(number);
  return number;
}

}  // namespace hallway::csg
