// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "em/core/types.hpp"

namespace hallway::em {

/// Points that lie together in memory are handled together: loops over points run over whole blocks.
inline constexpr std::size_t kBlockSize = 32;

/// Points as one array per coordinate, in an order in which neighbours in the list are near in space. The
/// arrays are filled up with NaN to whole blocks, so that a loop over blocks needs no end of its own: NaN is
/// within nothing.
struct Points {
  std::vector<double> x, y, z;
  std::size_t count = 0;  ///< without the filling

  /// Point `i`.
  Vec3 at(std::size_t i) const { return {x[i], y[i], z[i]}; }
  /// Number of blocks, the last one filled up.
  std::size_t blocks() const { return (count + kBlockSize - 1) / kBlockSize; }

  /// Makes room for `n` points, all NaN.
  void resize(std::size_t n) {
    count = n;
    const std::size_t filled = blocks() * kBlockSize;
    for (std::vector<double>* axis : {&x, &y, &z}) {
      axis->assign(filled, std::numeric_limits<double>::quiet_NaN());
    }
  }
  /// Stores point `i`.
  void set(std::size_t i, const Vec3& p) {
    x[i] = p.x();
    y[i] = p.y();
    z[i] = p.z();
  }
};

}  // namespace hallway::em
