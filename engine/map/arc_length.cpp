// SPDX-License-Identifier: MIT
#include "map/arc_length.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "map/gauss_legendre.hpp"

namespace hallway::map {

ArcLength::ArcLength(std::function<double(double)> speed, double begin, double end, int cells)
    : speed_(std::move(speed)), begin_(begin), cell_((end - begin) / cells) {
  lengths_.push_back(0.0);
  for (int i = 0; i < cells; ++i) {
    lengths_.push_back(lengths_.back() + integral(begin_ + i * cell_, begin_ + (i + 1) * cell_));
  }
}

double ArcLength::integral(double from, double to) const {
  return gauss_legendre(speed_, from, to, 0.0);
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
