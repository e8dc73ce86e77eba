// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "base/random.hpp"
#include "slam_plane/core/options.hpp"
#include "slam_plane/core/types.hpp"

namespace hallway::bench {

using slam_plane::left_of;
using slam_plane::Noise;
using slam_plane::Pose2;
using slam_plane::WallObservation;

inline constexpr double kStep_m = 0.1;
inline constexpr double kRange_m = 12.0;     // depth
inline constexpr double kPiece_m = 0.6;      // half of the longest wall
inline constexpr double kLeastSeen_m = 0.1;  // shorter parts are not told
inline constexpr double kBand_m = 13.0;      // on each side of the road, in which walls stand

/// A straight road between walls that stand about in cells, one in each, made when they are needed: any length takes no memory. Or a circle of it, which is
/// driven round and round; or a stretch, there and back and there again. Nothing hides anything, so that the number in view is what the cells' size says.
class Road {
 public:
  /// `visible`: walls in view, about. `lap_m`: after which it returns to its beginning; 0: never.
  /// `stretch_m`: after which it is driven backwards, facing the same way; 0: never.
  Road(double visible, double lap_m, double stretch_m = 0.0)
      : stretch_(stretch_m), random_(1, stream_id("bench.slam_plane_growth")) {
    // The view is a triangle of range² m² on average; of each wall one side is told, and half of them turn that to the robot.
    cell_ = std::sqrt(0.5 * kRange_m * kRange_m / visible);
    rows_ = 2 * static_cast<std::int64_t>(std::ceil(kBand_m / cell_));
    if (lap_m > 0.0) {
      columns_ = std::max<std::int64_t>(1, std::llround(lap_m / cell_));
      radius_ = static_cast<double>(columns_) * cell_ / (2.0 * std::numbers::pi);
    }
  }

  /// Walls on a lap.
  double walls() const { return static_cast<double>(columns_ * rows_); }
  double lap_m() const { return static_cast<double>(columns_) * cell_; }

  const std::vector<WallObservation>& see(std::uint32_t step) {
    double s = kStep_m * static_cast<double>(step);
    if (stretch_ > 0.0) s = stretch_ - std::abs(std::fmod(s, 2.0 * stretch_) - stretch_);
    const Pose2 inverse = place(s).inverse();
    observations_.clear();
    const double reach = kRange_m * std::numbers::sqrt2;
    const auto first = static_cast<std::int64_t>(std::floor((s - reach) / cell_));
    const auto last = static_cast<std::int64_t>(std::floor((s + reach) / cell_));
    const std::int64_t most = columns_ > 0 ? first + columns_ - 1 : last;
    for (std::int64_t column = first; column <= std::min(last, most); ++column) {
      for (std::int64_t row = 0; row < rows_; ++row)
        tell(wall(column, row), inverse, step, named(column) * rows_ + row);
    }
    return observations_;
  }

 private:
  struct Segment {
    Vec2 a, b;
  };

  /// Of the robot at a length of road, or of what stands there.
  Pose2 place(double s) const {
    if (columns_ == 0) return {Vec2(s, 0.0), Vec2(1.0, 0.0)};
    const double angle = s / radius_;
    return Pose2::at(radius_ * Vec2(std::sin(angle), 1.0 - std::cos(angle)), angle);
  }

  std::int64_t named(std::int64_t column) const {
    return columns_ == 0 ? column + 1000 : ((column % columns_) + columns_) % columns_;
  }

  Segment wall(std::int64_t column, std::int64_t row) const {
    const auto key = static_cast<std::uint32_t>(named(column) * rows_ + row);
    const double most = std::min(kPiece_m, 0.35 * cell_);
    const double half = random_.uniform(key, 0, 0.5 * most, most);
    const double angle = random_.uniform(key, 1, 0.0, 2.0 * std::numbers::pi);
    const Pose2 at = place(cell_ * (static_cast<double>(column) + random_.uniform(key, 2, 0.4, 0.6)));
    const double beside = cell_ * (static_cast<double>(row) + random_.uniform(key, 3, 0.4, 0.6) -
                                   0.5 * static_cast<double>(rows_));
    const Vec2 middle = at * Vec2(0.0, beside);
    const Vec2 along = at.rotate(Pose2::at(Vec2::Zero(), angle).rotate(Vec2(half, 0.0)));
    return {middle - along, middle + along};
  }

  /// What of a wall is within 45 degrees of the way ahead and within range, with noise.
  void tell(const Segment& wall, const Pose2& inverse, std::uint32_t step, std::int64_t name) {
    Vec2 a = inverse * wall.a;
    Vec2 b = inverse * wall.b;
    if (cross(a, b) >= 0.0) return;
    for (const Vec2& inwards : {Vec2(1.0, 1.0), Vec2(1.0, -1.0)}) {
      if (!clip(inwards.dot(a), inwards.dot(b), a, b)) return;
    }
    if (!clip(kRange_m - a.x(), kRange_m - b.x(), a, b) || (b - a).norm() < kLeastSeen_m) return;
    const auto key = static_cast<std::uint64_t>(8 * name);
    const Noise noise = slam_plane::Options{}.noise();
    const Vec2 d = (b - a).normalized();
    const Vec2 middle = 0.5 * (a + b) + noise.normal * random_.normal(step, key + 4) * left_of(d);
    const Vec2 turned = Pose2::at(Vec2::Zero(), noise.angle * random_.normal(step, key + 5)).rotate(d);
    const double half = 0.5 * (b - a).norm();
    observations_.push_back({middle - (half + noise.end * random_.normal(step, key + 6)) * turned,
                             middle + (half + noise.end * random_.normal(step, key + 7)) * turned, 0.0, 2.5});
  }

  /// Keeps the part of a->b where a linear function, f at its ends, is not below 0.
  static bool clip(double fa, double fb, Vec2& a, Vec2& b) {
    if (fa < 0.0 && fb < 0.0) return false;
    const Vec2 crossing = a + fa / (fa - fb) * (b - a);
    if (fa < 0.0) a = crossing;
    if (fb < 0.0) b = crossing;
    return true;
  }

  double stretch_;
  Random random_;
  double cell_ = 1.0;
  std::int64_t rows_ = 0;
  std::int64_t columns_ = 0;  // of a lap; 0: it never returns
  double radius_ = 0.0;
  std::vector<WallObservation> observations_;
};

}  // namespace hallway::bench
