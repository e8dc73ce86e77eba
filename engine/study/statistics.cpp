// SPDX-License-Identifier: MIT
#include "study/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/random.hpp"

namespace hallway::study {

std::optional<double> mean(std::span<const double> values) {
  if (values.empty()) return std::nullopt;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::optional<double> median(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

double student_975(int freedom) {
  if (freedom <= 1) return 12.7062;
  if (freedom == 2) return 4.30265;
  // Abramowitz and Stegun 26.7.5.
  const double z = inverse_normal_cdf(0.975), n = freedom;
  const double z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z, z9 = z7 * z * z;
  return z + (z3 + z) / (4.0 * n) + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * n * n) +
         (3.0 * z7 + 19.0 * z5 + 17.0 * z3 - 15.0 * z) / (384.0 * n * n * n) +
         (79.0 * z9 + 776.0 * z7 + 1482.0 * z5 - 1920.0 * z3 - 945.0 * z) / (92160.0 * n * n * n * n);
}

std::optional<Interval> mean_interval(std::span<const double> values) {
  if (values.size() < 2) return std::nullopt;
  const double middle = *mean(values), n = static_cast<double>(values.size());
  double squares = 0.0;
  for (const double value : values) squares += (value - middle) * (value - middle);
  const double half = student_975(static_cast<int>(values.size()) - 1) * std::sqrt(squares / (n - 1.0) / n);
  return Interval{middle, middle - half, middle + half};
}

std::optional<Interval> share_interval(std::uint64_t successes, std::uint64_t trials) {
  if (trials == 0) return std::nullopt;
  const double n = static_cast<double>(trials), share = static_cast<double>(successes) / n;
  const double z = inverse_normal_cdf(0.975), z2 = z * z;
  const double middle = (share + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half = z / (1.0 + z2 / n) * std::sqrt(share * (1.0 - share) / n + z2 / (4.0 * n * n));
  // None and all are in their intervals, whatever rounding says.
  return Interval{share, successes == 0 ? 0.0 : middle - half, successes == trials ? 1.0 : middle + half};
}

std::optional<LineFit> fit_line(std::span<const Vec2> points) {
  if (points.size() < 2) return std::nullopt;
  const double n = static_cast<double>(points.size());
  Vec2 middle = Vec2::Zero();
  for (const Vec2& point : points) middle += point / n;
  double xx = 0.0, xy = 0.0;
  for (const Vec2& point : points) {
    const Vec2 d = point - middle;
    xx += d.x() * d.x();
    xy += d.x() * d.y();
  }
  if (!(xx > 0.0)) return std::nullopt;
  LineFit fit{.slope = xy / xx};
  fit.intercept = middle.y() - fit.slope * middle.x();
  if (points.size() > 2) {
    double squares = 0.0;
    for (const Vec2& point : points) {
      const double rest = point.y() - fit.intercept - fit.slope * point.x();
      squares += rest * rest;
    }
    fit.slope_half_width =
        student_975(static_cast<int>(points.size()) - 2) * std::sqrt(squares / (n - 2.0) / xx);
  }
  return fit;
}

std::optional<LineFit> fit_power(std::span<const Vec2> points) {
  std::vector<Vec2> logs;
  for (const Vec2& point : points) {
    if (point.x() > 0.0 && point.y() > 0.0) logs.emplace_back(std::log(point.x()), std::log(point.y()));
  }
  return fit_line(logs);
}

std::optional<RootFit> fit_root_with_floor(std::span<const Vec2> points) {
  // 1 = (scale^2 / x + floor^2) / y^2, linear in both squares.
  double aa = 0.0, ab = 0.0, bb = 0.0, a1 = 0.0, b1 = 0.0;
  std::size_t used = 0;
  for (const Vec2& point : points) {
    if (!(point.x() > 0.0 && point.y() > 0.0)) continue;
    const double b = 1.0 / (point.y() * point.y()), a = b / point.x();
    aa += a * a, ab += a * b, bb += b * b, a1 += a, b1 += b;
    ++used;
  }
  const double determinant = aa * bb - ab * ab;
  if (used < 3 || !(determinant > 1e-12 * aa * bb)) return std::nullopt;
  double scale2 = (a1 * bb - b1 * ab) / determinant, floor2 = (aa * b1 - ab * a1) / determinant;
  if (floor2 < 0.0) floor2 = 0.0, scale2 = a1 / aa;
  if (scale2 < 0.0) scale2 = 0.0, floor2 = b1 / bb;
  return RootFit{std::sqrt(scale2), std::sqrt(floor2)};
}

}  // namespace hallway::study
