// SPDX-License-Identifier: MIT
#include "icp/core/scan_surfels.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/symmetric.hpp"

namespace hallway::icp {
namespace {

constexpr double kWindow_rad = 0.04;  // of turn
constexpr std::uint32_t kLeastColumns = 5;
constexpr double kFull = 0.6;          // share of a window's rays that must have met something
constexpr double kUneven_m = 0.02;     // of a surface that counts as flat
constexpr double kMostChi2 = 2.5;      // of a ray's residual, with noise alone 1
constexpr double kGrazing = 0.05;      // least cosine between normal and ray: less is told of by noise alone
constexpr double kMostTilt_rad = 0.3;  // standard deviation of a normal
constexpr std::size_t kMostWindows = 6000;

/// Weighted sums over rays: direction d, 1/range.
struct Sums {
  Mat3 squares = Mat3::Zero();
  Vec3 products = Vec3::Zero();
  Vec3 directions = Vec3::Zero();
  double inverse2 = 0.0;
  double variance = 0.0;
  double count = 0.0;

  Sums& operator+=(const Sums& other) { return add(other, 1.0); }
  Sums& operator-=(const Sums& other) { return add(other, -1.0); }

 private:
  Sums& add(const Sums& other, double sign) {
    squares += sign * other.squares;
    products += sign * other.products;
    directions += sign * other.directions;
    inverse2 += sign * other.inverse2;
    variance += sign * other.variance;
    count += sign * other.count;
    return *this;
  }
};

/// The rays of a scan as an image: sums from the left edge on, so that those of a window are a difference.
class SumImage {
 public:
  SumImage(const Points& points, std::span<const GridPlace> places, const RangeNoise& noise) {
    for (const GridPlace& place : places) {
      rows_ = std::max(rows_, place.row + 1);
      columns_ = std::max(columns_, place.column + 1);
    }
    sums_.resize(static_cast<std::size_t>(rows_) * (columns_ + 1));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double range_m = points[i].norm();
      if (!(range_m > 0.0)) continue;
      const Vec3 direction = points[i] / range_m;
      const double variance = noise.variance_at(range_m);
      const double weight = std::pow(range_m, 4) / variance;
      Sums sums;
      sums.squares = weight * direction * direction.transpose();
      sums.products = weight / range_m * direction;
      sums.directions = direction;
      sums.inverse2 = weight / (range_m * range_m);
      sums.variance = variance;
      sums.count = 1.0;
      at(places[i].row, places[i].column + 1) += sums;
    }
    for (std::uint32_t row = 0; row < rows_; ++row) {
      for (std::uint32_t column = 1; column <= columns_; ++column) at(row, column) += at(row, column - 1);
    }
  }

  std::uint32_t rows() const { return rows_; }
  std::uint32_t columns() const { return columns_; }

  Sums window(std::uint32_t row, std::uint32_t column, std::uint32_t width) const {
    Sums sums = sums_[index(row, column + width)];
    return sums -= sums_[index(row, column)];
  }

 private:
  std::size_t index(std::uint32_t row, std::uint32_t column) const {
    return static_cast<std::size_t>(row) * (columns_ + 1) + column;
  }
  Sums& at(std::uint32_t row, std::uint32_t column) { return sums_[index(row, column)]; }

  std::uint32_t rows_ = 0, columns_ = 0;
  std::vector<Sums> sums_;
};

/// The plane through a window's rays. @return whether they are of one
bool fit_plane(const Sums& sums, bool planar, double share, Surfel& surfel) {
  Mat3 information = sums.squares;
  if (planar) {  // walls stand on the plane
    information.row(2).setZero();
    information.col(2).setZero();
    information(2, 2) = 1e12 * information.trace();
  }
  const Inverse<3> inverse = inverse_of_positive<3>(information);
  if (!inverse.is_positive) return false;
  surfel.inverse = inverse.matrix * sums.products;
  const double length = surfel.inverse.norm();
  if (!(length > 0.0) || !std::isfinite(length)) return false;
  surfel.normal = surfel.inverse / length;
  const Vec3 direction = sums.directions.normalized();
  const double inverse_range = surfel.inverse.dot(direction);
  const double cosine = inverse_range / length;
  if (!(cosine > kGrazing)) return false;
  const double residual2 = std::max(0.0, sums.inverse2 - surfel.inverse.dot(sums.products));
  const double freedom = sums.count - (planar ? 2.0 : 3.0);
  const double chi2 = residual2 / freedom;
  const double uneven2 = kUneven_m * kUneven_m / (cosine * cosine) / (sums.variance / sums.count);
  if (chi2 > kMostChi2 + uneven2) return false;
  // Rays that other windows share count in each of them only in part.
  surfel.covariance = std::max(1.0, chi2) / share * inverse.matrix;
  const double range_m = 1.0 / inverse_range;
  surfel.point = range_m * direction;
  surfel.variance = std::pow(range_m, 4) * cosine * cosine * direction.dot(surfel.covariance * direction);
  const double tilt2 =
      (surfel.covariance.trace() - surfel.normal.dot(surfel.covariance * surfel.normal)) / (length * length);
  return tilt2 <= kMostTilt_rad * kMostTilt_rad;
}

}  // namespace

std::vector<Surfel> surfels_of(const Points& points, std::span<const GridPlace> places, bool planar,
                               const RangeNoise& noise) {
  std::vector<Surfel> surfels;
  if (points.empty()) return surfels;
  const SumImage image(points, places, noise);
  // Columns are taken to be of even steps of a full turn at most.
  double least = 4.0, most = -4.0;
  for (const Vec3& p : points) {
    const double azimuth = azimuth_of(p);
    least = std::min(least, azimuth);
    most = std::max(most, azimuth);
  }
  const double step = std::max(most - least, 0.01) / image.columns();
  const auto width = std::clamp(static_cast<std::uint32_t>(kWindow_rad / step), kLeastColumns,
                                std::max(kLeastColumns, image.columns()));
  const std::uint32_t rings = planar ? 1 : 3;
  if (image.rows() < rings || image.columns() < width) return surfels;
  const std::uint32_t centres = image.rows() - rings + 1;
  const std::size_t windows = static_cast<std::size_t>(centres) * (image.columns() / width);
  const auto row_step = static_cast<std::uint32_t>(1 + windows / kMostWindows);
  const double share = 1.0 / std::max(1.0, static_cast<double>(rings) / row_step);
  for (std::uint32_t row = 0; row + rings <= image.rows(); row += row_step) {
    for (std::uint32_t column = 0; column + width <= image.columns(); column += width) {
      Sums sums = image.window(row, column, width);
      double fewest = sums.count;
      for (std::uint32_t next = 1; next < rings; ++next) {
        const Sums more = image.window(row + next, column, width);
        fewest = std::min(fewest, more.count);
        sums += more;
      }
      Surfel surfel;
      if (fewest >= kFull * width && fit_plane(sums, planar, share, surfel)) surfels.push_back(surfel);
    }
  }
  return surfels;
}

}  // namespace hallway::icp
