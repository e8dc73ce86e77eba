// SPDX-License-Identifier: MIT
#include "em/core/facets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace hallway::em {
namespace {

constexpr double kLargestTurn = 0.9659;  // cosine of 15 degrees between facets
constexpr double kStep =
    2.0;  // noises of both: at a seam without a step each facet is off by so much at most
constexpr double kFewestShared = 3.0;  // cells along a seam at least
constexpr double kBeside =
    0.5;  // of the smaller one's cells at the seam: more, and they lie one over the other
constexpr double kFewest = 4.0;  // points that make a fit

/// The middles of the cells that a patch covers, and a box about them.
struct Site {
  std::vector<Vec3> middles;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;

  explicit Site(const Patch& patch) {
    visit_cells(patch, [&](const Vec3& middle) {
      middles.push_back(middle);
      low = low.cwiseMin(middle);
      high = high.cwiseMax(middle);
    });
    low -= Vec3::Constant(patch.grid.cell);
    high += Vec3::Constant(patch.grid.cell);
  }
  bool boxes_meet(const Site& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

/// Whether two patches overlap in a seam, not more, and meet there without a step.
bool meet(const Patch& larger, const Patch& smaller, const Site& at_smaller) {
  double shared = 0.0;
  double away = 0.0;
  for (const Vec3& middle : at_smaller.middles) {
    if (!larger.covers(larger.frame.flat(middle))) continue;
    shared += 1.0;
    away += std::abs(larger.frame.height(middle));
  }
  return shared >= kFewestShared && shared <= kBeside * static_cast<double>(at_smaller.middles.size()) &&
         away <= shared * kStep * (larger.sigma + smaller.sigma);
}

/// Patches by their numbers, the first less than the second.
using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Pairs that are turned little enough to be facets of one surface.
std::vector<Pair> nearly_parallel(const std::vector<Patch>& patches) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < patches.size(); ++i) {
    for (std::uint32_t j = i + 1; j < patches.size(); ++j) {
      const double turn = std::abs(patches[i].frame.normal.dot(patches[j].frame.normal));
      if (turn >= kLargestTurn) pairs.emplace_back(i, j);
    }
  }
  return pairs;
}

/// Of the patches in pairs; nothing of the others.
std::vector<std::optional<Site>> sites_of(const std::vector<Patch>& patches, const std::vector<Pair>& pairs,
                                          Workers& workers) {
  std::vector<std::uint8_t> wanted(patches.size(), 0);
  for (const auto& [i, j] : pairs) wanted[i] = wanted[j] = 1;
  std::vector<std::optional<Site>> sites(patches.size());
  workers.run(patches.size(), [&](std::size_t j, std::size_t) {
    if (wanted[j] != 0) sites[j].emplace(patches[j]);
  });
  return sites;
}

/// The pairs that lie side by side and meet without a step, in the order given.
std::vector<Pair> meeting(const std::vector<Patch>& patches, std::vector<Pair> pairs, Workers& workers) {
  const std::vector<std::optional<Site>> sites = sites_of(patches, pairs, workers);
  std::erase_if(pairs, [&](const Pair& pair) { return !sites[pair.first]->boxes_meet(*sites[pair.second]); });
  std::vector<std::uint8_t> met(pairs.size(), 0);
  workers.run(pairs.size(), [&](std::size_t k, std::size_t) {
    auto [smaller, larger] = pairs[k];
    if (sites[smaller]->middles.size() >= sites[larger]->middles.size()) std::swap(smaller, larger);
    met[k] = meet(patches[larger], patches[smaller], *sites[smaller]) ? 1 : 0;
  });
  std::vector<Pair> found;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (met[k] != 0) found.push_back(pairs[k]);
  }
  return found;
}

/// Groups as they grow.
class Groups {
 public:
  Groups(const Points& points, const std::vector<Patch>& patches,
         const std::vector<std::vector<std::uint32_t>>& places, Workers& workers)
      : first_(patches.size()), moments_(patches.size()) {
    std::iota(first_.begin(), first_.end(), 0u);
    beside_ = meeting(patches, nearly_parallel(patches), workers);
    std::vector<std::uint8_t> wanted(patches.size(), 0);
    for (const auto& [i, j] : beside_) wanted[i] = wanted[j] = 1;
    workers.run(patches.size(), [&](std::size_t j, std::size_t) {
      if (wanted[j] == 0) return;
      for (const std::uint32_t i : places[j]) moments_[j].add(points.at(i));
    });
  }

  /// Joins the pair that stays flattest, if that is flat within `bend`.
  bool join_best(double bend) {
    double best = bend * bend;
    std::optional<Pair> pair;
    for (const auto& [i, j] : beside_) {
      const std::uint32_t a = std::min(first_[i], first_[j]);
      const std::uint32_t b = std::max(first_[i], first_[j]);
      if (a == b) continue;
      const double flatness = joint_flatness(a, b);
      if (flatness >= best) continue;
      best = flatness;
      pair = {a, b};
    }
    if (!pair) return false;
    moments_[pair->first].join(moments_[pair->second]);
    std::replace(first_.begin(), first_.end(), pair->second, pair->first);
    return true;
  }
  const std::vector<std::uint32_t>& first() const { return first_; }

 private:
  double joint_flatness(std::uint32_t a, std::uint32_t b) const {
    Moments joint = moments_[a];
    joint.join(moments_[b]);
    if (joint.weight() < kFewest) return 1.0;
    const Vec3 variances = joint.variances();
    return variances[1] > 0.0 ? variances[0] / variances[1] : 1.0;
  }

  std::vector<std::uint32_t> first_;
  std::vector<Moments> moments_;  ///< of groups with more than one patch to come, by their first patch
  std::vector<Pair> beside_;
};

}  // namespace

std::vector<std::uint32_t> facet_groups(const Points& points, const std::vector<Patch>& patches,
                                        const std::vector<std::vector<std::uint32_t>>& places, double bend,
                                        Workers& workers) {
  Groups groups(points, patches, places, workers);
  while (groups.join_best(bend)) {
  }
  return groups.first();
}

}  // namespace hallway::em
