// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace hallway::bsp {

/// How the plane of a node is chosen among those of the faces in it.
enum class SplitRule {
  kBalanced,    ///< the least cost (see BuildOptions)
  kAxialFirst,  ///< the least cost among planes along the axes while there are any, then among the others
  kNaive,       ///< the plane of the first face: the reference of the benchmark
};

/// Parameters of the tree. The cost of a plane is
///   split_cost * (faces it cuts) + balance_cost * |faces in front - faces behind| - on_gain * (faces in it),
/// plus oblique_cost * (all faces) for a plane that is along no axis.
struct BuildOptions {
  SplitRule rule = SplitRule::kBalanced;
  double split_cost = 8.0;
  double balance_cost = 0.1;
  double on_gain = 2.0;
  double oblique_cost = 0.1;
  std::size_t candidates =
      64;  ///< planes tried at a node: half of them those with the largest faces, half from everywhere
};

}  // namespace hallway::bsp
