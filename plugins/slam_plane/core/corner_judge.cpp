// SPDX-License-Identifier: MIT
#include "slam_plane/core/corner_judge.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

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

/// Whether an end lies behind that of another piece. Those next to it by bearing are looked at, as far as the widest doubt about any bearing reaches.
bool CornerJudge::is_hidden(std::size_t end) const {
  const EndView& seen = ends_[end];
  const double reach = sigmas_ * (seen.sigma / seen.range + widest_);
  const std::size_t n = by_bearing_.size();
  for (const std::size_t step : {std::size_t{1}, n - 1}) {  // to the left and to the right, all round
    std::size_t at = place_[end];
    for (std::size_t i = 1; i < n; ++i) {
      at = (at + step) % n;
      const std::size_t other = by_bearing_[at];
      const double turn = std::remainder(ends_[other].bearing - seen.bearing, 2.0 * std::numbers::pi);
      if (std::abs(turn) > reach) break;
      if (other / 2 != end / 2 && behind_end(seen, ends_[other])) return true;
    }
  }
  return false;
}

void CornerJudge::judge(const View& view, std::vector<Sighting>& frame) const {
  ends_.clear();
  widest_ = 0.0;
  for (const Sighting& sighting : frame) {
    for (const int end : {kEndA, kEndB}) {
      ends_.push_back(view_end(sighting, end));
      widest_ = std::max(widest_, ends_.back().sigma / ends_.back().range);
    }
  }
  by_bearing_.resize(ends_.size());
  std::iota(by_bearing_.begin(), by_bearing_.end(), std::size_t{0});
  std::sort(by_bearing_.begin(), by_bearing_.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(ends_[a].bearing, a) < std::pair(ends_[b].bearing, b);
  });
  place_.resize(ends_.size());
  for (std::size_t i = 0; i < by_bearing_.size(); ++i) place_[by_bearing_[i]] = i;
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    Sighting& sighting = frame[i / 2];
    const int end = static_cast<int>(i % 2);
    const bool cut = at_border(view, sighting, end, ends_[i]);
    sighting.hidden[end] = !cut && is_hidden(i);
    sighting.corner[end] = !cut && !sighting.hidden[end];
  }
}

}  // namespace hallway::slam_plane
