// SPDX-License-Identifier: MIT
#include "eval/pose_pairs.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "eval/point_error.hpp"

namespace hallway::eval {
namespace {

constexpr std::size_t kFewestPairs = 3;

PathFit fit_positions(const Sequence<PosePair>& pairs, bool with_scale) {
  if (pairs.size() < kFewestPairs)
    throw Error(ErrorCode::kBadInput,
                fmt::format("a fit needs {} pairs of poses, and there are {}", kFewestPairs, pairs.size()));
  PathFit fit;
  for (auto next = pairs.read(); const PosePair* pair = next();) {
    fit.from += pair->T_map_body.t / static_cast<double>(pairs.size());
    fit.to += pair->T_world_body.t / static_cast<double>(pairs.size());
  }
  const Sequence<PointPair> centred =
      transformed(pairs, [from = fit.from, to = fit.to](const PosePair& pair) {
        return PointPair{pair.T_world_body.t - to, pair.T_map_body.t - from};
      });
  fit.q = rigid_fit_of(centred)->q;
  fit.rotation_known =
      determine_a_pose(transformed(centred, [](const PointPair& pair) { return pair.estimate; })) &&
      determine_a_pose(transformed(centred, [](const PointPair& pair) { return pair.truth; }));
  if (!with_scale) return fit;
  double common = 0.0, spread = 0.0, reference_spread = 0.0;
  for (auto next = centred.read(); const PointPair* pair = next();) {
    common += pair->truth.dot(fit.q * pair->estimate);
    spread += pair->estimate.squaredNorm();
    reference_spread += pair->truth.squaredNorm();
  }
  constexpr double kRest = 1e-18;  // of the other's spread: a billionth of its way
  const bool both_move = spread > kRest * reference_spread && reference_spread > kRest * spread;
  if (!both_move || !(common > 0.0))
    throw Error(ErrorCode::kBadInput,
                "the estimate does not move as the reference does (or by less than a billionth of it): it "
                "has no scale");
  fit.scale = common / spread;
  return fit;
}

}  // namespace

PathFit align(const Sequence<PosePair>& pairs, Alignment alignment) {
  if (pairs.empty()) throw Error(ErrorCode::kBadInput, "there are no pairs of poses");
  switch (alignment) {
    case Alignment::kNone:
      return {};
    case Alignment::kFirstPose: {
      const auto read = pairs.read();
      const PosePair& first = *read();
      return {.scale = 1.0,
              .q = (first.T_world_body.q * first.T_map_body.q.conjugate()).normalized(),
              .from = first.T_map_body.t,
              .to = first.T_world_body.t};
    }
    case Alignment::kRigid:
      return fit_positions(pairs, false);
    case Alignment::kSimilarity:
      return fit_positions(pairs, true);
  }
  return {};
}

}  // namespace hallway::eval
