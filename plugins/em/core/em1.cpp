// SPDX-License-Identifier: MIT
#include "em/core/em1.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "em/core/candidate.hpp"
#include "em/core/cloud_scale.hpp"
#include "em/core/description.hpp"
#include "em/core/dice.hpp"
#include "em/core/plane_merge.hpp"
#include "em/core/sorted_cloud.hpp"

namespace hallway::em {
namespace {

constexpr std::array<OptionRow<Em1Options>, 4> kEm1OwnRows{{
    {"max_iterations", "iterations", 1, 100000, "The search ends after so many iterations.",
     &Em1Options::max_iterations},
    {"patience", "iterations", 1, 100000,
     "The search ends when so many iterations in a row have brought no plane and no points.",
     &Em1Options::patience},
    {"new_planes", "planes", 1, 1000, "Random planes that an iteration starts.", &Em1Options::new_planes},
    {"tries", "points", 1, 100000, "Random points that an iteration draws at most to start them from.",
     &Em1Options::tries},
}};

constexpr auto kEm1Rows = joined_rows(common_rows<Em1Options>(), kEm1OwnRows);

// An iteration that matches fewer points more than this share of the cloud brings nothing new.
constexpr double kProgress = 0.001;

/// The search; the numbers are the steps of thesis 3.5.2. Steps 4 and 7 are one here: bounds follow from the equation.
class Em1Search {
 public:
  Em1Search(std::span<const Vec3> points, const Em1Options& options)
      : points_(points), options_(options), dice_(static_cast<std::uint64_t>(options.seed)) {
    lengths_ = lengths_of(options, measure_scale(points, KdTree(points)));
    merge_bounds_ = {std::cos(options.merge_angle_deg * M_PI / 180.0), lengths_.merge_offset,
                     lengths_.expansion};
  }

  std::vector<Candidate> run() {
    while (true) {
      match();
      if (finished()) break;
      add_random_planes();
      improve();
    }
    improve();
    return std::move(planes_);
  }

 private:
  /// Expectation (2, 3): each point goes to every plane that it fits, or to the nearest of them.
  void match() {
    for (Candidate& plane : planes_) {
      plane.members.clear();
      plane.fresh = false;
    }
    std::vector<OrientedBox> spaces;
    for (const Candidate& plane : planes_) {
      spaces.push_back(matching_space(plane, lengths_.expansion, lengths_.distance));
    }
    unmatched_.clear();
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      if (!match_point(i, spaces)) unmatched_.push_back(i);
    }
  }

  bool match_point(std::uint32_t i, const std::vector<OrientedBox>& spaces) {
    std::size_t nearest = planes_.size();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < planes_.size(); ++j) {
      if (!spaces[j].contains(points_[i])) continue;
      if (options_.share_points != 0) planes_[j].members.push_back(i);
      const double distance = std::abs(planes_[j].fit.distance(points_[i]));
      if (distance >= least) continue;
      least = distance;
      nearest = j;
    }
    if (nearest == planes_.size()) return false;
    if (options_.share_points == 0) planes_[nearest].members.push_back(i);
    return true;
  }

  /// Ending conditions (5).
  bool finished() {
    const double points = static_cast<double>(points_.size());
    const double left = static_cast<double>(unmatched_.size());
    if (left <= options_.max_unmatched * points || ++iteration_ > options_.max_iterations) return true;
    idle_ = left < least_left_ - kProgress * points ? 0 : idle_ + 1;
    least_left_ = std::min(least_left_, left);
    return idle_ > options_.patience;
  }

  /// New planes out of the points that no plane has (6).
  void add_random_planes() {
    int added = 0;
    for (int i = 0; i < options_.tries && added < options_.new_planes && unmatched_.size() >= 3; ++i) {
      auto plane = random_plane();
      if (!plane) continue;
      planes_.push_back(std::move(*plane));
      ++added;
    }
  }

  std::optional<Candidate> random_plane() {
    const std::uint32_t start = unmatched_[dice_.below(static_cast<std::uint32_t>(unmatched_.size()))];
    Neighbour first{std::numeric_limits<double>::infinity(), 0};
    Neighbour second = first;
    for (const std::uint32_t i : unmatched_) {
      if (i == start) continue;
      const Neighbour other{(points_[i] - points_[start]).squaredNorm(), i};
      if (other < first) {
        second = first;
        first = other;
      } else if (other < second) {
        second = other;
      }
    }
    if (second.distance2 > lengths_.seed_distance * lengths_.seed_distance) return std::nullopt;
    return plane_through(points_, {start, first.index, second.index});
  }

  /// Maximisation and what keeps the planes apart (7 to 10).
  void improve() {
    for (Candidate& plane : planes_) {
      if (!maximise(plane, points_)) plane.members.clear();
    }
    const auto few = static_cast<std::size_t>(options_.min_points);
    std::erase_if(planes_, [&](const Candidate& plane) { return plane.members.empty(); });
    merge_alike(planes_, points_, merge_bounds_);
    std::erase_if(planes_,
                  [&](const Candidate& plane) { return !plane.fresh && plane.members.size() < few; });
    drop_shared(planes_, points_.size(), options_.min_exclusive);
  }

  std::span<const Vec3> points_;
  const Em1Options& options_;
  Dice dice_;
  Lengths lengths_;
  MergeBounds merge_bounds_;
  std::vector<Candidate> planes_;
  std::vector<std::uint32_t> unmatched_;
  int iteration_ = 0;
  int idle_ = 0;
  double least_left_ = std::numeric_limits<double>::infinity();
};

}  // namespace

std::span<const OptionRow<Em1Options>> em1_options() {
  return kEm1Rows;
}

void Em1Options::validate() const {
  check_options(*this, em1_options());
}

Extraction extract_em1(std::span<const Vec3> cloud, const Em1Options& options) {
  options.validate();
  const SortedCloud sorted = sort_cloud(cloud);
  return describe(sorted, Em1Search(sorted.points, options).run());
}

}  // namespace hallway::em
