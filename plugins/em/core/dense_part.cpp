// SPDX-License-Identifier: MIT
#include "em/core/dense_part.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hallway::em {
namespace {

constexpr double kMostStrips = 255.0;  // from the start to either side
constexpr double kJudged = 4.0;        // fewer points than this may be missing by chance

/// One direction of the lattice: strips to both sides of the start. The outermost ones end at the plane's bounds; they are half a step wide at
/// least, lest the few points that noise carried beyond the edge be judged alone.
struct Strips {
  double start = 0.0;
  double half = 0.0;  ///< the bounds are -half and +half
  double step = 1.0;
  int before = 0;  ///< strips on the low side of the start
  int count = 1;

  Strips(double at, double half_length, double width)
      : start(std::clamp(at, -half_length, half_length)), half(half_length), step(width) {
    before = static_cast<int>(std::round((start + half) / step));
    count = std::max(before + static_cast<int>(std::round((half - start) / step)), 1);
  }
  int strip_of(double x) const {
    return std::clamp(static_cast<int>(std::floor((x - start) / step)) + before, 0, count - 1);
  }
  double border(int strip) const {
    if (strip <= 0) return -half;
    return strip >= count ? half : std::clamp(start + (strip - before) * step, -half, half);
  }
};

/// Members counted in the cells of two directions, so that the sum over a rectangle of cells takes four looks.
class Lattice {
 public:
  Lattice(const Strips& u, const Strips& v)
      : u_(u), v_(v), sums_(static_cast<std::size_t>((u.count + 1) * (v.count + 1)), 0) {}

  void add(const Vec2& p) { ++at(u_.strip_of(p.x()) + 1, v_.strip_of(p.y()) + 1); }
  void sum_up() {
    for (int i = 1; i <= u_.count; ++i) {
      for (int j = 1; j <= v_.count; ++j) at(i, j) += at(i - 1, j) + at(i, j - 1) - at(i - 1, j - 1);
    }
  }
  double points(int u0, int u1, int v0, int v1) { return at(u1, v1) - at(u0, v1) - at(u1, v0) + at(u0, v0); }
  double area(int u0, int u1, int v0, int v1) const {
    return (u_.border(u1) - u_.border(u0)) * (v_.border(v1) - v_.border(v0));
  }

 private:
  double& at(int i, int j) { return sums_[static_cast<std::size_t>(i * (v_.count + 1) + j)]; }

  Strips u_, v_;
  std::vector<double> sums_;
};

/// Strips [low, high) in each direction.
using Window = std::array<int, 4>;  // low u, high u, low v, high v

Window start_window(const Strips& u, const Strips& v) {
  return {std::max(u.before - 1, 0), std::min(u.before + 1, u.count), std::max(v.before - 1, 0),
          std::min(v.before + 1, v.count)};
}

// The strip beyond side `side` of the window.
Window strip_beyond(const Window& window, std::size_t side) {
  Window strip = window;
  if (side % 2 == 0) {
    strip[side + 1] = window[side];
    strip[side] = window[side] - 1;
  } else {
    strip[side - 1] = window[side];
    strip[side] = window[side] + 1;
  }
  return strip;
}

bool dense_enough(Lattice& lattice, const Window& window, const Window& strip, double least) {
  const double inside = density(lattice.points(window[0], window[1], window[2], window[3]),
                                lattice.area(window[0], window[1], window[2], window[3]));
  const double expected = inside * lattice.area(strip[0], strip[1], strip[2], strip[3]);
  return expected < kJudged || lattice.points(strip[0], strip[1], strip[2], strip[3]) >= least * expected;
}

Window widened(Lattice& lattice, Window window, const Window& border, double least) {
  std::array<bool, 4> closed{};
  while (std::count(closed.begin(), closed.end(), false) > 0) {
    for (std::size_t side = 0; side < 4; ++side) {
      if (closed[side]) continue;
      closed[side] = window[side] == border[side];
      if (closed[side]) continue;
      const Window strip = strip_beyond(window, side);
      if (dense_enough(lattice, window, strip, least)) {
        window[side] = strip[side];
      } else {
        closed[side] = true;
      }
    }
  }
  return window;
}

}  // namespace

void keep_dense_part(Candidate& plane, std::span<const Vec3> points, const Vec3& start,
                     const DensityCheck& check) {
  const Rectangle& bounds = plane.outline.rectangle;
  if (!(bounds.half_v > 0.0)) return;
  const auto along_sides = [&](const Vec3& p) {
    const Vec2 d = plane.outline.frame.flat(p) - bounds.centre;
    return Vec2(bounds.axis.dot(d), bounds.side().dot(d));
  };
  const double step = std::max(check.step, 2.0 * bounds.half_u / kMostStrips);
  const Vec2 from = along_sides(start);
  const Strips u(from.x(), bounds.half_u, step);
  const Strips v(from.y(), bounds.half_v, step);
  Lattice lattice(u, v);
  for (const std::uint32_t i : plane.members) lattice.add(along_sides(points[i]));
  lattice.sum_up();
  const Window window = widened(lattice, start_window(u, v), {0, u.count, 0, v.count}, check.least);
  std::erase_if(plane.members, [&](std::uint32_t i) {
    const Vec2 p = along_sides(points[i]);
    const int strip_u = u.strip_of(p.x());
    const int strip_v = v.strip_of(p.y());
    return strip_u < window[0] || strip_u >= window[1] || strip_v < window[2] || strip_v >= window[3];
  });
}

}  // namespace hallway::em
