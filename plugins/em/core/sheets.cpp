// SPDX-License-Identifier: MIT
#include "em/core/sheets.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::em {
namespace {

constexpr double kFewestShare = 0.2;
// Variance within the halves by the whole: 0.36 of a normal distribution, 0.25 of an even one, 0.2 of two normal ones
// four standard deviations apart.
constexpr double kMostWithin = 0.2;

}  // namespace

std::optional<TwoSheets> two_sheets(std::vector<double> heights, std::size_t fewest) {
  const std::size_t n = heights.size();
  fewest =
      std::max({fewest, static_cast<std::size_t>(kFewestShare * static_cast<double>(n)), std::size_t{2}});
  if (n < 2 * fewest) return std::nullopt;
  std::sort(heights.begin(), heights.end());
  double sum = 0.0;
  double squares = 0.0;
  for (const double h : heights) {
    sum += h;
    squares += h * h;
  }
  const double total = squares - sum * sum / static_cast<double>(n);
  double below = 0.0;
  double most = 0.0;  // sum of squares between the two: the more of it, the less within
  TwoSheets best;
  for (std::size_t k = 1; k <= n - fewest; ++k) {
    below += heights[k - 1];
    if (k < fewest) continue;
    const double low = below / static_cast<double>(k);
    const double high = (sum - below) / static_cast<double>(n - k);
    const double share = static_cast<double>(k) * static_cast<double>(n - k) / static_cast<double>(n);
    const double between = share * (high - low) * (high - low);
    if (between <= most) continue;
    most = between;
    best = {low, high, std::sqrt(std::max(total - between, 0.0) / static_cast<double>(n))};
  }
  if (!(most > 0.0) || total - most > kMostWithin * total) return std::nullopt;
  return best;
}

}  // namespace hallway::em
