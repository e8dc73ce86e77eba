// SPDX-License-Identifier: MIT
#include "planes/oracle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planes/fit.hpp"
#include "planes/overlap.hpp"

namespace hallway::planes {
namespace {

constexpr double kFarthest = 8.0;      // noises: farther off a point is no plane's
constexpr std::size_t kFewestFit = 3;  // points that make a plane

/// A rectangle with points spread evenly on it, then moved by the noise along each axis.
struct Source {
  Plane plane;
  Vec3 centre, u, v;  ///< u and v unit
  double half_u, half_v;
  double log_density;  ///< of points over the rectangle
  double noise;

  /// Log of the density of points in space at p; nothing far off.
  double log_likelihood(const Vec3& p) const {
    const double away = plane.distance(p) / noise;
    if (std::abs(away) > kFarthest) return -std::numeric_limits<double>::infinity();
    const Vec3 from = p - centre;
    const auto within = [this](double x, double half) {
      return 0.5 * std::erfc((std::abs(x) - half) / (noise * std::numbers::sqrt2));
    };
    const double inside = within(u.dot(from), half_u) * within(v.dot(from), half_v);
    return log_density + std::log(inside) - 0.5 * away * away -
           std::log(noise * std::sqrt(2.0 * std::numbers::pi));
  }
};

Source source_of(const TruePlane& plane, double points, double noise) {
  const Corners& c = *plane.corners;
  const Vec3 u = c[1] - c[0], v = c[3] - c[0];
  return {plane.plane,
          0.5 * (c[0] + c[2]),
          u.normalized(),
          v.normalized(),
          0.5 * u.norm(),
          0.5 * v.norm(),
          std::log(points / (u.norm() * v.norm())),
          noise};
}

/// Log of the outliers per volume; half of one where there is none.
double log_outliers(const std::vector<Vec3>& points, std::uint64_t outliers) {
  Vec3 low = points.front(), high = points.front();
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return std::log(std::max(static_cast<double>(outliers), 0.5) / std::max((high - low).prod(), 1e-300));
}

/// The likeliest source of a point, or their number for none.
std::size_t source_of_point(const std::vector<Source>& sources, const Vec3& p, double none) {
  std::size_t best = sources.size();
  double most = none;
  for (std::size_t j = 0; j < sources.size(); ++j) {
    const double score = sources[j].log_likelihood(p);
    if (score <= most) continue;
    most = score;
    best = j;
  }
  return best;
}

bool tells_rectangles(const Truth& truth) {
  return truth.noise > 0 && std::all_of(truth.planes.begin(), truth.planes.end(),
                                        [](const TruePlane& plane) { return plane.corners.has_value(); });
}

}  // namespace

std::vector<PlaneObservation> answer_knowing(const std::vector<Vec3>& points, const Truth& truth) {
  if (!tells_rectangles(truth) || points.empty()) return {};
  const Overlap sizes = overlap_of(truth, {});
  std::vector<Source> sources;
  for (std::size_t j = 0; j < truth.planes.size(); ++j)
    sources.push_back(source_of(truth.planes[j], static_cast<double>(sizes.truth_sizes[j]), truth.noise));
  const double none = log_outliers(points, sizes.outliers);
  std::vector<PlaneObservation> found(sources.size());
  std::vector<std::vector<Vec3>> own(sources.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t j = source_of_point(sources, points[i], none);
    if (j == sources.size()) continue;
    found[j].members.push_back(static_cast<PointIndex>(i));
    own[j].push_back(points[i]);
  }
  for (std::size_t j = 0; j < found.size(); ++j) {
    found[j].id = j;
    found[j].corners = *truth.planes[j].corners;
    found[j].points = own[j].size();
    found[j].plane = own[j].size() < kFewestFit ? truth.planes[j].plane : least_squares_plane(own[j]);
  }
  return found;
}

void count_decidable(const Score& knowing, Score& score) {
  Decidable& decidable = score.decidable.emplace();
  decidable.found.fill(score.found);
  for (std::size_t i = 0; i < kIous.size(); ++i) {
    std::vector<bool> right(score.asked.size(), false);
    for (const PlanePair& pair : knowing.pairs)
      right[pair.truth] = score.asked[pair.truth] && pair.iou >= kIous[i];
    decidable.truths[i] = static_cast<std::size_t>(std::count(right.begin(), right.end(), true));
    for (const PlanePair& pair : score.pairs) {
      if (!score.asked[pair.truth]) continue;
      if (!right[pair.truth]) {
        if (decidable.found[i] > 0) --decidable.found[i];
      } else if (pair.iou >= kIous[i]) {
        ++decidable.matched[i];
      }
    }
  }
}

}  // namespace hallway::planes
