// SPDX-License-Identifier: MIT
#include "drive/disturbance.hpp"

#include <cmath>

#include "drive/motion.hpp"

namespace hallway::drive {
namespace {

double correlation_of_knots(const Disturbance& disturbance) {
  if (disturbance.correlation_ns == 0) return 0.0;
  return std::exp(-static_cast<double>(kKnotNs) / static_cast<double>(disturbance.correlation_ns));
}

}  // namespace

DisturbanceProcess::DisturbanceProcess(const Disturbance& disturbance, std::uint64_t seed,
                                       std::string_view stream)
    : disturbance_(disturbance),
      random_(seed, stream_id(stream)),
      keep_(correlation_of_knots(disturbance)),
      fresh_(std::sqrt((1.0 - keep_) * (1.0 + keep_))) {
  if (!is_constant()) begin();
}

void DisturbanceProcess::begin() {
  knot_ = 0;
  value_ = random_.normal(0, 0);  // stationary from the first knot on
  next_ = keep_ * value_ + fresh_ * random_.normal(0, 1);
}

void DisturbanceProcess::next_knot() {
  ++knot_;
  value_ = next_;
  next_ = keep_ * value_ + fresh_ * random_.normal(0, static_cast<std::uint64_t>(knot_) + 1);
}

double DisturbanceProcess::at(std::int64_t t_ns) {
  if (is_constant()) return disturbance_.mean;
  // A time on a knot belongs to the interval that ends there: a motion is planned to the next knot, and may be planned anew before it.
  const std::int64_t wanted = t_ns == 0 ? 0 : (t_ns - 1) / kKnotNs;
  if (wanted < knot_) begin();
  while (knot_ < wanted) next_knot();
  return disturbance_.mean + disturbance_.sigma * between(value_, next_, t_ns - wanted * kKnotNs, kKnotNs);
}

}  // namespace hallway::drive
