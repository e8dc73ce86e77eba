// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "em/core/raw_vector.hpp"
#include "em/core/types.hpp"

namespace hallway::em {

/// Points that lie together in memory are handled together: loops over points run over whole blocks.
inline constexpr std::size_t kBlockSize = 32;

/// Points as one array per coordinate, in an order in which neighbours in the list are near in space. The
/// arrays are filled up with NaN to whole blocks, so that a loop over blocks needs no end of its own: NaN is
/// within nothing.
struct Points {
  RawVector<double> x, y, z;
  std::size_t count = 0;  ///< without the filling

  /// Point `i`.
  Vec3 at(std::size_t i) const { return {x[i], y[i], z[i]}; }
  /// Number of blocks, the last one filled up.
  std::size_t blocks() const { return (count + kBlockSize - 1) / kBlockSize; }

  /// Makes room for `n` points, which are to be set, and fills it up to whole blocks.
  void resize(std::size_t n) {
    count = n;
    for (RawVector<double>* axis : {&x, &y, &z}) {
      axis->resize(blocks() * kBlockSize);
      std::fill(axis->begin() + static_cast<std::ptrdiff_t>(n), axis->end(),
                std::numeric_limits<double>::quiet_NaN());
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
