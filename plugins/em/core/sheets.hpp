// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace hallway::em {

/// Two sheets that were taken for one thick plane.
struct TwoSheets {
  double low = 0.0;     ///< mean height of the lower one ...
  double high = 0.0;    ///< ... and of the higher one
  double noise = 0.0;   ///< standard deviation of the heights within them
  double within = 0.0;  ///< variance within them by that of all heights
};

/// Whether the heights of points over a plane are those of two sheets at least four times their noise apart, of
/// `fewest` points and a fifth of all each: the split of least variance within (Otsu 1979) leaves less than one
/// normal distribution, or an even one, would. O(n).
std::optional<TwoSheets> two_sheets(const std::vector<double>& heights, std::size_t fewest);

}  // namespace hallway::em
