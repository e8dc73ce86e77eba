// SPDX-License-Identifier: MIT
#include "sense/field_of_view.hpp"

#include <cmath>
#include <limits>

namespace hallway::sense {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846;
constexpr double kAllRound = 2.0 * kHalfTurn - 1e-9;  ///< 360 degrees, however they were computed

}  // namespace

FieldOfView::FieldOfView(double horizontal, double vertical, double min_range_m, double max_range_m)
    : horizontal_(horizontal),
      vertical_(vertical),
      pyramid_(horizontal < kHalfTurn && vertical < kHalfTurn),
      tan_horizontal_(std::tan(0.5 * horizontal)),
      cos_horizontal_(horizontal < kAllRound ? std::cos(0.5 * horizontal)
                                             : -std::numeric_limits<double>::max()),
      tan_vertical_(vertical < kHalfTurn ? std::tan(0.5 * vertical)
                                         : std::numeric_limits<double>::infinity()),
      min_range_m_(min_range_m),
      max_range_m_(max_range_m) {}

bool FieldOfView::in_band(const Vec3& point) const {
  const double level = std::sqrt(point.x() * point.x() + point.y() * point.y());
  if (std::isfinite(tan_vertical_) && std::abs(point.z()) > level * tan_vertical_) return false;
  return point.x() >= level * cos_horizontal_;
}

}  // namespace hallway::sense
