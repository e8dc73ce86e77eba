// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "base/random.hpp"
#include "geometry/se3.hpp"

namespace hallway::test {

/// Seeded random geometry: `number` picks one.
class RandomGeometry {
 public:
  explicit RandomGeometry(std::uint32_t stream) : random_(20, stream) {}

  Vec3 vector(std::uint32_t number, double size = 10.0) const {
    return size * Vec3(random_.normal(number, 0), random_.normal(number, 1), random_.normal(number, 2));
  }
  /// Uniform over all rotations.
  Quat rotation(std::uint32_t number) const {
    return Quat(random_.normal(number, 3), random_.normal(number, 4), random_.normal(number, 5),
                random_.normal(number, 6))
        .normalized();
  }
  Pose pose(std::uint32_t number) const { return {rotation(number), vector(number)}; }
  std::vector<Vec3> points(std::uint32_t count, std::uint32_t first) const {
    std::vector<Vec3> list;
    for (std::uint32_t i = 0; i < count; ++i) list.push_back(vector(first + i));
    return list;
  }

 private:
  Random random_;
};

}  // namespace hallway::test
