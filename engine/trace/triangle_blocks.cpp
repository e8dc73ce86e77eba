// SPDX-License-Identifier: MIT
//
// Why a verdict in single precision agrees with the double-precision predicate.
//
// Let u = 2^-24, R the scene's radius (all numbers below are relative to its centre, vertices within R, the
// segment within 1.02 R), d the segment's delta, E a triangle's longest edge, n its normal (|n| <= E^2).
// Inputs are rounded once, from double: origin and corner by at most uR, delta by u|d|, edges by uE, normal
// by u|n|. For the line's point p = a - origin: |p| <= 2.1 R, error <= 4.2 uR. Then
//
//   c = p x d                      error <= 14 u R |d|
//   volumes c . second, -c . first error <= 23 u R |d| E
//   facing  n . d                  error <=  5 u |n| |d| <= 11 u R |n|, and <= 11 u R |d| E
//   third volume, facing minus the two, error <= 70 u R |d| E
//   depth   n . p                  error <= 13 u R |n|
//
// kRounding = 128 covers the worst of these nearly twice. |d| is taken as |dx| + |dy| + |dz|, E as at least
// 2^-20 R.
//
// The double-precision predicate errs, too, but far less: its volumes by 4e-15 w (w + d) <= 2e-13 R^2 for unit
// direction (w <= 2R, origins within 8 R, which is what sure_within_m() asks for), against the slack of
// 50 u R E > 2e-12 R^2; its normal by 1e-11 for triangles with |n| >= 2^-16 E^2 (thinner ones are never decided
// here), against the slack of the plane's margin, 1e-6 and more. So
//
// - a miss is sure if two volumes have different signs by more than their margins: the predicate then sees the
//   same signs, beyond its own rounding; or if the sign of facing is sure and the plane is met before 0 or
//   after 1 by more than the margins: the predicate then computes a distance out of range;
// - a hit is sure if all volumes have the sign of facing and depth lies between 0 and facing, all by more than
//   the margins, and the line is not flatter than 2^-10 to the plane: the predicate's volumes then agree in sign,
//   its distance is in range, its line does not run along the plane, and its point is off the triangle's box by no
//   more than 1e-16 * 20 R * 2^10, far below box_slack_m().
#include "trace/triangle_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trace/triangle_groups.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace hallway::trace {
namespace {

constexpr double kRounding = 128.0 * 0x1.0p-24;
constexpr double kLeastEdge = 0x1.0p-20;  ///< of the radius
constexpr double kSmallest =
    0x1.0p-30;  ///< of the radius: no product of a smaller triangle comes near underflow
constexpr double kThinnest = 0x1.0p-16;     ///< |n| / E^2 of a triangle that is decided in single precision
constexpr double kLeastLength = 0x1.0p-20;  ///< of the radius; keeps all products far from underflow
constexpr double kSureWithin = 8.0;         ///< radii

constexpr float kInfinity = std::numeric_limits<float>::infinity();

#if defined(__x86_64__)
using Floats = __m256;

__attribute__((target("avx2,fma"))) inline Floats load(const TriangleBlock::Lane& lane) {
  return _mm256_load_ps(lane.data());
}

__attribute__((target("avx2,fma"))) inline Floats dot(const std::array<TriangleBlock::Lane, 3>& lanes,
                                                      Floats x, Floats y, Floats z) {
  return _mm256_fmadd_ps(load(lanes[0]), x,
                         _mm256_fmadd_ps(load(lanes[1]), y, _mm256_mul_ps(load(lanes[2]), z)));
}

/// certify_portable(), eight triangles at a time.
__attribute__((target("avx2,fma"))) Verdict certify_avx2(const TriangleBlock& block,
                                                         const FloatSegment& segment) {
  const Floats minus = _mm256_set1_ps(-0.0f);
  const Floats dx = _mm256_set1_ps(segment.delta[0]);
  const Floats dy = _mm256_set1_ps(segment.delta[1]);
  const Floats dz = _mm256_set1_ps(segment.delta[2]);
  const Floats px = _mm256_sub_ps(load(block.corner[0]), _mm256_set1_ps(segment.origin[0]));
  const Floats py = _mm256_sub_ps(load(block.corner[1]), _mm256_set1_ps(segment.origin[1]));
  const Floats pz = _mm256_sub_ps(load(block.corner[2]), _mm256_set1_ps(segment.origin[2]));
  const Floats cx = _mm256_fmsub_ps(py, dz, _mm256_mul_ps(pz, dy));
  const Floats cy = _mm256_fmsub_ps(pz, dx, _mm256_mul_ps(px, dz));
  const Floats cz = _mm256_fmsub_ps(px, dy, _mm256_mul_ps(py, dx));

  const Floats signed_facing = dot(block.normal, dx, dy, dz);
  const Floats sign = _mm256_and_ps(signed_facing, minus);
  const Floats facing = _mm256_andnot_ps(minus, signed_facing);
  const Floats depth = _mm256_xor_ps(dot(block.normal, px, py, pz), sign);
  const Floats one = _mm256_xor_ps(dot(block.second, cx, cy, cz), sign);
  const Floats two = _mm256_xor_ps(dot(block.first, cx, cy, cz), _mm256_xor_ps(sign, minus));
  const Floats three = _mm256_sub_ps(_mm256_sub_ps(facing, one), two);

  const Floats least = _mm256_min_ps(_mm256_min_ps(one, two), three);
  const Floats most = _mm256_max_ps(_mm256_max_ps(one, two), three);
  const Floats within = _mm256_min_ps(depth, _mm256_sub_ps(facing, depth));
  const Floats area = load(block.area);
  const Floats volume_margin = _mm256_mul_ps(load(block.edge), _mm256_set1_ps(segment.edge_margin));
  const Floats plane_margin = _mm256_mul_ps(area, _mm256_set1_ps(segment.plane_margin));
  const Floats least_facing = _mm256_mul_ps(area, _mm256_set1_ps(segment.least_facing));

  const Floats beside = _mm256_and_ps(_mm256_cmp_ps(least, _mm256_xor_ps(volume_margin, minus), _CMP_LT_OQ),
                                      _mm256_cmp_ps(most, volume_margin, _CMP_GT_OQ));
  const Floats out_of_range =
      _mm256_and_ps(_mm256_cmp_ps(within, _mm256_xor_ps(plane_margin, minus), _CMP_LT_OQ),
                    _mm256_cmp_ps(facing, plane_margin, _CMP_GT_OQ));
  const Floats inside = _mm256_and_ps(_mm256_cmp_ps(least, volume_margin, _CMP_GT_OQ),
                                      _mm256_and_ps(_mm256_cmp_ps(within, plane_margin, _CMP_GT_OQ),
                                                    _mm256_cmp_ps(facing, least_facing, _CMP_GT_OQ)));
  const auto hit = static_cast<std::uint32_t>(_mm256_movemask_ps(inside));
  const auto miss = static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_or_ps(beside, out_of_range)));
  return {hit & block.used, ~miss & block.used};
}
#endif

