// SPDX-License-Identifier: MIT
#include "geom/exact_plane.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <optional>

#include "geom/exact_sign.hpp"

namespace hallway {
namespace {

__extension__ using Whole128 = __int128;  // not ISO C++, but on both compilers
using Whole3 = std::array<std::int64_t, 3>;

constexpr int kGridBits = 8;                ///< the grid's step is 2^-8 of a unit
constexpr double kGrid = 1 << kGridBits;    ///< steps in a unit
constexpr double kGridReach = 131072.0;     ///< largest coordinate of a grid point
constexpr double kShortNormal = 1 << 18;    ///< largest a, b, c of short numbers
constexpr double kShortOffset = 1ll << 40;  ///< largest d of short numbers, a multiple of the grid's step
constexpr double kRounding = 0x1p-53;       ///< half the distance from 1 to the next double
constexpr double kNormalStep = 1e-3;        ///< of the hash of normals
constexpr double kNormalMargin = 1e-5;      ///< how far apart the normals of merged planes may be
constexpr double kOffsetMargin = 0.02;      ///< how far apart their offsets may be
constexpr std::size_t kBuckets = 1 << 14;

int bits_of(std::int64_t value) {
  return static_cast<int>(std::bit_width(static_cast<std::uint64_t>(std::llabs(value))));
}

/// Whole numbers that are the three points times 2^shift, if they are short enough for exact products.
std::optional<std::array<Whole3, 3>> whole_points(const std::array<Vec3, 3>& points, int& shift) {
  constexpr double kLargest = 1 << 24;
  for (shift = 0; shift <= kGridBits; ++shift) {
    const double factor = std::ldexp(1.0, shift);
    std::array<Whole3, 3> whole{};
    bool good = true;
    for (std::size_t i = 0; i < 3 && good; ++i) {
      for (std::size_t k = 0; k < 3 && good; ++k) {
        const double value = points[i][static_cast<Eigen::Index>(k)] * factor;
        good = std::abs(value) <= kLargest && value == std::floor(value);
        if (good) whole[i][k] = static_cast<std::int64_t>(value);
      }
    }
    if (good) return whole;
  }
  return std::nullopt;
}

Whole3 minus(const Whole3& a, const Whole3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Whole3 cross(const Whole3& a, const Whole3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The plane through points of a grid, its coefficients without a common factor; empty if they do not fit doubles.
std::optional<std::array<double, 4>> grid_plane(const std::array<Vec3, 3>& points) {
  int shift = 0;
  const auto whole = whole_points(points, shift);
  if (!whole) return std::nullopt;
  Whole3 normal = cross(minus((*whole)[2], (*whole)[0]), minus((*whole)[1], (*whole)[0]));
  const std::int64_t common = std::gcd(std::gcd(normal[0], normal[1]), normal[2]);
  if (common == 0) return std::nullopt;
  Whole128 offset = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    normal[k] /= common;
    offset += static_cast<Whole128>(normal[k]) * (*whole)[0][k];
  }
  constexpr std::int64_t kExact = std::int64_t{1} << 53;
  if (offset > kExact || offset < -kExact) return std::nullopt;
  std::array<double, 4> abcd{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::llabs(normal[k]) > kExact) return std::nullopt;
    abcd[k] = static_cast<double>(normal[k]);
  }
  abcd[3] = std::ldexp(static_cast<double>(static_cast<std::int64_t>(offset)), -shift);
  return abcd;
}

std::array<double, 4> rounded_plane(const std::array<Vec3, 3>& points) {
  using Long3 = Eigen::Matrix<long double, 3, 1>;
  const Long3 origin = points[0].cast<long double>();
  const Long3 u = points[2].cast<long double>() - origin;
  const Long3 v = points[1].cast<long double>() - origin;
  const Long3 normal = u.cross(v).normalized();
  const Vec3 n = normal.cast<double>();
  // The offset is that of the rounded normal, so that the plane still passes through the first point.
  const long double offset = n.cast<long double>().dot(origin);
  return {n.x(), n.y(), n.z(), static_cast<double>(offset)};
}

/// One of the two orientations, the same one for planes that are nearly alike.
bool is_flipped(const std::array<double, 4>& abcd) {
  return abcd[0] + 0.7316 * abcd[1] + 0.4189 * abcd[2] < 0.0;
}

ExactPlane make_plane(const std::array<double, 4>& abcd) {
  ExactPlane plane;
  plane.abcd = abcd;
  const Vec3 normal(abcd[0], abcd[1], abcd[2]);
  const double length = normal.norm();
  plane.unit = {normal / length, abcd[3] / length};
  plane.whole = true;
  double normal_max = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const double value = abcd[k] * kGrid;
    plane.whole = plane.whole && value == std::floor(value) && std::abs(value) < 0x1p62;
    if (plane.whole) plane.whole_abcd[k] = static_cast<std::int64_t>(value);
    if (k < 3) normal_max = std::max(normal_max, std::abs(abcd[k]));
  }
  const bool whole_normal =
      abcd[0] == std::floor(abcd[0]) && abcd[1] == std::floor(abcd[1]) && abcd[2] == std::floor(abcd[2]);
  plane.short_numbers =
      plane.whole && whole_normal && normal_max <= kShortNormal && std::abs(abcd[3]) <= kShortOffset;
  for (std::size_t k = 0; k < 3; ++k)
    plane.normal_bits = std::max(plane.normal_bits, bits_of(plane.whole_abcd[k]));
  plane.offset_bits = bits_of(plane.whole_abcd[3]);
  return plane;
}

std::size_t bucket_of(const std::array<std::int64_t, 4>& key) {
  std::uint64_t hash = 1469598103934665603ull;
  for (const std::int64_t part : key) hash = (hash ^ static_cast<std::uint64_t>(part)) * 1099511628211ull;
  return static_cast<std::size_t>((hash ^ (hash >> 29)) % kBuckets);
}

/// The cells of the hash that planes nearly like this one may stand in; the first is its own.
std::vector<std::size_t> buckets_near(const Plane& unit) {
  const std::array<double, 4> values{unit.normal.x() / kNormalStep, unit.normal.y() / kNormalStep,
                                     unit.normal.z() / kNormalStep, unit.offset};
  const std::array<double, 4> margins{kNormalMargin / kNormalStep, kNormalMargin / kNormalStep,
                                      kNormalMargin / kNormalStep, kOffsetMargin};
  std::array<std::array<std::int64_t, 2>, 4> options{};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto own = static_cast<std::int64_t>(std::floor(values[k] + 0.5));
    const auto low = static_cast<std::int64_t>(std::floor(values[k] + 0.5 - margins[k]));
    const auto high = static_cast<std::int64_t>(std::floor(values[k] + 0.5 + margins[k]));
    options[k] = {own, low != own ? low : high};
  }
  std::vector<std::size_t> buckets;
  for (unsigned mask = 0; mask < 16; ++mask) {
    std::array<std::int64_t, 4> key{};
    bool doubled = false;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t pick = (mask >> k) & 1u;
      doubled = doubled || (pick == 1 && options[k][1] == options[k][0]);
      key[k] = options[k][pick];
    }
    if (!doubled) buckets.push_back(bucket_of(key));
  }
  return buckets;
}

