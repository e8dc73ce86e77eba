// SPDX-License-Identifier: MIT
#include "icp/core/registration.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "icp/core/fit.hpp"
#include "icp/core/normals.hpp"

namespace hallway::icp {
namespace {

constexpr std::size_t kFewest = 3;
/// A stage whose step is below this share of its matching distance has done its work.
constexpr double kStageSettled = 0.02;
/// Steps that go round count as settled where they are below this share of the residual.
constexpr double kRound = 0.1;
/// Steps below this share of the coordinates are rounding, however small the residual.
constexpr double kRounding = 1e-13;

/// The state of one registration.
class Search {
 public:
  Search(const Target& target, const Points& source, const Pose& guess, const Rules& rules)
      : target_(target), source_(usable_points(source)), rules_(rules), reach_m_(rules.reach_m) {
    result_.T_target_source = guess;
  }

  Registration run() {
    result_.outcome = iterate();
    if (result_.outcome != Outcome::too_few_points) measure();
    return result_;
  }

 private:
  Outcome iterate() {
    if (source_.size() < kFewest || target_.points().size() < kFewest) return Outcome::too_few_points;
    while (result_.iterations < rules_.max_iterations) {
      if (!match()) return Outcome::no_overlap;
      const std::optional<Pose> motion =
          rules_.metric == Metric::point_to_point ? fit_points(pairs_) : fit_planes(pairs_);
      if (!motion) return Outcome::degenerate;
      ++result_.iterations;
      const double step_m = size_of(*motion);
      result_.T_target_source = *motion * result_.T_target_source;
      if (reach_m_ > rules_.max_distance_m) {
        if (step_m < kStageSettled * reach_m_) reach_m_ = std::max(0.5 * reach_m_, rules_.max_distance_m);
      } else if (step_m <= std::max(rules_.tolerance * residual_m(), kRounding * coordinates_m_)) {
        return Outcome::converged;
      } else if (came_back(step_m)) {
        return Outcome::converged;
      }
    }
    return Outcome::max_iterations;
  }

  /// Whether small steps have led to where they were before: matches that change to and fro make them go round for ever. The pose that is
  /// compared with is renewed after 1, 2, 4, ... steps (Brent 1980), so that rounds of any length are found.
  bool came_back(double step_m) {
    const Pose& now = result_.T_target_source;
    const bool back = mark_ && step_m < kRound * residual_m() &&
                      size_of(now * mark_->inverse()) <= rules_.tolerance * residual_m();
    if (++since_mark_ == to_mark_) {
      mark_ = now;
      since_mark_ = 0;
      to_mark_ *= 2;
    }
    return back;
  }

  /// Pairs each source point with its nearest target, and weights the pairs. False where there are too few.
  bool match() {
    pairs_.clear();
    residuals_.clear();
    matched_.clear();
    const Mat3 rotation = result_.T_target_source.q.toRotationMatrix();
    for (const Vec3& p : source_) {
      const Vec3 moved = rotation * p + result_.T_target_source.t;
      const std::optional<Neighbour> found = target_.tree().nearest(moved, reach_m_);
      if (!found) continue;
      Pair pair{target_.points()[found->index], Vec3::Zero(), moved, 1.0};
      if (rules_.metric == Metric::point_to_plane) {
        pair.normal = target_.normals()[found->index];
        if (pair.normal == Vec3::Zero()) continue;
      }
      residuals_.push_back(rules_.metric == Metric::point_to_plane
                               ? std::abs(pair.normal.dot(pair.target - moved))
                               : std::sqrt(found->distance2));
      pairs_.push_back(pair);
      matched_.push_back(found->index);
    }
    const double scale = rules_.kernel == Kernel::none ? 0.0 : scale_of(residuals_);
    for (std::size_t i = 0; i < pairs_.size(); ++i)
      pairs_[i].weight = weight_of(rules_.kernel, residuals_[i], scale);
    return pairs_.size() >= kFewest;
  }

  /// How far a motion moves the paired points: their mean, and turns at their mean distance from it.
  double size_of(const Pose& motion) {
    Vec3 mean = Vec3::Zero();
    for (const Pair& pair : pairs_) mean += pair.moved;
    mean /= static_cast<double>(pairs_.size());
    double spread2 = 0.0;
    for (const Pair& pair : pairs_) spread2 += (pair.moved - mean).squaredNorm();
    const double radius_m = std::sqrt(spread2 / static_cast<double>(pairs_.size()));
    coordinates_m_ = mean.norm() + radius_m + (result_.T_target_source.t - mean).norm();
    return (motion * mean - mean).norm() + angle_of(motion.q) * radius_m;
  }

  double residual_m() const {
    double sum = 0.0, weight = 0.0;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      sum += pairs_[i].weight * residuals_[i] * residuals_[i];
      weight += pairs_[i].weight;
    }
    return weight > 0.0 ? std::sqrt(sum / weight) : 0.0;
  }

  /// Residual and overlap at the last pose.
  void measure() {
    reach_m_ = rules_.max_distance_m;
    match();
    result_.residual_m = residual_m();
    std::sort(matched_.begin(), matched_.end());
    const auto targets = std::unique(matched_.begin(), matched_.end()) - matched_.begin();
    result_.overlap = std::max(static_cast<double>(pairs_.size()) / static_cast<double>(source_.size()),
                               static_cast<double>(targets) / static_cast<double>(target_.points().size()));
  }

  const Target& target_;
  Points source_;
  const Rules& rules_;
  double reach_m_;
  double coordinates_m_ = 0.0;  // how large those of the paired points are
  std::optional<Pose> mark_;    // see came_back()
  int since_mark_ = 0;
  int to_mark_ = 1;
  Registration result_;
  std::vector<Pair> pairs_;
  std::vector<double> residuals_;       // of pairs_
  std::vector<std::uint32_t> matched_;  // points of the target, of pairs_
};

}  // namespace

std::string_view text_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::converged:
      return "converged";
    case Outcome::max_iterations:
      return "not converged within the iterations allowed";
    case Outcome::too_few_points:
      return "fewer than three points in a cloud";
    case Outcome::no_overlap:
      return "fewer than three points have a match within reach";
    case Outcome::degenerate:
      break;
  }
  return "the matches leave the motion open";
}

Target::Target(const Points& points, std::size_t normal_neighbours)
    : points_(usable_points(points)),
      tree_(points_),
      normals_(normal_neighbours > 0 ? normals_of(points_, tree_, normal_neighbours) : Points()) {}

Registration register_cloud(const Target& target, const Points& source, const Pose& guess,
                            const Rules& rules) {
  return Search(target, source, guess, rules).run();
}

}  // namespace hallway::icp
