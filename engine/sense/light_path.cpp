// SPDX-License-Identifier: MIT
#include "sense/light_path.hpp"

#include <algorithm>

namespace hallway::sense {
namespace {

/// Beyond a surface that a beam went through: at least so far, and by so much of the distance.
constexpr double kBeyond_m = 1e-7;
constexpr double kBeyond = 1e-12;

}  // namespace

std::optional<trace::Hit> light_end(const trace::Scene& scene, const Surfaces& surfaces,
                                    const trace::Ray& ray, const Random& random, std::uint32_t step,
                                    std::uint64_t index) {
  const Vec3 direction = ray.direction.normalized();
  double passed_m = 0.0;
  std::optional<trace::Hit> hit = scene.first_hit(ray);
  for (std::uint32_t pane = 0; hit && pane < kMostPanes; ++pane) {
    const double transparency = surfaces.material(hit->triangle).transparency;
    if (transparency == 0.0 || !(random.uniform(step, index + pane) < transparency)) break;
    passed_m = hit->distance + std::max(kBeyond_m, kBeyond * hit->distance);
    hit = scene.first_hit({ray.origin + passed_m * direction, direction, ray.max_distance - passed_m});
    if (hit) hit->distance += passed_m;
  }
  return hit;
}

}  // namespace hallway::sense
