// SPDX-License-Identifier: MIT
#include "em/core/local_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace hallway::em {
namespace {

constexpr std::size_t kNeighbours = 48;
constexpr int kTriples = 60;           // a quarter of the points on the plane: one of 64 triples is all on it
constexpr std::size_t kFewest = 8;     // points near the plane: three always are
constexpr double kNear = 2.5;          // standard deviations
constexpr double kThinTriangle = 0.1;  // sine of the smallest angle at a triple's first point

/// Next number of a sequence (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
std::uint64_t next_random(std::uint64_t& state) {
  state += 0x9e3779b97f4a7c15ULL;
  std::uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

std::optional<PlaneFrame> plane_through(const Vec3& p, const Vec3& q, const Vec3& r) {
  const Vec3 normal = (q - p).cross(r - p);
  const double length = normal.norm();
  if (!(length > kThinTriangle * (q - p).norm() * (r - p).norm())) return std::nullopt;
  return frame_on(p, normal / length);
}

/// The points around a place, one array per coordinate, filled up with points that are near to nothing.
struct Around {
  std::array<double, kNeighbours> x{}, y{}, z{};

  explicit Around(const std::vector<Vec3>& points) {
    x.fill(std::numeric_limits<double>::infinity());
    y.fill(std::numeric_limits<double>::infinity());
    z.fill(std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < points.size(); ++k) {
      x[k] = points[k].x();
      y[k] = points[k].y();
      z[k] = points[k].z();
    }
  }
};

/// How well the points support the plane: each by how near it is, at most 1 (MSAC: Torr, Zisserman 2000).
double support_of(const Around& around, const PlaneFrame& frame, double reach) {
  const Vec3 n = frame.normal;
  const Vec3 o = frame.origin;
  std::array<double, kNeighbours> support;
  for (std::size_t k = 0; k < kNeighbours; ++k) {  // of fixed length, so that compilers use vectors
    const double away =
        (n.x() * (around.x[k] - o.x()) + n.y() * (around.y[k] - o.y()) + n.z() * (around.z[k] - o.z())) /
        reach;
    support[k] = 1.0 - away * away;
  }
  double sum = 0.0;
  for (const double value : support) sum += value > 0.0 ? value : 0.0;
  return sum;
}

std::optional<Seed> seed_of(const std::vector<Vec3>& around, const PlaneFrame& frame, double reach) {
  Moments moments;
  for (const Vec3& p : around) {
    if (std::abs(frame.height(p)) <= reach) moments.add(p - frame.origin);
  }
  if (moments.weight() < static_cast<double>(kFewest)) return std::nullopt;
  const PlaneFit fit = moments.fit(frame.origin);
  Seed seed;
  seed.frame = fit.frame;
  // A disc spread evenly has a quarter of its squared radius as variance along each direction.
  seed.radius = 2.0 * std::sqrt(fit.variances[1]);
  seed.density = moments.weight() / (4.0 * std::numbers::pi * std::sqrt(fit.variances[1] * fit.variances[2]));
  seed.noise = std::sqrt(fit.variances[0]);
  seed.flatness = fit.variances[0] / fit.variances[1];
  return seed.radius > reach ? std::optional<Seed>(seed) : std::nullopt;
}

}  // namespace

std::optional<Seed> search_locally(const PointField& field, std::uint32_t place, double radius, double sigma,
                                   std::uint64_t seed) {
  std::vector<NearPoint> near;
  nearest(field, field.points.at(place), kNeighbours, radius, near);
  std::vector<Vec3> around;
  for (const NearPoint& neighbour : near) around.push_back(field.points.at(neighbour.place));
  if (around.size() < kFewest) return std::nullopt;
  const Around lists(around);
  std::uint64_t state = seed ^ (static_cast<std::uint64_t>(place) << 32);
  std::optional<PlaneFrame> best;
  double best_support = 0.0;
  const double reach = kNear * sigma;
  for (int k = 0; k < kTriples; ++k) {
    const std::uint64_t random = next_random(state);
    const Vec3& p = around[0];
    const Vec3& q = around[(random & 0xffffffffu) % around.size()];
    const Vec3& r = around[(random >> 32) % around.size()];
    const std::optional<PlaneFrame> plane = plane_through(p, q, r);
    if (!plane) continue;
    const double support = support_of(lists, *plane, reach);
    if (support <= best_support) continue;
    best_support = support;
    best = plane;
  }
  if (!best) return std::nullopt;
  std::optional<Seed> found = seed_of(around, *best, reach);
  if (found) found->place = place;
  return found;
}

}  // namespace hallway::em
