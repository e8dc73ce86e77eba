// SPDX-License-Identifier: MIT
#include "eval/path_error.hpp"

#include <cstddef>
#include <numbers>

namespace hallway::eval {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
/// Metres or seconds: steps that add up to a delta may fall short of it by rounding.
constexpr double kRounding = 1e-6;
/// A stretch may be so many times longer than it should be.
constexpr double kMostOfDelta = 2.0;

/// How far along a pair is, in the unit.
double place_of(const PosePair& pair, DeltaUnit unit) {
  return unit == DeltaUnit::kMetres ? pair.travelled_m : pair.t_s;
}

std::vector<Stretch> frame_stretches(std::size_t count, std::size_t frames) {
  std::vector<Stretch> result;
  for (std::size_t i = 0; frames > 0 && i + frames < count; ++i) result.push_back({i, i + frames});
  return result;
}

}  // namespace

PathError absolute_error(std::span<const PosePair> pairs, const PathFit& fit) {
  std::vector<double> distances, angles;
  for (const PosePair& pair : pairs) {
    distances.push_back((fit * pair.T_map_body.t - pair.T_world_body.t).norm());
    if (fit.rotation_known)
      angles.push_back(kDegrees * angle_between(pair.T_world_body.q, fit.q * pair.T_map_body.q));
  }
  return {statistics_of(std::move(distances)), statistics_of(std::move(angles))};
}

std::vector<Stretch> stretches(std::span<const PosePair> pairs, const Delta& delta) {
  if (delta.unit == DeltaUnit::kFrames)
    return frame_stretches(pairs.size(), static_cast<std::size_t>(delta.value));
  std::vector<Stretch> result;
  std::size_t j = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double begin = place_of(pairs[i], delta.unit);
    j = std::max(j, i + 1);
    while (j < pairs.size() && place_of(pairs[j], delta.unit) - begin < delta.value - kRounding) ++j;
    if (j >= pairs.size()) break;
    if (place_of(pairs[j], delta.unit) - begin <= kMostOfDelta * delta.value) result.push_back({i, j});
  }
  return result;
}

PathError relative_error(std::span<const PosePair> pairs, const Delta& delta, double scale) {
  std::vector<double> distances, angles;
  for (const Stretch& stretch : stretches(pairs, delta)) {
    const PosePair &from = pairs[stretch.begin], &to = pairs[stretch.end];
    const Quat q_true = from.T_world_body.q.conjugate() * to.T_world_body.q;
    const Quat q_estimated = from.T_map_body.q.conjugate() * to.T_map_body.q;
    const Vec3 t_true = from.T_world_body.q.conjugate() * (to.T_world_body.t - from.T_world_body.t);
    const Vec3 t_estimated = from.T_map_body.q.conjugate() * (scale * (to.T_map_body.t - from.T_map_body.t));
    distances.push_back((t_estimated - t_true).norm());
    angles.push_back(kDegrees * angle_between(q_true, q_estimated));
  }
  return {statistics_of(std::move(distances)), statistics_of(std::move(angles))};
}

}  // namespace hallway::eval
