// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace hallway::sense {

/// How well a scanner measures the distance to what its beam meets. With d the true distance [m] and t the angle between the beam and the
/// surface's normal:
///
/// - noise: normal, sigma^2 = noise_m^2 + (noise_per_m d)^2 + (noise_incidence d tan t)^2; the tangent is cut at 57.3 (one degree from the
///   surface). The last term is the smear of a beam's spot on a slanted surface: noise_incidence is an angle [rad], about half of the beam's
///   divergence.
/// - no answer: with probability 1 - (1 - dropout) (1 - dropout_at_max (d / max_range)^2) (1 - dropout_incidence (1 - cos t)^2) (1 - m), m the material's.
/// - intensity: reflectivity cos t (a surface that scatters by Lambert's law, and a device that corrects for distance), times 1 + intensity_noise z,
///   z standard normal; not below 0.
struct BeamResponse {
  double noise_m = 0.0;
  double noise_per_m = 0.0;
  double noise_incidence = 0.0;
  double dropout = 0.0;            ///< [0, 1]
  double dropout_at_max = 0.0;     ///< [0, 1]
  double dropout_incidence = 0.0;  ///< [0, 1]
  double intensity_noise = 0.0;

  bool is_ideal() const { return *this == BeamResponse{}; }
  /// Standard deviation of the measured distance [m].
  double sigma_m(double distance_m, double cosine) const;
  /// Share of beams that get no answer.
  double dropout_share(double distance_m, double max_range_m, double cosine, double material_dropout) const;

  bool operator==(const BeamResponse&) const = default;
};

/// Three independent numbers from 128 random bits: one uniform in [0, 1), two standard normal.
struct BeamDraws {
  explicit BeamDraws(const std::array<std::uint32_t, 4>& bits);

  double uniform;
  double range;      ///< from 52 bits: |z| < 8.3
  double intensity;  ///< from 32 bits: |z| < 6.4
};

}  // namespace hallway::sense
