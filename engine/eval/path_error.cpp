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

/// Calls `take(stretch, from, to)` with each stretch and the pairs at its ends.
template <typename Take>
void for_each_stretch(const Sequence<PosePair>& pairs, const Delta& delta, Take take) {
  const bool by_frames = delta.unit == DeltaUnit::kFrames;
  const std::size_t frames = by_frames ? static_cast<std::size_t>(delta.value) : 1;
  if (frames == 0) return;
  const auto read_from = pairs.read(), read_to = pairs.read();
  const PosePair* to = read_to();
  std::size_t j = 0;
  for (std::size_t i = 0; const PosePair* from = read_from(); ++i) {
    const auto reached = [&] {
      return j >= i + frames && (by_frames || !(place_of(*to, delta.unit) - place_of(*from, delta.unit) <
                                                delta.value - kRounding));
    };
    for (; to != nullptr && !reached(); ++j) to = read_to();
    if (to == nullptr) return;
    if (by_frames || place_of(*to, delta.unit) - place_of(*from, delta.unit) <= kMostOfDelta * delta.value)
      take(Stretch{i, j}, *from, *to);
  }
}

}  // namespace

PathError absolute_error(const Sequence<PosePair>& pairs, const PathFit& fit) {
  std::vector<double> distances, angles;
  distances.reserve(pairs.size());
  if (fit.rotation_known) angles.reserve(pairs.size());
  for (auto next = pairs.read(); const PosePair* pair = next();) {
    distances.push_back((fit * pair->T_map_body.t - pair->T_world_body.t).norm());
    if (fit.rotation_known)
      angles.push_back(kDegrees * angle_between(pair->T_world_body.q, fit.q * pair->T_map_body.q));
  }
  return {statistics_of(std::move(distances)), statistics_of(std::move(angles))};
}

std::vector<Stretch> stretches(const Sequence<PosePair>& pairs, const Delta& delta) {
  std::vector<Stretch> result;
  for_each_stretch(pairs, delta, [&](const Stretch& stretch, const PosePair&, const PosePair&) {
    result.push_back(stretch);
  });
  return result;
}

PathError relative_error(const Sequence<PosePair>& pairs, const Delta& delta, double scale) {
  std::vector<double> distances, angles;
  distances.reserve(pairs.size());
  angles.reserve(pairs.size());
  for_each_stretch(pairs, delta, [&](const Stretch&, const PosePair& from, const PosePair& to) {
    const Quat q_true = from.T_world_body.q.conjugate() * to.T_world_body.q;
    const Quat q_estimated = from.T_map_body.q.conjugate() * to.T_map_body.q;
    const Vec3 t_true = from.T_world_body.q.conjugate() * (to.T_world_body.t - from.T_world_body.t);
    const Vec3 t_estimated = from.T_map_body.q.conjugate() * (scale * (to.T_map_body.t - from.T_map_body.t));
    distances.push_back((t_estimated - t_true).norm());
    angles.push_back(kDegrees * angle_between(q_true, q_estimated));
  });
  return {statistics_of(std::move(distances)), statistics_of(std::move(angles))};
}

}  // namespace hallway::eval
