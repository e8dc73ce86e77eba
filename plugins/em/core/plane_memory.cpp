// SPDX-License-Identifier: MIT
#include "em/core/plane_memory.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

namespace hallway::em {
namespace {

constexpr double kLeastCosine = 0.97;  // 14 degrees: no sensor turns more from one frame to the next
constexpr double kAcross =
    0.25;                        // of the smaller plane's half diagonal: how far one may lie beside the other
constexpr double kAlong = 1.0;   // of the larger one's: how far their middles may lie apart
constexpr double kNoises = 3.0;  // beside that

struct Likeness {
  double difference = 0.0;  ///< 0: the same; at most 3
  std::size_t before = 0;
  std::size_t now = 0;
};

double half_diagonal(const Plane& plane) {
  return 0.5 * (plane.corners[2] - plane.corners[0]).norm();
}

double share(double value, double limit) {
  return limit > 0.0 ? value / limit : (value > 0.0 ? 2.0 : 0.0);
}

/// How much two planes differ; nothing if they are not the same one.
std::optional<double> difference(const Plane& before, const Plane& now) {
  const double cosine = before.normal.dot(now.normal);
  const double smaller = std::min(half_diagonal(before), half_diagonal(now));
  const double larger = std::max(half_diagonal(before), half_diagonal(now));
  const Vec3 apart = now.centroid - before.centroid;
  const double across = std::max(std::abs(before.normal.dot(apart)), std::abs(now.normal.dot(apart)));
  const double turned = share(1.0 - cosine, 1.0 - kLeastCosine);
  const double beside = share(across, kAcross * smaller + kNoises * (before.rms + now.rms));
  const double along = share(apart.norm(), kAlong * larger);
  if (turned > 1.0 || beside > 1.0 || along > 1.0) return std::nullopt;
  return turned + beside + along;
}

std::vector<Likeness> likenesses(const std::vector<Plane>& before, const std::vector<Plane>& now) {
  std::vector<Likeness> all;
  for (std::size_t i = 0; i < before.size(); ++i) {
    for (std::size_t j = 0; j < now.size(); ++j) {
      if (const auto value = difference(before[i], now[j])) all.push_back({*value, i, j});
    }
  }
  std::sort(all.begin(), all.end(), [](const Likeness& a, const Likeness& b) {
    return std::tie(a.difference, a.before, a.now) < std::tie(b.difference, b.before, b.now);
  });
  return all;
}

}  // namespace

void PlaneMemory::identify(Extraction& found) {
  constexpr std::uint64_t kNone = ~std::uint64_t{0};
  for (Plane& plane : found.planes) plane.id = kNone;
  std::vector<bool> taken(planes_.size(), false);
  for (const Likeness& likeness : likenesses(planes_, found.planes)) {
    Plane& plane = found.planes[likeness.now];
    if (plane.id != kNone || taken[likeness.before]) continue;
    plane.id = planes_[likeness.before].id;
    taken[likeness.before] = true;
  }
  planes_.clear();
  members_.clear();
  points_ = found.labels.size();
  for (Plane& plane : found.planes) {
    if (plane.id == kNone) plane.id = next_id_++;
    members_.push_back(plane.members.size());
    planes_.push_back(plane);
    planes_.back().members.clear();
  }
}

}  // namespace hallway::em
