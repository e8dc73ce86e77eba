// SPDX-License-Identifier: MIT
#include "em/core/sheets.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hallway::em {
namespace {

constexpr double kFewestShare = 0.2;
constexpr std::size_t kBins = 64;  // of the range of heights: a tenth of the noise
// Variance within the halves by the whole: 0.36 of a normal distribution, 0.25 of an even one, 0.19 of a sine's, 0.2 of two normal
// ones four standard deviations apart, 0.14 of five.
constexpr double kMostWithin = 0.2;

}  // namespace

std::optional<TwoSheets> two_sheets(const std::vector<double>& heights, std::size_t fewest) {
  const double n = static_cast<double>(heights.size());
  const double least = std::max({static_cast<double>(fewest), kFewestShare * n, 2.0});
  if (n < 2.0 * least) return std::nullopt;
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  if (!(*high > *low)) return std::nullopt;
  std::array<double, kBins> counts{};
  std::array<double, kBins> sums{};
  double sum = 0.0;
  double squares = 0.0;
  const double scale = kBins / (*high - *low);
  for (const double h : heights) {
    const auto bin = static_cast<std::size_t>(std::min((h - *low) * scale, kBins - 1.0));
    counts[bin] += 1.0;
    sums[bin] += h - *low;
    sum += h - *low;
    squares += (h - *low) * (h - *low);
  }
  const double total = squares - sum * sum / n;
  double most = 0.0;  // sum of squares between the two: the more of it, the less within
  TwoSheets best;
  double below = 0.0;
  double sum_below = 0.0;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    below += counts[bin];
    sum_below += sums[bin];
    if (below < least || n - below < least) continue;
    const double apart = (sum - sum_below) / (n - below) - sum_below / below;
    const double between = below * (n - below) / n * apart * apart;
    if (between <= most) continue;
    most = between;
    best = {*low + sum_below / below, *low + sum_below / below + apart,
            std::sqrt(std::max(total - between, 0.0) / n), (total - between) / total};
  }
  if (!(most > 0.0) || total - most > kMostWithin * total) return std::nullopt;
  return best;
}

}  // namespace hallway::em