Whole128 determinant3(const ExactPlane& a, const ExactPlane& b, const ExactPlane& c, std::size_t i,
                      std::size_t j, std::size_t k) {
  const auto& p = a.whole_abcd;
  const auto& q = b.whole_abcd;
  const auto& r = c.whole_abcd;
  const auto minor = [](std::int64_t u, std::int64_t v, std::int64_t w, std::int64_t x) {
    return static_cast<Whole128>(u) * x - static_cast<Whole128>(v) * w;
  };
  return minor(q[j], q[k], r[j], r[k]) * p[i] - minor(q[i], q[k], r[i], r[k]) * p[j] +
         minor(q[i], q[j], r[i], r[j]) * p[k];
}

int sign_of(Whole128 value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

/// True if no determinant of these four planes overflows 128 bits.
bool fits_128(const ExactPlane& a, const ExactPlane& b, const ExactPlane& c, const ExactPlane& d) {
  constexpr int kRoom = 120;  // 127 less the bits of 24 terms
  if (!(a.whole && b.whole && c.whole && d.whole)) return false;
  const int all = a.normal_bits + b.normal_bits + c.normal_bits + d.normal_bits;
  int most = 0;
  for (const ExactPlane* plane : {&a, &b, &c, &d}) {
    most = std::max(most, all - plane->normal_bits + std::max(plane->offset_bits, plane->normal_bits));
  }
  return most <= kRoom;
}

std::array<double, 3> normal_of(const ExactPlane& plane) {
  return {plane.abcd[0], plane.abcd[1], plane.abcd[2]};
}

}  // namespace

