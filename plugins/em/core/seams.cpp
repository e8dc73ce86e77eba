// SPDX-License-Identifier: MIT
#include "em/core/seams.hpp"

#include <cmath>

#include "em/core/grouped.hpp"

namespace hallway::em {
namespace {

constexpr double kWithin = 2.0;        // standard deviations
constexpr double kLeastTurn = 0.9659;  // cosine of 15 degrees

bool near(const Vec3& p, const Patch& patch) {
  return std::abs(patch.frame.height(p)) <= kWithin * patch.sigma;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> places_at_seams(const Points& points, const Mixture& mixture,
                                                        const std::vector<std::uint32_t>& groups,
                                                        Workers& workers) {
  const auto sharing_group = [&](std::size_t i) {
    const std::uint32_t best = mixture.labels()[i];
    const std::uint32_t second = mixture.second_label(i);
    if (best == kNoPlane || second == kNoPlane || groups[best] == groups[second]) return kNoPlane;
    const Patch& own = mixture.patches[best];
    const Patch& other = mixture.patches[second];
    if (std::abs(own.frame.normal.dot(other.frame.normal)) > kLeastTurn) return kNoPlane;
    const Vec3 p = points.at(i);
    return near(p, own) && near(p, other) ? groups[second] : kNoPlane;
  };
  return grouped(points.count, groups.size(), sharing_group, workers);
}

}  // namespace hallway::em
