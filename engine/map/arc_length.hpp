// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

namespace hallway::map {

/// Length along a smooth curve as a function of its parameter, and the inverse. `speed` is the length per unit of the
/// parameter, positive on the whole of [begin, end].
///
/// Cumulative lengths at evenly spaced nodes, by Gauss-Legendre quadrature of eight points a cell; within a cell the inverse
/// is found by Newton's method on the same quadrature. Relative error below 1e-12 where `speed` is analytic and varies
/// slowly within a cell.
class ArcLength {
 public:
  ArcLength(std::function<double(double)> speed, double begin, double end, int cells);

  double total() const { return lengths_.back(); }
  /// The parameter at which `length` has been passed; clamped to [begin, end]. O(log cells).
  double parameter_at(double length) const;

 private:
  double integral(double from, double to) const;

  std::function<double(double)> speed_;
  double begin_;
  double cell_;
  std::vector<double> lengths_;  ///< at node i, from `begin`
};

}  // namespace hallway::map
