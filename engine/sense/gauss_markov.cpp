// SPDX-License-Identifier: MIT
#include "sense/gauss_markov.hpp"

#include <cmath>
#include <limits>

#include "sense/dyadic_process.hpp"

namespace hallway::sense {
namespace {

constexpr std::uint64_t kStart =
    std::numeric_limits<std::uint64_t>::max();  ///< key of x_0, which no place has

/// sqrt(1 - r^2), also where r is nearly 1.
double rest(double r) {
  return std::sqrt((1.0 - r) * (1.0 + r));
}

}  // namespace

double GaussMarkov::correlation(std::uint64_t apart) const {
  const double way_s = static_cast<double>(apart) * interval_s_;
  if (way_s == 0.0) return 1.0;
  return tau_s_ > 0.0 ? std::exp(-way_s / tau_s_) : 0.0;
}

double GaussMarkov::value(std::uint64_t k) const {
  if (sigma_ == 0.0) return 0.0;
  const double start = random_.normal(step_, kStart);
  if (k == 0 || interval_s_ == 0.0) return sigma_ * start;
  const auto on = [this](double at, std::uint64_t by, double z) {
    const double r = correlation(by);
    return r * at + rest(r) * z;
  };
  return sigma_ * dyadic_value(
                      k, [this](std::uint64_t place) { return random_.normal(step_, place); },
                      [&](double z) { return on(start, 1, z); }, on,
                      [this](double low, double high, std::uint64_t half, double z) {
                        const double r = correlation(half);
                        return r / (1.0 + r * r) * (low + high) + rest(r) / std::sqrt(1.0 + r * r) * z;
                      });
}

}  // namespace hallway::sense
