// SPDX-License-Identifier: MIT
#include "em/core/facets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

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
    const CellGrid& grid = patch.grid;
    for (int row = 0; row < grid.rows; ++row) {
      for (int column = 0; column < grid.columns; ++column) {
        if (patch.log_density[grid.place(column, row)] == kNotCovered) continue;
        const double a = grid.low_a + (column + 0.5) * grid.cell;
        const double b = grid.low_b + (row + 0.5) * grid.cell;
        middles.push_back(patch.frame.origin + a * patch.frame.u + b * patch.frame.v);
        low = low.cwiseMin(middles.back());
        high = high.cwiseMax(middles.back());
      }
    }
    low -= Vec3::Constant(grid.cell);
    high += Vec3::Constant(grid.cell);
  }
  bool boxes_meet(const Site& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

/// Whether two patches overlap in a seam, not more, and meet there without a step.
bool meet(const Patch& larger, const Patch& smaller, const Site& at_smaller) {
  const CellGrid& grid = larger.grid;
  double shared = 0.0;
  double away = 0.0;
  for (const Vec3& middle : at_smaller.middles) {
    const Vec3 from = middle - larger.frame.origin;
    const double a = larger.frame.u.dot(from);
    const double b = larger.frame.v.dot(from);
    if (a < grid.low_a || b < grid.low_b || a > grid.high_a() || b > grid.high_b()) continue;
    if (larger.log_density[grid.at(a, b)] == kNotCovered) continue;
    shared += 1.0;
    away += std::abs(larger.frame.normal.dot(from));
  }
  return shared >= kFewestShared && shared <= kBeside * static_cast<double>(at_smaller.middles.size()) &&
         away <= shared * kStep * (larger.sigma + smaller.sigma);
}

/// Groups as they grow.
class Groups {
 public:
  Groups(const Points& points, const std::vector<Patch>& patches, const std::vector<std::uint32_t>& labels)
      : first_(patches.size()), moments_(patches.size()), beside_(patches.size()) {
    std::iota(first_.begin(), first_.end(), 0u);
    for (std::size_t i = 0; i < points.count; ++i) {
      if (labels[i] != kNoPlane) moments_[labels[i]].add(points.at(i));
    }
    std::vector<Site> sites;
    for (const Patch& patch : patches) sites.emplace_back(patch);
    for (std::uint32_t i = 0; i < patches.size(); ++i) {
      for (std::uint32_t j = i + 1; j < patches.size(); ++j) {
        const double turn = std::abs(patches[i].frame.normal.dot(patches[j].frame.normal));
        if (turn < kLargestTurn || !sites[i].boxes_meet(sites[j])) continue;
        const bool smaller = sites[i].middles.size() < sites[j].middles.size();
        const std::uint32_t s = smaller ? i : j;
        const std::uint32_t l = smaller ? j : i;
        if (meet(patches[l], patches[s], sites[s])) beside_[i].push_back(j);
      }
    }
  }

  /// Joins the pair that stays flattest, if that is flat within `bend`.
  bool join_best(double bend) {
    double best = bend * bend;
    std::optional<std::pair<std::uint32_t, std::uint32_t>> pair;
    for (std::uint32_t i = 0; i < beside_.size(); ++i) {
      for (const std::uint32_t j : beside_[i]) {
        const std::uint32_t a = std::min(first_[i], first_[j]);
        const std::uint32_t b = std::max(first_[i], first_[j]);
        if (a == b) continue;
        const double flatness = joint_flatness(a, b);
        if (flatness >= best) continue;
        best = flatness;
        pair = {a, b};
      }
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
  std::vector<Moments> moments_;                    ///< of groups, by their first patch
  std::vector<std::vector<std::uint32_t>> beside_;  ///< of each patch, later ones
};

}  // namespace

std::vector<std::uint32_t> facet_groups(const Points& points, const std::vector<Patch>& patches,
                                        const std::vector<std::uint32_t>& labels, double bend) {
  Groups groups(points, patches, labels);
  while (groups.join_best(bend)) {
  }
  return groups.first();
}

}  // namespace hallway::em
