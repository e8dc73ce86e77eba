// SPDX-License-Identifier: MIT
#include "em/core/em2.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "em/core/candidate.hpp"
#include "em/core/cloud_scale.hpp"
#include "em/core/dense_part.hpp"
#include "em/core/description.hpp"
#include "em/core/dice.hpp"
#include "em/core/plane_merge.hpp"
#include "em/core/sorted_cloud.hpp"

namespace hallway::em {
namespace {

constexpr std::array<OptionRow<Em2Options>, 5> kEm2OwnRows{{
    {"max_planes", "planes", 1, 1000000, "The search ends after so many planes that were grown and kept.",
     &Em2Options::max_planes},
    {"tries", "points", 1, 1000000,
     "The search ends after so many random points in a row that gave no plane.", &Em2Options::tries},
    {"grow_steps", "steps", 1, 100000, "A plane is widened so often at most.", &Em2Options::grow_steps},
    {"min_density", "1", 0.0, 1.0,
     "A plane ends where its density falls below this share of that around its seed; 0: no check.",
     &Em2Options::min_density},
    {"density_step", "length", 0.0, 1e9,
     "Width of the strips in which density is watched; 0: 4 times the spacing of the points.",
     &Em2Options::density_step},
}};

constexpr auto kEm2Rows = joined_rows(common_rows<Em2Options>(), kEm2OwnRows);

// Widening a plane turns it at first; from then on it has ended when it gains no points.
constexpr int kTurningSteps = 3;
constexpr double kStripBySpacing = 4.0;

/// The search; the numbers are the steps of thesis 3.5.3.
class Em2Search {
 public:
  Em2Search(std::span<const Vec3> points, const Em2Options& options)
      : points_(points),
        options_(options),
        dice_(static_cast<std::uint64_t>(options.seed)),
        tree_(points),  // 1
        uses_(points.size(), 0) {
    const CloudScale scale = measure_scale(points, tree_);
    lengths_ = lengths_of(options, scale);
    density_check_ = {options.density_step > 0.0 ? options.density_step : kStripBySpacing * scale.spacing,
                      options.min_density};
    merge_bounds_ = {std::cos(options.merge_angle_deg * M_PI / 180.0), lengths_.merge_offset,
                     lengths_.expansion};
  }

  std::vector<Candidate> run() {
    list_unattached();
    int failures = 0;
    int grown = 0;
    while (!finished() && failures < options_.tries && grown < options_.max_planes) {  // 2, 8
      auto plane = next_plane();
      if (!plane) {
        ++failures;
        continue;
      }
      failures = 0;
      ++grown;
      planes_.push_back(std::move(*plane));
      list_unattached();
      merge_alike(planes_, points_, merge_bounds_);  // 7
    }
    drop_shared(planes_, points_.size(), options_.min_exclusive);  // 9
    return std::move(planes_);
  }

 private:
  bool finished() const {
    const double left = static_cast<double>(unattached_.size());
    return unattached_.size() < 3 || left <= options_.max_unmatched * static_cast<double>(points_.size());
  }

  void list_unattached() {  // 3
    unattached_.clear();
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      if (uses_[i] == 0) unattached_.push_back(i);
    }
  }

  /// A plane grown from a random point, its points counted (6). Empty if that gave none that brings points; the point is then not drawn
  /// again before another plane is found.
  std::optional<Candidate> next_plane() {
    const std::uint32_t drawn = dice_.below(static_cast<std::uint32_t>(unattached_.size()));
    const std::uint32_t start = unattached_[drawn];
    auto plane = seed_plane(start);
    if (!plane || !grow(*plane, points_[start]) || own_points(*plane) < options_.min_points) {
      unattached_[drawn] = unattached_.back();
      unattached_.pop_back();
      return std::nullopt;
    }
    for (const std::uint32_t i : plane->members) ++uses_[i];
    plane->fresh = false;
    return plane;
  }

  std::optional<Candidate> seed_plane(std::uint32_t start) const {  // 4
    std::vector<Neighbour> nearest;
    tree_.nearest(points_[start], 3, nearest);
    const double reach = lengths_.seed_distance;
    if (nearest.size() < 3 || nearest[2].distance2 > reach * reach) return std::nullopt;
    return plane_through(points_, {nearest[0].index, nearest[1].index, nearest[2].index});
  }

  /// Widens a plane step by step (5); false if it has too few points on the way. One that has not even
  /// three points of its own was found before and is not widened any further.
  bool grow(Candidate& plane, const Vec3& start) const {
    std::size_t most = 0;
    for (int step = 0; step < options_.grow_steps; ++step) {
      if (!match(plane) || !maximise(plane, points_) || !end_where_sparse(plane, start)) return false;
      if (step >= kTurningSteps && (plane.members.size() <= most || own_points(plane) < 3)) return true;
      most = std::max(most, plane.members.size());
    }
    return true;
  }

  /// How many of a plane's points belong to no other.
  std::ptrdiff_t own_points(const Candidate& plane) const {
    return std::count_if(plane.members.begin(), plane.members.end(),
                         [&](std::uint32_t i) { return uses_[i] == 0; });
  }

  bool match(Candidate& plane) const {
    plane.members = tree_.within(matching_space(plane, lengths_.expansion, lengths_.distance));
    if (options_.share_points == 0) {
      std::erase_if(plane.members, [&](std::uint32_t i) { return uses_[i] > 0; });
    }
    return enough(plane);
  }

  /// Takes off what the plane reached over a gap or along a crossing plane.
  bool end_where_sparse(Candidate& plane, const Vec3& start) const {
    if (options_.min_density <= 0.0) return true;
    const std::size_t before = plane.members.size();
    keep_dense_part(plane, points_, start, density_check_);
    return plane.members.size() == before || (enough(plane) && maximise(plane, points_));
  }

  bool enough(const Candidate& plane) const {
    return plane.members.size() >= static_cast<std::size_t>(options_.min_points);
  }

  std::span<const Vec3> points_;
  const Em2Options& options_;
  Dice dice_;
  KdTree tree_;
  Lengths lengths_;
  MergeBounds merge_bounds_;
  DensityCheck density_check_;
  std::vector<Candidate> planes_;
  std::vector<std::uint32_t> uses_;        ///< how many planes have each point
  std::vector<std::uint32_t> unattached_;  ///< points that no plane has, and may be drawn
};

}  // namespace

std::span<const OptionRow<Em2Options>> em2_options() {
  return kEm2Rows;
}

void Em2Options::validate() const {
  check_options(*this, em2_options());
}

Extraction extract_em2(std::span<const Vec3> cloud, const Em2Options& options) {
  options.validate();
  const SortedCloud sorted = sort_cloud(cloud);
  return describe(sorted, Em2Search(sorted.points, options).run());
}

}  // namespace hallway::em