OrientedPlane PlaneSet::add(const std::array<Vec3, 3>& points, const std::vector<Vec3>& extent,
                            double merge_distance) {
  const auto exact = grid_plane(points);
  return find_or_add(exact ? *exact : rounded_plane(points), extent, merge_distance);
}

OrientedPlane PlaneSet::add_axial(int axis, double value) {
  std::array<double, 4> abcd{0.0, 0.0, 0.0, value};
  abcd[static_cast<std::size_t>(axis)] = 1.0;
  return find_or_add(abcd, {}, 0.0);
}

OrientedPlane PlaneSet::find_or_add(const std::array<double, 4>& given, const std::vector<Vec3>& extent,
                                    double merge_distance) {
  std::array<double, 4> abcd = given;
  const bool flipped = is_flipped(given);
  if (flipped) {
    for (double& value : abcd) value = value == 0.0 ? 0.0 : -value;
  }
  ExactPlane plane = make_plane(abcd);
  if (buckets_.empty()) buckets_.resize(kBuckets);
  const auto is_near = [&](const ExactPlane& other) {
    if ((other.unit.normal - plane.unit.normal).cwiseAbs().maxCoeff() > kNormalMargin) return false;
    if (extent.empty() || std::abs(other.unit.offset - plane.unit.offset) > kOffsetMargin) return false;
    return std::all_of(extent.begin(), extent.end(), [&](const Vec3& corner) {
      return std::abs(other.unit.distance(corner)) <= merge_distance;
    });
  };
  const std::vector<std::size_t> near = buckets_near(plane.unit);
  std::optional<std::uint32_t> found;
  for (const std::size_t bucket : near) {
    for (const std::uint32_t index : buckets_[bucket]) {
      if (planes_[index].abcd == abcd) return {index, flipped};
      if ((!found || index < *found) && is_near(planes_[index])) found = index;
    }
  }
  if (found) return {*found, flipped};
  const auto index = static_cast<std::uint32_t>(planes_.size());
  planes_.push_back(plane);
  buckets_[near.front()].push_back(index);
  return {index, flipped};
}

Plane PlaneSet::unit(OrientedPlane plane) const {
  const Plane& own = planes_[plane.index].unit;
  return plane.flipped ? Plane{-own.normal, -own.offset} : own;
}

PlaneSet::Side PlaneSet::side(std::uint32_t plane, const ExactPoint& point) const {
  if (point.planes[0] == plane || point.planes[1] == plane || point.planes[2] == plane) return Side::kOn;
  const ExactPlane& p = planes_[plane];
  const double x = p.abcd[0] * point.at.x();
  const double y = p.abcd[1] * point.at.y();
  const double z = p.abcd[2] * point.at.z();
  const double value = (x + y + z) - p.abcd[3];
  if (point.on_grid && p.short_numbers)
    return value > 0.0 ? Side::kFront : value < 0.0 ? Side::kBack : Side::kOn;
  const double size = std::abs(x) + std::abs(y) + std::abs(z) + std::abs(p.abcd[3]);
  const double slope = std::abs(p.abcd[0]) + std::abs(p.abcd[1]) + std::abs(p.abcd[2]);
  const double bound = 1.001 * slope * point.error + 8.0 * kRounding * size;
  if (value > bound) return Side::kFront;
  if (value < -bound) return Side::kBack;
  return side_exact(plane, point);
}

