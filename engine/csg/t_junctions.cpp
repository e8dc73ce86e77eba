// SPDX-License-Identifier: MIT
#include "csg/t_junctions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geom/box.hpp"

namespace hallway::csg {
namespace {

/// Points in the cells of an even grid.
class PointGrid {
 public:
  PointGrid(const std::vector<Vec3>& points, double distance) : points_(points), distance_(distance) {
    for (const Vec3& point : points) bounds_.extend(point);
    if (points.empty()) return;
    constexpr double kPointsPerCell = 4.0;
    constexpr double kMostCells = 4e6;
    const Vec3 size = (bounds_.sizes().array() + 4.0 * distance).matrix();
    const double wanted = std::clamp(static_cast<double>(points.size()) / kPointsPerCell, 1.0, kMostCells);
    cell_ = std::max(std::cbrt(size.prod() / wanted), size.maxCoeff() / 512.0);
    for (std::size_t k = 0; k < 3; ++k) {
      count_[k] = static_cast<std::size_t>(size[static_cast<Eigen::Index>(k)] / cell_) + 1;
    }
    begin_.assign(count_[0] * count_[1] * count_[2] + 1, 0);
    for (const Vec3& point : points) ++begin_[cell_of(point) + 1];
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    order_.resize(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) order_[next[cell_of(points[i])]++] = i;
  }

  /// Appends the points within the distance of the inside of an edge, as (place along the edge, point).
  void near_edge(std::uint32_t from, std::uint32_t to,
                 std::vector<std::pair<double, std::uint32_t>>& found) const {
    const Vec3& a = points_[from];
    const Vec3 along = points_[to] - a;
    const double length = along.norm();
    const Vec3 direction = along / length;
    const auto steps = static_cast<std::size_t>(length / cell_) + 1;
    for (std::size_t s = 0; s < steps; ++s) {
      const double begin = length * static_cast<double>(s) / static_cast<double>(steps);
      const double end = length * static_cast<double>(s + 1) / static_cast<double>(steps);
      Box box(a + begin * direction);
      box.extend(a + end * direction);
      visit(box, [&](std::uint32_t index) {
        if (index == from || index == to) return;
        const Vec3 offset = points_[index] - a;
        const double place = offset.dot(direction);
        const bool last = s + 1 == steps;
        if (place < begin || (last ? place > end : place >= end) || place <= 0.0 || place >= length) return;
        if ((offset - place * direction).squaredNorm() <= distance_ * distance_)
          found.emplace_back(place, index);
      });
    }
    std::sort(found.begin(), found.end());
  }

 private:
  std::size_t along_axis(double value, std::size_t axis) const {
    const auto k = static_cast<Eigen::Index>(axis);
    const double cell = std::floor((value - bounds_.min()[k]) / cell_);
    return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(count_[axis] - 1)));
  }
  std::size_t cell_of(const Vec3& point) const {
    return (along_axis(point.z(), 2) * count_[1] + along_axis(point.y(), 1)) * count_[0] +
           along_axis(point.x(), 0);
  }
  template <typename Visit>
  void visit(const Box& box, const Visit& see) const {
    for (std::size_t z = along_axis(box.min().z() - distance_, 2);
         z <= along_axis(box.max().z() + distance_, 2); ++z) {
      for (std::size_t y = along_axis(box.min().y() - distance_, 1);
           y <= along_axis(box.max().y() + distance_, 1); ++y) {
        for (std::size_t x = along_axis(box.min().x() - distance_, 0);
             x <= along_axis(box.max().x() + distance_, 0); ++x) {
          const std::size_t cell = (z * count_[1] + y) * count_[0] + x;
          for (std::uint32_t i = begin_[cell]; i < begin_[cell + 1]; ++i) see(order_[i]);
        }
      }
    }
  }

  const std::vector<Vec3>& points_;
  double distance_;
  Box bounds_;
  double cell_ = 1.0;
  std::array<std::size_t, 3> count_{1, 1, 1};
  std::vector<std::uint32_t> begin_;
  std::vector<std::uint32_t> order_;
};

/// Removes repeated vertices and edges that run there and back.
void remove_spikes(std::vector<std::uint32_t>& loop) {
  std::vector<std::uint32_t> out;
  for (const std::uint32_t vertex : loop) {
    if (!out.empty() && out.back() == vertex) continue;
    if (out.size() >= 2 && out[out.size() - 2] == vertex) {
      out.pop_back();
    } else {
      out.push_back(vertex);
    }
  }
  std::size_t first = 0;
  while (out.size() - first >= 2) {  // the same across the loop's end
    if (out[first] == out.back()) {
      out.pop_back();
    } else if (out.size() - first >= 3 && out[first + 1] == out.back()) {
      ++first;
    } else if (out.size() - first >= 3 && out[first] == out[out.size() - 2]) {
      out.pop_back();
    } else {
      break;
    }
  }
  out.erase(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(first));
  if (out.size() < 3) out.clear();
  loop = std::move(out);
}

}  // namespace

void resolve_t_junctions(const std::vector<Vec3>& points, double distance,
                         std::vector<std::vector<std::uint32_t>>& loops) {
  const PointGrid grid(points, distance);
  std::vector<std::uint32_t> fixed;
  std::vector<std::pair<double, std::uint32_t>> between;
  for (std::vector<std::uint32_t>& loop : loops) {
    fixed.clear();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t from = loop[i];
      const std::uint32_t to = loop[(i + 1) % loop.size()];
      if (from == to) continue;
      fixed.push_back(from);
      between.clear();
      grid.near_edge(from, to, between);
      for (const auto& [place, index] : between) fixed.push_back(index);
    }
    loop = fixed;
    remove_spikes(loop);
  }
}

}  // namespace hallway::csg