float at_least(double value) {
  return std::nextafter(static_cast<float>(value), kInfinity);
}

}  // namespace

Verdict certify_portable(const TriangleBlock& block, const FloatSegment& segment) {
  Verdict verdict{0, block.used};
  const auto [dx, dy, dz] = segment.delta;
  for (std::size_t i = 0; i < kBlockSize; ++i) {
    const auto dot = [i](const std::array<TriangleBlock::Lane, 3>& lanes, float x, float y, float z) {
      return lanes[0][i] * x + lanes[1][i] * y + lanes[2][i] * z;
    };
    const float px = block.corner[0][i] - segment.origin[0];
    const float py = block.corner[1][i] - segment.origin[1];
    const float pz = block.corner[2][i] - segment.origin[2];
    const float cx = py * dz - pz * dy;
    const float cy = pz * dx - px * dz;
    const float cz = px * dy - py * dx;
    const float signed_facing = dot(block.normal, dx, dy, dz);
    const float sign = signed_facing < 0.0f ? -1.0f : 1.0f;
    const float facing = sign * signed_facing;
    const float depth = sign * dot(block.normal, px, py, pz);
    const float one = sign * dot(block.second, cx, cy, cz);
    const float two = -sign * dot(block.first, cx, cy, cz);
    const float three = facing - one - two;

    const float least = std::min({one, two, three});
    const float most = std::max({one, two, three});
    const float within = std::min(depth, facing - depth);
    const float volume_margin = block.edge[i] * segment.edge_margin;
    const float plane_margin = block.area[i] * segment.plane_margin;
    const bool beside = least < -volume_margin && most > volume_margin;
    const bool out_of_range = within < -plane_margin && facing > plane_margin;
    const bool inside =
        least > volume_margin && within > plane_margin && facing > block.area[i] * segment.least_facing;
    if (beside || out_of_range) verdict.open &= ~(1u << i);
    if (inside) verdict.hit |= (1u << i) & block.used;
  }
  return verdict;
}

Certify fastest_certify() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return &certify_avx2;
#endif
  return &certify_portable;
}

TriangleBlocks::TriangleBlocks(const TriangleSet& triangles)
    : centre_(triangles.bounds().isEmpty() ? Vec3::Zero() : Vec3(triangles.bounds().center())),
      radius_m_(triangles.radius_m()),
      rounding_(at_least(kRounding * radius_m_)) {
  std::vector<std::uint32_t> with_area;
  std::vector<Box> triangle_boxes;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (triangles.without_area(i)) continue;
    with_area.push_back(i);
    triangle_boxes.push_back(triangles.box(i));
  }
  const Groups groups = group_boxes(triangle_boxes, kBlockSize);
  blocks_.resize(groups.begin.size() - 1);
  boxes_.resize(blocks_.size());
  for (std::size_t g = 0; g < blocks_.size(); ++g) {
    for (std::uint32_t i = groups.begin[g]; i < groups.begin[g + 1]; ++i) {
      const std::uint32_t item = groups.items[i];
      add(triangles, with_area[item], blocks_[g], i - groups.begin[g]);
      boxes_[g].extend(triangle_boxes[item]);
    }
  }
}

void TriangleBlocks::add(const TriangleSet& triangles, std::uint32_t triangle, TriangleBlock& block,
                         std::size_t lane) {
  const auto [a, b, c] = triangles.corners(triangle);
  const Vec3 corner = a - centre_;
  const Vec3 first = b - a;
  const Vec3 second = c - a;
  const Vec3 normal = first.cross(second);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    block.corner[axis][lane] = static_cast<float>(corner[k]);
    block.first[axis][lane] = static_cast<float>(first[k]);
    block.second[axis][lane] = static_cast<float>(second[k]);
    block.normal[axis][lane] = static_cast<float>(normal[k]);
  }
  const double edge = std::max({first.norm(), second.norm(), (c - b).norm()});
  const double area = normal.norm();
  const bool decidable = area >= kThinnest * edge * edge && edge >= kSmallest * radius_m_;
  block.edge[lane] = decidable ? at_least(std::max(edge, kLeastEdge * radius_m_)) : kInfinity;
  block.area[lane] = decidable ? at_least(area) : kInfinity;
  block.triangle[lane] = triangle;
  block.used |= 1u << lane;
}

double TriangleBlocks::least_length_m() const {
  return kLeastLength * radius_m_;
}

double TriangleBlocks::sure_within_m() const {
  return kSureWithin * radius_m_;
}

}  // namespace hallway::trace
