// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <functional>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::test {

/// The space around a world on a grid from 0 to 6 as cubes of one unit, two rows of them beyond it on each side: what the void reaches,
/// found by flooding.
class Voxels {
 public:
  static constexpr int kSize = 10;

  explicit Voxels(const std::function<bool(const Vec3&)>& solid)
      : solid_(kSize * kSize * kSize), outside_(solid_.size()) {
    for_each([&](int x, int y, int z) { solid_[index(x, y, z)] = solid(middle(x, y, z)); });
    std::deque<std::array<int, 3>> front{{0, 0, 0}};
    outside_[0] = true;
    while (!front.empty()) {
      const auto [x, y, z] = front.front();
      front.pop_front();
      for (const auto& [dx, dy, dz] : std::array<std::array<int, 3>, 6>{
               {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}}) {
        const int nx = x + dx, ny = y + dy, nz = z + dz;
        if (nx < 0 || ny < 0 || nz < 0 || nx >= kSize || ny >= kSize || nz >= kSize) continue;
        if (solid_[index(nx, ny, nz)] || outside_[index(nx, ny, nz)]) continue;
        outside_[index(nx, ny, nz)] = true;
        front.push_back({nx, ny, nz});
      }
    }
  }

  static void for_each(const std::function<void(int, int, int)>& visit) {
    for (int z = 0; z < kSize; ++z) {
      for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) visit(x, y, z);
      }
    }
  }
  static Vec3 middle(int x, int y, int z) { return {x - 1.5, y - 1.5, z - 1.5}; }
  bool solid(int x, int y, int z) const { return solid_[index(x, y, z)]; }
  bool outside(int x, int y, int z) const { return outside_[index(x, y, z)]; }

 private:
  static std::size_t index(int x, int y, int z) {
    return static_cast<std::size_t>((z * kSize + y) * kSize + x);
  }

  std::vector<bool> solid_;
  std::vector<bool> outside_;
};

}  // namespace hallway::test
