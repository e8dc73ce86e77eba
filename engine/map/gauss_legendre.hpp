// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace hallway::map {

/// The integral of a function over [from, to] by Gauss-Legendre quadrature of eight points (Abramowitz and Stegun, table 25.4); exact for
/// polynomials up to degree 15.
/// @param zero  of the function's values
template <typename Value, typename Function>
Value gauss_legendre(const Function& function, double from, double to, const Value& zero) {
  struct Node {
    double at;  ///< on [-1, 1], and its mirror image
    double weight;
  };
  constexpr std::array<Node, 4> kNodes{
      Node{0.1834346424956498, 0.3626837833783620}, Node{0.5255324099163290, 0.3137066458778873},
      Node{0.7966664774136267, 0.2223810344533745}, Node{0.9602898564975363, 0.1012285362903763}};
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  Value sum = zero;
  for (const Node& node : kNodes) {
    sum += node.weight * (function(middle - half * node.at) + function(middle + half * node.at));
  }
  return sum * half;
}

}  // namespace hallway::map
