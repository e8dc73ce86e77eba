// SPDX-License-Identifier: MIT
#include "sense/random_walk.hpp"

#include <cmath>

#include "sense/dyadic_process.hpp"

namespace hallway::sense {

RandomWalk::RandomWalk(const Random& random, std::uint32_t step, double sigma, double interval_s)
    : random_(random), step_(step), scale_(sigma * std::sqrt(interval_s)) {}

double RandomWalk::value(std::uint64_t k) const {
  if (k == 0 || scale_ == 0.0) return 0.0;
  // In units of the standard deviation of one increment.
  return scale_ *
         dyadic_value(
             k, [this](std::uint64_t place) { return random_.normal(step_, place); },
             [](double z) { return z; },
             [](double at, std::uint64_t p, double z) { return at + std::sqrt(static_cast<double>(p)) * z; },
             [](double low, double high, std::uint64_t half, double z) {
               return 0.5 * (low + high) + std::sqrt(0.5 * static_cast<double>(half)) * z;
             });
}

}  // namespace hallway::sense
