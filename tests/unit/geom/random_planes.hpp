// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "geom/exact_plane.hpp"

namespace hallway::test {

/// Kinds of planes, each hard in its own way.
enum class PlaneKind {
  kFewWholes,   ///< coordinates from -1 to 1: many points on many planes
  kGrid,        ///< multiples of 1/256
  kHuge,        ///< whole numbers up to 16 777 216
  kDecimals,    ///< multiples of 0.1, which no double is
  kTurned,      ///< a turned grid of whole points: planes that should meet in a point and nearly do
  kNearlySame,  ///< planes through points that are 1e-3 to 1e-12 off those of others
  kHugeDecimals,
};

inline constexpr std::array kPlaneKinds{PlaneKind::kFewWholes,   PlaneKind::kGrid,   PlaneKind::kHuge,
                                        PlaneKind::kDecimals,    PlaneKind::kTurned, PlaneKind::kNearlySame,
                                        PlaneKind::kHugeDecimals};

/// Three points that are not on a line.
class RandomPoints {
 public:
  RandomPoints(PlaneKind kind, std::uint64_t seed) : kind_(kind), random_(seed) {}

  std::array<Vec3, 3> three() {
    for (;;) {
      std::array<Vec3, 3> points{one(), one(), one()};
      if (kind_ == PlaneKind::kNearlySame && !earlier_.empty() && random_() % 4 != 0) {
        points = earlier_[random_() % earlier_.size()];
        const double off = std::pow(10.0, -3.0 - static_cast<double>(random_() % 10));
        for (Vec3& point : points) point += off * (one() / 64.0);
      }
      const Vec3 u = points[1] - points[0];
      const Vec3 v = points[2] - points[0];
      if (u.cross(v).norm() <= 1e-6 * u.norm() * v.norm()) continue;
      earlier_.push_back(points);
      return points;
    }
  }

 private:
  double whole(int largest) {
    return static_cast<double>(
        static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(2 * largest + 1)) - largest);
  }
  Vec3 wholes(int largest) {
    const double x = whole(largest);
    const double y = whole(largest);
    return {x, y, whole(largest)};
  }
  Vec3 one() {
    switch (kind_) {
      case PlaneKind::kFewWholes:
        return wholes(1);
      case PlaneKind::kGrid:
        return wholes(1 << 15) / 256.0;
      case PlaneKind::kHuge:
        return wholes(16777216);
      case PlaneKind::kDecimals:
        return 0.1 * wholes(40);
      case PlaneKind::kTurned:
        return turn_ * wholes(4);
      case PlaneKind::kNearlySame:
        return 8.0 * wholes(8);
      case PlaneKind::kHugeDecimals:
        return 0.1 * wholes(160000000);
    }
    return Vec3::Zero();
  }

  PlaneKind kind_;
  std::mt19937_64 random_;
  std::vector<std::array<Vec3, 3>> earlier_;
  Eigen::Quaterniond turn_ = Eigen::Quaterniond(0.9, 0.1, -0.3, 0.2).normalized();
};

}  // namespace hallway::test
