// SPDX-License-Identifier: MIT
#include "eval/path_verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "geometry/rigid_fit.hpp"

namespace hallway::eval {

namespace {

/// The larger error. One that is no number, as of a position whose square is none, is as large as can be.
double worse_of(double worst, double error) {
  return std::isnan(error) ? std::numeric_limits<double>::infinity() : std::max(worst, error);
}

}  // namespace

const char* name_of(PathVerdict verdict) {
  constexpr std::array kNames{"ok", "diverged", "lost"};
  return kNames.at(static_cast<std::size_t>(verdict));
}

double extent_of(const Sequence<Vec3>& path) {
  Vec3 mean = Vec3::Zero();
  for (auto next = path.read(); const Vec3* position = next();)
    mean += *position / static_cast<double>(path.size());
  double farthest = 0.0;
  for (auto next = path.read(); const Vec3* position = next();)
    farthest = std::max(farthest, (*position - mean).norm());
  return 2.0 * farthest;
}

std::optional<Divergence> divergence_of(const Sequence<PosePair>& pairs, double extent_m, Judged judged,
                                        Alignment alignment, double noise_m) {
  constexpr std::size_t kFewestPairs = 3;
  if (pairs.size() < kFewestPairs) return std::nullopt;
  const bool judge_rotation = judged == Judged::kAll;
  const PathFit fit = align(pairs, alignment);
  Divergence divergence;
  divergence.limit_m = std::max(
      {Divergence::kLeastLimit_m, Divergence::kNoises * noise_m, Divergence::kShareOfExtent * extent_m});
  Quat q_world_map = Quat::Identity();
  if (judge_rotation) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (auto next = pairs.read(); const PosePair* pair = next();)
      sum += (pair->T_world_body.q * pair->T_map_body.q.conjugate()).toRotationMatrix();
    q_world_map = nearest_rotation(sum);
    divergence.worst_deg = 0.0;
  }
  std::size_t i = 0;
  for (auto next = pairs.read(); const PosePair* pair = next(); ++i) {
    const double error_m = (fit * pair->T_map_body.t - pair->T_world_body.t).norm();
    divergence.worst_m = worse_of(divergence.worst_m, error_m);
    bool over = !(error_m <= divergence.limit_m);
    if (judge_rotation) {
      const double error_deg =
          180.0 / std::numbers::pi * angle_between(pair->T_world_body.q, q_world_map * pair->T_map_body.q);
      divergence.worst_deg = worse_of(*divergence.worst_deg, error_deg);
      over = over || !(error_deg <= Divergence::kLimit_deg);
    }
    if (over && !divergence.first) divergence.first = i;
  }
  return divergence;
}

bool PoseCount::lost() const {
  constexpr std::uint64_t kLastShare = 10;   // one in ten
  constexpr std::uint64_t kOtherShare = 20;  // one in twenty
  if (frames == 0) return false;
  if (2 * scored < frames || kOtherShare * other_parts > frames || !ends_in_scored || map_forgotten)
    return true;
  return kLastShare * (frames - 1 - last_scored) >= frames;
}

std::optional<PathVerdict> judge(const PoseCount& count, const std::optional<Divergence>& divergence) {
  if (divergence && divergence->diverged()) return PathVerdict::kDiverged;
  if (count.lost()) return PathVerdict::kLost;
  if (!divergence) return std::nullopt;
  return PathVerdict::kOk;
}

}  // namespace hallway::eval
