// SPDX-License-Identifier: MIT
#include "sense/beam_response.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"

namespace hallway::sense {

double BeamResponse::sigma_m(double distance_m, double cosine) const {
  double variance = noise_m * noise_m + noise_per_m * noise_per_m * distance_m * distance_m;
  if (noise_incidence > 0.0) {
    constexpr double kMostTangent = 57.3;
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    const double tangent = sine < kMostTangent * cosine ? sine / cosine : kMostTangent;
    const double smear = noise_incidence * distance_m * tangent;
    variance += smear * smear;
  }
  return std::sqrt(variance);
}

double BeamResponse::dropout_share(double distance_m, double max_range_m, double cosine,
                                   double material_dropout) const {
  const double far = distance_m / max_range_m;
  const double slant = 1.0 - cosine;
  return 1.0 - (1.0 - dropout) * (1.0 - dropout_at_max * far * far) *
                   (1.0 - dropout_incidence * slant * slant) * (1.0 - material_dropout);
}

// The middle of one of 2^52 and of one of 2^32 cells: never 0 or 1.
BeamDraws::BeamDraws(const std::array<std::uint32_t, 4>& bits)
    : uniform(0x1.0p-32 * bits[0]),
      range(inverse_normal_cdf(
          static_cast<double>((std::uint64_t{bits[1]} << 20) | (bits[2] >> 12)) * 0x1.0p-52 + 0x1.0p-53)),
      intensity(inverse_normal_cdf(bits[3] * 0x1.0p-32 + 0x1.0p-33)) {}

}  // namespace hallway::sense