PlaneSet::Side PlaneSet::side_exact(std::uint32_t plane, const ExactPoint& point) const {
  const ExactPlane& a = planes_[point.planes[0]];
  const ExactPlane& b = planes_[point.planes[1]];
  const ExactPlane& c = planes_[point.planes[2]];
  const ExactPlane& d = planes_[plane];
  int corner = 0;  // sign of the determinant of the three normals
  int all = 0;     // sign of the determinant of the four planes
  if (fits_128(a, b, c, d)) {
    corner = sign_of(determinant3(a, b, c, 0, 1, 2));
    all = sign_of(
        determinant3(a, b, c, 0, 1, 2) * d.whole_abcd[3] - determinant3(a, b, d, 0, 1, 2) * c.whole_abcd[3] +
        determinant3(a, c, d, 0, 1, 2) * b.whole_abcd[3] - determinant3(b, c, d, 0, 1, 2) * a.whole_abcd[3]);
  } else {
    corner = sign_of_determinant({normal_of(a), normal_of(b), normal_of(c)});
    all = sign_of_determinant({a.abcd, b.abcd, c.abcd, d.abcd});
  }
  // Subtracting the columns times the point's coordinates from the last one leaves d - n . x in its last row alone.
  return static_cast<Side>(-corner * all);
}

ExactPoint PlaneSet::intersect(std::uint32_t ia, std::uint32_t ib, std::uint32_t ic) const {
  using Long3 = Eigen::Matrix<long double, 3, 1>;
  ExactPoint point;
  point.planes = {ia, ib, ic};
  std::array<Long3, 3> n;
  std::array<long double, 3> d{};
  for (std::size_t i = 0; i < 3; ++i) {
    const ExactPlane& plane = planes_[point.planes[i]];
    n[i] = Long3(plane.abcd[0], plane.abcd[1], plane.abcd[2]);
    d[i] = plane.abcd[3];
  }
  const Long3 bc = n[1].cross(n[2]);
  const Long3 ca = n[2].cross(n[0]);
  const Long3 ab = n[0].cross(n[1]);
  const long double det = n[0].dot(bc);
  const Long3 sum = bc * d[0] + ca * d[1] + ab * d[2];
  const Long3 exact = sum / det;
  point.at = exact.cast<double>();
  // Rounding of the numerator and of the determinant (64-bit significands), generously, and of the result to doubles.
  const long double size = n[0].lpNorm<1>() * n[1].lpNorm<1>() * n[2].lpNorm<1>();
  const long double reach = exact.cwiseAbs().maxCoeff();
  const long double offsets = std::abs(d[0]) / n[0].lpNorm<1>() + std::abs(d[1]) / n[1].lpNorm<1>() +
                              std::abs(d[2]) / n[2].lpNorm<1>();
  point.error = static_cast<double>(0x1p-59L * size * (reach + offsets) / std::abs(det) + 0x1p-52L * reach);
  // Where two of the planes nearly coincide, rounding moves the point along them by far more than by its own last bits.
  constexpr long double kLastBits = 0x1p-45L;
  const bool stable = 0x1p-59L * size < 0.25L * std::abs(det);
  if (!stable || point.error > static_cast<double>(kLastBits * (1.0L + reach))) {
    const auto x = exact_solution({planes_[ia].abcd, planes_[ib].abcd, planes_[ic].abcd});
    point.at = Vec3(x[0], x[1], x[2]);
    point.error = 0x1p-51 * point.at.cwiseAbs().maxCoeff();
    return point;
  }
  if (!(point.error < 1e-3) || !(reach <= static_cast<long double>(kGridReach))) return point;
  const Vec3 snapped = (point.at * kGrid).array().round() / kGrid;
  if ((snapped - point.at).cwiseAbs().maxCoeff() > point.error) return point;
  for (const std::uint32_t index : point.planes) {
    const ExactPlane& p = planes_[index];
    if (!p.short_numbers) return point;
    if (p.abcd[0] * snapped.x() + p.abcd[1] * snapped.y() + p.abcd[2] * snapped.z() != p.abcd[3])
      return point;
  }
  point.at = snapped + Vec3::Zero();  // no negative zero
  point.error = 0.0;
  point.on_grid = true;
  return point;
}

bool PlaneSet::same(const ExactPoint& a, const ExactPoint& b) const {
  if (a.on_grid && b.on_grid) return a.at == b.at;
  if ((a.at - b.at).cwiseAbs().maxCoeff() > a.error + b.error) return false;
  return std::all_of(b.planes.begin(), b.planes.end(),
                     [&](std::uint32_t plane) { return side(plane, a) == Side::kOn; });
}

}  // namespace hallway
