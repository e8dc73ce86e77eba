// SPDX-License-Identifier: MIT
#include "em/core/principal_frame.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "em/core/robust_range.hpp"
#include "geometry/symmetric.hpp"

namespace hallway::em {
namespace {

constexpr int kFraction = 26;  // bits of a coordinate by the size of the box; a product of two has 52
constexpr double kSteps = 1 << kFraction;
constexpr std::int64_t kLowMask = (std::int64_t{1} << kFraction) - 1;

using Steps = std::array<std::int64_t, 3>;

/// Sum of products of up to 2 x 26 bits, in two parts so that 2^28 of them do not overflow.
struct ProductSum {
  std::int64_t high = 0;
  std::int64_t low = 0;

  void add(std::int64_t product) {
    high += product >> kFraction;
    low += product & kLowMask;
  }
  void join(const ProductSum& other) {
    high += other.high;
    low += other.low;
  }
  double value() const { return static_cast<double>(high) * kSteps + static_cast<double>(low); }
};

Vec3 middle_of(const Bounds& bounds) {
  return bounds.low + 0.5 * (bounds.high - bounds.low);
}

/// Sums over points, in steps of a 2^-26th of a box from its middle; of products only those of an axis with a later one
/// or itself.
struct StepSums {
  std::int64_t count = 0;
  Steps sums{};
  std::array<ProductSum, 6> products;

  void add(const Steps& at) {
    ++count;
    for (std::size_t k = 0; k < 3; ++k) sums[k] += at[k];
    for (std::size_t k = 0; k < 6; ++k) products[k].add(at[kRow[k]] * at[kColumn[k]]);
  }
  void join(const StepSums& other) {
    count += other.count;
    for (std::size_t k = 0; k < 3; ++k) sums[k] += other.sums[k];
    for (std::size_t k = 0; k < 6; ++k) products[k].join(other.products[k]);
  }

  static constexpr std::array<std::size_t, 6> kRow{0, 0, 0, 1, 1, 2};
  static constexpr std::array<std::size_t, 6> kColumn{0, 1, 2, 1, 2, 2};
};

/// The sums over the points within `bounds`.
StepSums step_sums(std::span<const Vec3> cloud, const Bounds& bounds, double step, Workers& workers) {
  const Vec3 middle = middle_of(bounds);
  std::vector<StepSums> parts(Workers::parts(cloud.size()));
  workers.run_parts(cloud.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!bounds.contains(cloud[i])) continue;
      Steps at;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto axis = static_cast<Eigen::Index>(k);
        at[k] = static_cast<std::int64_t>(std::nearbyint((cloud[i][axis] - middle[axis]) / step));
      }
      parts[part].add(at);
    }
  });
  StepSums all;
  for (const StepSums& part : parts) all.join(part);
  return all;
}

Vec3 mean_of(const StepSums& sums) {
  Vec3 mean;
  for (std::size_t k = 0; k < 3; ++k) {
    mean[static_cast<Eigen::Index>(k)] = static_cast<double>(sums.sums[k]) / static_cast<double>(sums.count);
  }
  return mean;
}

Mat3 covariance_of(const StepSums& sums, const Vec3& mean) {
  Mat3 covariance;
  for (std::size_t k = 0; k < 6; ++k) {
    const auto row = static_cast<Eigen::Index>(StepSums::kRow[k]);
    const auto column = static_cast<Eigen::Index>(StepSums::kColumn[k]);
    const double product = sums.products[k].value() / static_cast<double>(sums.count);
    covariance(row, column) = covariance(column, row) = product - mean[row] * mean[column];
  }
  return covariance;
}

/// The axis or its opposite, on whose side of the origin more points lie.
Vec3 towards_most(std::span<const Vec3> cloud, const Vec3& origin, const Vec3& axis, Workers& workers) {
  std::vector<std::int64_t> parts(Workers::parts(cloud.size()), 0);
  workers.run_parts(cloud.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
    std::int64_t balance = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const double along = axis.dot(cloud[i] - origin);
      balance += (along > 0.0 ? 1 : 0) - (along < 0.0 ? 1 : 0);
    }
    parts[part] = balance;
  });
  return std::accumulate(parts.begin(), parts.end(), std::int64_t{0}) < 0 ? Vec3(-axis) : axis;
}

}  // namespace

CloudFrame principal_frame(std::span<const Vec3> cloud, Workers& workers) {
  const Bounds bounds = robust_bounds(cloud, workers);
  CloudFrame frame;
  frame.origin = middle_of(bounds);
  const double step = (bounds.high - bounds.low).maxCoeff() / kSteps;
  if (!(step > 0.0)) return frame;
  const StepSums sums = step_sums(cloud, bounds, step, workers);
  if (sums.count < 1) return frame;
  const Vec3 mean = mean_of(sums);
  frame.origin += step * mean;
  const Spectrum<3> principal = spectrum(covariance_of(sums, mean));
  const Vec3 first = towards_most(cloud, frame.origin, principal.vectors.col(2).normalized(), workers);
  const Vec3 second = towards_most(cloud, frame.origin, principal.vectors.col(1).normalized(), workers);
  frame.axes.col(0) = first;
  frame.axes.col(1) = second;
  frame.axes.col(2) = first.cross(second);
  // A side of length s, evenly filled, has the variance s^2 / 12.
  frame.extent = step * (12.0 * principal.values.cwiseMax(0.0).reverse()).cwiseSqrt();
  return frame;
}

}  // namespace hallway::em
