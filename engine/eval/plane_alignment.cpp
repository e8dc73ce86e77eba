// SPDX-License-Identifier: MIT
#include "eval/plane_alignment.hpp"

#include "geometry/symmetric.hpp"

namespace hallway::eval {
namespace {

constexpr int kSteps = 10;
constexpr double kLeastShare = 1e-6;  ///< of the largest eigenvalue, of a direction that is determined

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

}  // namespace

std::optional<Pose> align_to_planes(std::span<const PointOnPlane> points, const Pose& start) {
  if (points.empty()) return std::nullopt;
  Vec3 middle = Vec3::Zero();
  for (const PointOnPlane& point : points) middle += point.point / static_cast<double>(points.size());
  Pose T = start;
  for (int step = 0; step < kSteps; ++step) {
    const Vec3 centre = T * middle;
    Mat6 h = Mat6::Zero();
    Vec6 g = Vec6::Zero();
    for (const PointOnPlane& point : points) {
      const Vec3 at = T * point.point;
      Vec6 row;
      row << point.plane.normal, (at - centre).cross(point.plane.normal);
      h += row * row.transpose();
      g -= row * point.plane.distance(at);
    }
    const Vec6 values = spectrum<6>(h).values;
    if (!(values(0) > kLeastShare * values(5))) return std::nullopt;
    const Vec6 move = Ldlt<6>(h).inverse() * g;
    const Vec3 turn = move.tail<3>();
    Quat q = Quat::Identity();
    if (turn.norm() > 0.0) q = Quat(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
    T.t = centre + q * (T.t - centre) + move.head<3>();
    T.q = (q * T.q).normalized();
  }
  return T;
}

}  // namespace hallway::eval
