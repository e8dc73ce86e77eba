// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/alignment.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace hallway::slam_plane::thesis {
namespace {

constexpr double kLeastCrossing = 0.02;  // sum of squared sines per line, below which lines count as parallel

Vec2 mean_rotation(std::span<const PlanePair> pairs) {
  Vec2 sum = Vec2::Zero();
  for (const PlanePair& pair : pairs)
    sum += Vec2(pair.direction[0].dot(pair.direction[1]), cross(pair.direction[0], pair.direction[1]));
  return sum.norm() > 0.0 ? Vec2(sum.normalized()) : Vec2(1.0, 0.0);
}

/// The translation that lines tell; along what they leave open that of the guess.
void place_by_lines(std::span<const PlanePair> pairs, const Pose2& guess, Alignment& result) {
  Mat2 information = Mat2::Zero();
  Vec2 pull = Vec2::Zero();
  for (const PlanePair& pair : pairs) {
    const Vec2 n = left_of(pair.direction[1]);
    information += n * n.transpose();
    pull += n * n.dot(pair.point[1] - result.T_to_from.rotate(pair.point[0]) - guess.t);
  }
  const Eigen::SelfAdjointEigenSolver<Mat2> eigen(information);
  result.T_to_from.t = guess.t;
  result.determined = eigen.eigenvalues()[0] > kLeastCrossing * static_cast<double>(pairs.size());
  for (int k = result.determined ? 0 : 1; k < 2; ++k) {
    const Vec2 axis = eigen.eigenvectors().col(k);
    result.T_to_from.t += axis * (axis.dot(pull) / eigen.eigenvalues()[k]);
  }
  if (!result.determined) result.open = eigen.eigenvectors().col(0);
}

}  // namespace

std::optional<Alignment> align(std::span<const PlanePair> pairs, const Pose2& guess) {
  if (pairs.empty()) return std::nullopt;
  Alignment result;
  result.T_to_from.r = mean_rotation(pairs);
  Vec2 sum = Vec2::Zero();
  int points = 0;
  for (const PlanePair& pair : pairs) {
    if (!pair.same_point) continue;
    sum += pair.point[1] - result.T_to_from.rotate(pair.point[0]);
    ++points;
  }
  if (points > 0) {
    result.T_to_from.t = sum / points;
    result.determined = result.by_points = true;
  } else {
    place_by_lines(pairs, guess, result);
  }
  return result;
}

}  // namespace hallway::slam_plane::thesis
