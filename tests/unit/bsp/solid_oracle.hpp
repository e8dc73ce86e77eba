// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "map/world.hpp"

namespace hallway::test {

/// What of a segment lies in the solid of a world, from its brushes alone.
class SolidOracle {
 public:
  /// @param inflate_m  how much more solid the world is taken to be, everywhere: what adds is larger, what subtracts smaller
  SolidOracle(const map::World& world, double inflate_m) : inflate_m_(inflate_m) {
    for (const map::Solid& solid : world.solids) {
      if (solid.role != map::BrushRole::kHint) solids_.push_back(&solid);
    }
  }

  bool is_solid(const Vec3& point) const {
    for (auto solid = solids_.rbegin(); solid != solids_.rend(); ++solid) {
      if ((*solid)->contains(point, -margin(**solid))) return adds(**solid);
    }
    return false;
  }

  /// The fraction of a segment at which it enters solid.
  std::optional<double> first_solid(const Vec3& from, const Vec3& to) const {
    std::vector<Span> spans;
    std::vector<double> times{0.0, 1.0};
    for (const map::Solid* solid : solids_) {
      Span span{0.0, 1.0, adds(*solid)};
      for (const Plane& plane : solid->planes)
        clip(span, plane.distance(from) - margin(*solid), plane.distance(to) - margin(*solid));
      if (span.begin >= span.end) continue;
      spans.push_back(span);
      times.push_back(span.begin);
      times.push_back(span.end);
    }
    std::sort(times.begin(), times.end());
    for (std::size_t i = 0; i + 1 < times.size(); ++i) {
      if (times[i] == times[i + 1]) continue;
      const double middle = 0.5 * (times[i] + times[i + 1]);
      const auto last = std::find_if(spans.rbegin(), spans.rend(), [&](const Span& span) {
        return span.begin < middle && middle < span.end;
      });
      if (last != spans.rend() && last->adds) return times[i];
    }
    return std::nullopt;
  }

 private:
  struct Span {
    double begin, end;
    bool adds;
  };

  static bool adds(const map::Solid& solid) { return map::is_material(solid.role); }
  double margin(const map::Solid& solid) const { return adds(solid) ? inflate_m_ : -inflate_m_; }

  /// Leaves of the span what is behind a plane that its ends are `a` and `b` away from.
  static void clip(Span& span, double a, double b) {
    if (a >= 0.0 && b >= 0.0) {
      span.end = -1.0;
    } else if (a > 0.0) {
      span.begin = std::max(span.begin, a / (a - b));
    } else if (b > 0.0) {
      span.end = std::min(span.end, a / (a - b));
    }
  }

  double inflate_m_;
  std::vector<const map::Solid*> solids_;
};

}  // namespace hallway::test
