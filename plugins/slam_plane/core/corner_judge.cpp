// SPDX-License-Identifier: MIT
#include "slam_plane/core/corner_judge.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hallway::slam_plane {
namespace {

constexpr double kNearerSigmas = 2.0;  // that something is nearer by, if it hides
constexpr double kLeastRange_m = 0.05;

}  // namespace

CornerJudge::CornerJudge(const Options& options)
    : noise_(options.noise()),
      sigmas_(options.corner_sigmas),
      margin_(options.border_margin_deg * std::numbers::pi / 180.0) {}

CornerJudge::EndView CornerJudge::view_end(const Sighting& sighting, int end) const {
  const Vec2& p = sighting.end[end];
  const double across = std::hypot(noise_.normal, 0.5 * sighting.length * noise_.angle);
  return {std::atan2(p.y(), p.x()), std::max(p.norm(), kLeastRange_m),
          std::hypot(across, noise_.end, noise_.along)};
}

bool CornerJudge::at_border(const View& view, const Sighting& sighting, int end, const EndView& seen) const {
  const double reach = sigmas_ * seen.sigma;
  if (view.horizontal_fov_rad < 2.0 * std::numbers::pi) {
    const double inside = 0.5 * view.horizontal_fov_rad - std::abs(seen.bearing);
    if (inside < margin_ + reach / seen.range) return true;
  }
  if (view.max_range_m <= 0.0) return false;
  const double depth = view.range_bounds_sides ? seen.range : sighting.end[end].x();
  return depth > view.max_range_m - reach;
}

bool CornerJudge::behind_end(const EndView& seen, const EndView& other) const {
  const double sigma = std::hypot(seen.sigma, other.sigma);
  if (other.range > seen.range - kNearerSigmas * sigma) return false;
  const double turn = std::remainder(seen.bearing - other.bearing, 2.0 * std::numbers::pi);
  return std::abs(turn) < sigmas_ * std::hypot(seen.sigma / seen.range, other.sigma / other.range);
}

void CornerJudge::judge(const View& view, std::vector<Sighting>& frame) const {
  ends_.clear();
  for (const Sighting& sighting : frame) {
    ends_.push_back(view_end(sighting, kEndA));
    ends_.push_back(view_end(sighting, kEndB));
  }
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    Sighting& sighting = frame[i / 2];
    const int end = static_cast<int>(i % 2);
    const bool cut = at_border(view, sighting, end, ends_[i]);
    bool hidden = false;
    for (std::size_t k = 0; k < ends_.size() && !cut && !hidden; ++k) {
      if (k / 2 != i / 2) hidden = behind_end(ends_[i], ends_[k]);
    }
    sighting.hidden[end] = hidden;
    sighting.corner[end] = !cut && !hidden;
  }
}

}  // namespace hallway::slam_plane
