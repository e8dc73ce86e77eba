// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/alignment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/median.hpp"
#include "geometry/symmetric.hpp"

namespace hallway::slam_plane::thesis {
namespace {

constexpr double kSpread =
    4.0;  // median distances from the middle beyond which a point contradicts the others
constexpr double kLeastSpread_m = 1e-3;
constexpr double kLeastCrossing = 0.02;  // sum of squared sines per line, below which lines count as parallel

/// The translation that lines tell; along what they leave open that of the guess.
void place_by_lines(std::span<const PlanePair> pairs, const Pose2& guess, Alignment& result) {
  Mat2 information = Mat2::Zero();
  Vec2 pull = Vec2::Zero();
  for (const PlanePair& pair : pairs) {
    const Vec2 n = left_of(pair.direction[1]);
    information += n * n.transpose();
    pull += n * n.dot(pair.point[1] - result.T_to_from.rotate(pair.point[0]) - guess.t);
  }
  const Spectrum<2> eigen = spectrum(information);
  result.T_to_from.t = guess.t;
  result.determined = eigen.values[0] > kLeastCrossing * static_cast<double>(pairs.size());
  for (int k = result.determined ? 0 : 1; k < 2; ++k) {
    const Vec2 axis = eigen.vectors.col(k);
    result.T_to_from.t += axis * (axis.dot(pull) / eigen.values[k]);
  }
  if (!result.determined) result.open = eigen.vectors.col(0);
}

/// The mean of what points tell, less those that contradict the majority: an end that was mistaken for another one.
Vec2 mean_of_most(const std::vector<Vec2>& places) {
  std::vector<double> x, y, off;
  for (const Vec2& t : places) {
    x.push_back(t.x());
    y.push_back(t.y());
  }
  const Vec2 centre(median(x), median(y));
  for (const Vec2& t : places) off.push_back((t - centre).norm());
  std::vector<double> reordered = off;
  const double bound = places.size() < 3 ? std::numeric_limits<double>::infinity()
                                         : kSpread * median(reordered) + kLeastSpread_m;
  Vec2 sum = Vec2::Zero();
  int count = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (off[i] > bound) continue;
    sum += places[i];
    ++count;
  }
  return sum / count;
}

}  // namespace

Vec2 mean_rotation(std::span<const PlanePair> pairs) {
  Vec2 sum = Vec2::Zero();
  for (const PlanePair& pair : pairs)
    sum += Vec2(pair.direction[0].dot(pair.direction[1]), cross(pair.direction[0], pair.direction[1]));
  return sum.norm() > 0.0 ? Vec2(sum.normalized()) : Vec2(1.0, 0.0);
}

void leave_out_jumps(const Pose2& guess, double bound_m, std::vector<PlanePair>& pairs) {
  const Vec2 turn = mean_rotation(pairs);
  const Pose2 turned{Vec2::Zero(), turn};
  const auto jumps = [&](const PlanePair& pair) {
    return pair.same_point && (pair.point[1] - turned.rotate(pair.point[0]) - guess.t).norm() > bound_m;
  };
  const bool any_near =
      std::ranges::any_of(pairs, [&](const PlanePair& pair) { return pair.same_point && !jumps(pair); });
  if (any_near) std::erase_if(pairs, jumps);
}

std::optional<Alignment> align(std::span<const PlanePair> pairs, const Pose2& guess) {
  if (pairs.empty()) return std::nullopt;
  Alignment result;
  result.T_to_from.r = mean_rotation(pairs);
  std::vector<Vec2> places;
  for (const PlanePair& pair : pairs) {
    if (pair.same_point) places.push_back(pair.point[1] - result.T_to_from.rotate(pair.point[0]));
  }
  if (!places.empty()) {
    result.T_to_from.t = mean_of_most(places);
    result.determined = result.by_points = true;
  } else {
    place_by_lines(pairs, guess, result);
  }
  return result;
}

}  // namespace hallway::slam_plane::thesis
