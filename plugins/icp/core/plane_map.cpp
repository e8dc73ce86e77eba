// SPDX-License-Identifier: MIT
#include "icp/core/plane_map.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/symmetric.hpp"

namespace hallway::icp {
namespace {

constexpr double kMostScans = 40.0;     // that a patch takes
constexpr double kMostTilt_rad = 0.1;   // standard deviation of a slope of a patch that is used
constexpr double kRough = 0.7;          // of the noise: what a patch may be rough
constexpr double kLeastRough_m = 0.02;  // likewise, where there is less noise
constexpr double kPlace_m = 0.001;      // standard deviation of a patch's place, at least
constexpr double kFaces = 0.8;          // cosine between normals of a surfel and its patch, at least
constexpr double kSideways = 0.45;      // component of a normal from which on it may face that way

using CubeNumber = std::array<std::int64_t, 3>;

CubeNumber cube_at(const Vec3& p, double edge_m) {
  return {static_cast<std::int64_t>(std::floor(p.x() / edge_m)),
          static_cast<std::int64_t>(std::floor(p.y() / edge_m)),
          static_cast<std::int64_t>(std::floor(p.z() / edge_m))};
}

/// 20 bits for each axis, so that cubes a million apart share a key, and 3 for the way that it faces.
std::uint64_t key_of(const CubeNumber& cube, std::uint64_t facing) {
  std::uint64_t key = 0;
  for (const std::int64_t number : cube) key = (key << 20) | (static_cast<std::uint64_t>(number) & 0xfffffu);
  return (key << 3) | facing;
}

std::uint64_t facing_of(const Vec3& normal, int axis) {
  return 2u * static_cast<std::uint64_t>(axis) + (normal(axis) < 0.0 ? 1u : 0u);
}

std::uint64_t facing_of(const Vec3& normal) {
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return facing_of(normal, axis);
}

}  // namespace

PlaneMap::PlaneMap(double cube_m, const RangeNoise& noise, bool planar)
    : cube_m_(cube_m), noise_(noise), planar_(planar) {}

void PlaneMap::add(const std::vector<Surfel>& surfels, const Pose& T_map_sensor, const Mat6& covariance) {
  for (const Surfel& surfel : surfels) {
    for (int level = 0; level < kLevels; ++level) add_to(level, surfel, T_map_sensor);
  }
  for (const std::uint32_t index : touched_) {
    Cell& cell = cells_[index];
    merge(cell, T_map_sensor.t, covariance);
    fit(cell);
  }
  touched_.clear();
}

void PlaneMap::add_to(int level, const Surfel& surfel, const Pose& T_map_sensor) {
  const double edge_m = std::ldexp(cube_m_, -level);
  const Vec3 p = T_map_sensor * surfel.point;
  const Mat3 turn = T_map_sensor.q.toRotationMatrix();
  const Vec3 normal = turn * surfel.normal;
  const CubeNumber cube = cube_at(p, edge_m);
  const auto [place, is_new] = tables_[static_cast<std::size_t>(level)].try_emplace(
      key_of(cube, facing_of(normal)), static_cast<std::uint32_t>(cells_.size()));
  if (is_new) {
    Cell cell;
    cell.key = place->first;
    cell.level = level;
    for (int k = 0; k < 3; ++k)
      cell.centre(k) = edge_m * (static_cast<double>(cube[static_cast<std::size_t>(k)]) + 0.5);
    cell.axes[0] = normal;
    const Vec3 up = std::abs(normal.z()) < 0.9 ? Vec3::UnitZ() : Vec3::UnitX();
    cell.axes[1] = up.cross(normal).normalized();
    cell.axes[2] = normal.cross(cell.axes[1]);
    cells_.push_back(cell);
  }
  Cell& cell = cells_[place->second];
  if (cell.scans >= kMostScans) return;
  const Vec3 inverse = turn * surfel.inverse;
  const double along = inverse.dot(cell.axes[0]);
  if (!(along > 0.5 * inverse.norm())) return;
  // The plane inverse . (x - origin) = 1 as place + slopes in the cell's axes.
  const Vec3 arm = cell.centre - T_map_sensor.t;
  const Vec3 plane((1.0 - inverse.dot(arm)) / along, -inverse.dot(cell.axes[1]) / along,
                   -inverse.dot(cell.axes[2]) / along);
  Mat3 change;
  change.row(0) = -(arm + plane(0) * cell.axes[0]) / along;
  change.row(1) = -(cell.axes[1] + plane(1) * cell.axes[0]) / along;
  change.row(2) = -(cell.axes[2] + plane(2) * cell.axes[0]) / along;
  change *= turn;
  Mat3 covariance = change * surfel.covariance * change.transpose();
  covariance(0, 0) += 1e-8;
  covariance(1, 1) += 1e-8;
  covariance(2, 2) += 1e-8;
  const Inverse<3> information = inverse_of_positive<3>(covariance);
  if (!information.is_positive) return;
  Sum& scan = cell.scan;
  if (scan.count == 0.0) touched_.push_back(place->second);
  const Vec3 weighted = information.matrix * plane;
  scan.information += information.matrix;
  scan.weighted += weighted;
  scan.squares += plane.dot(weighted);
  scan.variance += surfel.variance;
  scan.count += 1.0;
}

/// Takes over what the scan saw in a cell, with the error of its pose, which all of its surfels share.
void PlaneMap::merge(Cell& cell, const Vec3& origin, const Mat6& covariance) const {
  const Sum scan = cell.scan;
  cell.scan = Sum();
  const Inverse<3> own = inverse_of_positive<3>(scan.information);
  if (!own.is_positive) return;
  const Vec3 plane = own.matrix * scan.weighted;
  Eigen::Matrix<double, 3, 6> by_pose;
  by_pose.setZero();
  by_pose.row(0).head<3>() = cell.axes[0];
  by_pose.row(0).tail<3>() = (cell.centre - origin).cross(cell.axes[0]);
  by_pose.row(1).tail<3>() = cell.axes[1].cross(cell.axes[0]);
  by_pose.row(2).tail<3>() = cell.axes[2].cross(cell.axes[0]);
  const Mat3 error = own.matrix + by_pose * covariance * by_pose.transpose();
  const Inverse<3> information = inverse_of_positive<3>(error);
  if (!information.is_positive) return;
  cell.excess += std::max(0.0, scan.squares - plane.dot(scan.weighted));
  cell.freedom += 3.0 * (scan.count - 1.0);
  if (cell.all.count > 0.0) {  // also how it stands to the scans before
    const Inverse<3> before = inverse_of_positive<3>(cell.all.information);
    const Vec3 gap = plane - before.matrix * cell.all.weighted;
    const Inverse<3> gap_information = inverse_of_positive<3>(error + before.matrix);
    if (gap_information.is_positive) cell.excess += gap.dot(gap_information.matrix * gap);
    cell.freedom += 3.0;
  }
  cell.all.information += information.matrix;
  cell.all.weighted += information.matrix * plane;
  cell.all.variance += scan.variance;
  cell.all.count += scan.count;
  cell.scans += 1.0;
}

void PlaneMap::fit(Cell& cell) const {
  cell.flat = false;
  const Inverse<3> inverse = inverse_of_positive<3>(cell.all.information);
  if (!inverse.is_positive) return;
  const double dispersion = cell.freedom > 0.0 ? std::max(1.0, cell.excess / cell.freedom) : 1.0;
  const Vec3 plane = inverse.matrix * cell.all.weighted;
  Patch& patch = cell.patch;
  patch.normal = (cell.axes[0] - plane(1) * cell.axes[1] - plane(2) * cell.axes[2]).normalized();
  patch.mean = cell.centre + plane(0) * cell.axes[0];
  patch.across[0] = cell.axes[1];
  patch.across[1] = cell.axes[2];
  patch.covariance = dispersion * inverse.matrix;
  patch.covariance(0, 0) += kPlace_m * kPlace_m;
  patch.rough2 = (dispersion - 1.0) * cell.all.variance / cell.all.count;
  const double rough_m = std::max(kRough * noise_.noise_m, kLeastRough_m);
  const double most2 = kMostTilt_rad * kMostTilt_rad;
  cell.flat = patch.rough2 <= rough_m * rough_m && patch.covariance(1, 1) <= most2 &&
              (planar_ || patch.covariance(2, 2) <= most2);
}

void PlaneMap::forget_beyond(const Vec3& place, double radius_m) {
  const auto gone = [&](const Cell& cell) { return (cell.centre - place).norm() > radius_m; };
  if (std::none_of(cells_.begin(), cells_.end(), gone)) return;
  cells_.erase(std::remove_if(cells_.begin(), cells_.end(), gone), cells_.end());
  for (Table& table : tables_) table.clear();
  for (std::size_t i = 0; i < cells_.size(); ++i)
    tables_[static_cast<std::size_t>(cells_[i].level)][cells_[i].key] = static_cast<std::uint32_t>(i);
}

/// Of the flat patches in a cube that face as the normal does, the nearest below `least_m`, which becomes its distance.
int PlaneMap::nearest_flat(int level, const CubeNumber& cube, const Vec3& p, const Vec3& normal,
                           double& least_m) const {
  const Table& table = tables_[static_cast<std::size_t>(level)];
  int best = -1;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(normal(axis)) < kSideways) continue;
    const auto found = table.find(key_of(cube, facing_of(normal, axis)));
    if (found == table.end()) continue;
    const Cell& cell = cells_[found->second];
    if (!cell.flat || cell.patch.normal.dot(normal) < kFaces) continue;
    const double distance_m = std::abs(cell.patch.normal.dot(p - cell.patch.mean));
    if (distance_m > least_m) continue;
    least_m = distance_m;
    best = static_cast<int>(found->second);
  }
  return best;
}

int PlaneMap::find(const Vec3& p, const Vec3& normal, double reach_m) const {
  for (int level = 0; level < kLevels; ++level) {
    const double edge_m = std::ldexp(cube_m_, -level);
    const CubeNumber cube = cube_at(p, edge_m);
    double least_m = reach_m;
    int best = nearest_flat(level, cube, p, normal, least_m);
    if (best >= 0) return best;
    // Of a neighbour's patch only what is near: a plane goes on for ever, a surface does not.
    for (std::size_t axis = 0; axis < (planar_ ? 2u : 3u); ++axis) {
      const double into = p(static_cast<int>(axis)) / edge_m - static_cast<double>(cube[axis]);
      CubeNumber next = cube;
      next[axis] += into < 0.5 ? -1 : 1;
      const int other = nearest_flat(level, next, p, normal, least_m);
      if (other >= 0) best = other;
    }
    if (best >= 0) return best;
  }
  return -1;
}

std::vector<Patch> PlaneMap::patches() const {
  std::vector<Patch> result;
  for (const Cell& cell : cells_) {
    if (cell.flat) result.push_back(cell.patch);
  }
  return result;
}

}  // namespace hallway::icp
