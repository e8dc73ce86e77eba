// SPDX-License-Identifier: MIT
#include "map/arc_length.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hallway::map {
namespace {

struct Node {
  double at;  ///< on [-1, 1], and its mirror image
  double weight;
};

/// Gauss-Legendre, eight points (Abramowitz and Stegun, table 25.4).
constexpr std::array<Node, 4> kNodes{
    Node{0.1834346424956498, 0.3626837833783620}, Node{0.5255324099163290, 0.3137066458778873},
    Node{0.7966664774136267, 0.2223810344533745}, Node{0.9602898564975363, 0.1012285362903763}};

}  // namespace

ArcLength::ArcLength(std::function<double(double)> speed, double begin, double end, int cells)
    : speed_(std::move(speed)), begin_(begin), cell_((end - begin) / cells) {
  lengths_.push_back(0.0);
  for (int i = 0; i < cells; ++i) {
    lengths_.push_back(lengths_.back() + integral(begin_ + i * cell_, begin_ + (i + 1) * cell_));
  }
}

double ArcLength::integral(double from, double to) const {
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  double sum = 0.0;
  for (const Node& node : kNodes) {
    sum += node.weight * (speed_(middle - half * node.at) + speed_(middle + half * node.at));
  }
  return sum * half;
}

double ArcLength::parameter_at(double length) const {
  if (length <= 0.0) return begin_;
  const auto cells = lengths_.size() - 1;
  const auto above = std::upper_bound(lengths_.begin(), lengths_.end(), length);
  const std::size_t cell = std::min(static_cast<std::size_t>(above - lengths_.begin()) - 1, cells - 1);
  const double from = begin_ + static_cast<double>(cell) * cell_;
  const double wanted = std::min(length, lengths_.back()) - lengths_[cell];
  double parameter = from + cell_ * wanted / (lengths_[cell + 1] - lengths_[cell]);
  constexpr int kSteps = 8;  // quadratic from a start that is right to a per cent; three are enough
  for (int i = 0; i < kSteps; ++i) {
    const double step = (wanted - integral(from, parameter)) / speed_(parameter);
    parameter = std::clamp(parameter + step, from, from + cell_);
    if (std::abs(step) <= 1e-15 * cell_) break;
  }
  return parameter;
}

}  // namespace hallway::map
