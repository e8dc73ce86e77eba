// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "em/core/auto_options.hpp"
#include "em/core/growth_ahead.hpp"
#include "em/core/local_search.hpp"
#include "em/core/slab_points.hpp"
#include "em/core/workers.hpp"

namespace hallway::em {

/// Looks for planes among the points that none has claimed yet.
class PlaneSearch {
 public:
  /// `extent`: of the space that the cloud fills. Keeps references to all but that.
  PlaneSearch(const PointField& field, const AutoOptions& options, const Vec3& extent, Workers& workers);

  /// The noise across planes, as the flattest neighbourhoods tell, at least a millionth of the extent; 0 if
  /// there is no neighbourhood that a plane could lie in.
  double estimate_noise() const;

  /// The noise of surfaces rougher than `sigma` among the points without a label; 0 if there seem to be none.
  double rougher_noise(double sigma, const std::vector<std::uint32_t>& labels) const;

  /// The next search tries these seeds before its own.
  void begin_with(std::vector<Seed> seeds) { warm_seeds_ = std::move(seeds); }

  /// Rounds of seeds, growth and acceptance, until `fruitless` in a row find nothing. `sigma`: noise.
  /// `claimed` (of each point, filled up to whole blocks) is read and added to.
  std::vector<Grown> find(double sigma, int fruitless, std::vector<std::uint8_t>& claimed);

  /// From now on bent surfaces give facets.
  void take_facets() { facets_ = true; }

 private:
  std::vector<Grown> try_warm_seeds(double sigma, std::vector<std::uint8_t>& claimed);
  void begin_round(std::vector<std::uint8_t>& claimed);
  std::vector<Grown> round(double sigma, std::size_t number, std::vector<std::uint8_t>& claimed);
  void try_all(const Trial& trial, double sigma, std::vector<std::uint8_t>& claimed);
  void consider(Attempt&& attempt, double sigma, std::vector<std::uint8_t>& claimed);
  void judge(Grown&& grown, const Surroundings& beside, double sigma, std::vector<std::uint8_t>& claimed);
  void accept(Grown&& grown, std::vector<std::uint8_t>& claimed);
  void accept_pending(std::vector<std::uint8_t>& claimed);
  std::vector<Grown> accept_doubtful(double sigma, std::vector<std::uint8_t>& claimed);

  /// A plane that is none by the strict standard but by the lenient one.
  struct Pending {
    Grown grown;
    double noise_ratio = 0.0;
  };

  const PointField& field_;
  const AutoOptions& options_;
  Vec3 extent_;
  Workers& workers_;
  std::size_t unclaimed_ = 0;
  bool facets_ = false;
  std::vector<Seed> first_seeds_;       ///< of all points: for the noise and for the first round
  std::vector<Seed> warm_seeds_;        ///< to be tried before the first round
  std::vector<Grown> found_;            ///< in this round
  std::vector<Pending> pending_;        ///< in this round
  std::vector<Grown> doubtful_;         ///< what may be one plane, where neither of its two sheets was found
  std::vector<std::uint8_t> failures_;  ///< of each point: growths in this round that held it and failed
};

}  // namespace hallway::em
