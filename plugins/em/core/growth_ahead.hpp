// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "em/core/evidence.hpp"
#include "em/core/growth.hpp"
#include "em/core/sheets.hpp"
#include "em/core/workers.hpp"

namespace hallway::em {

/// Seeds that are tried one after the other: which, and what each is.
struct Trial {
  std::size_t count = 0;
  std::size_t most = 0;                            ///< no more than so many are tried
  std::function<bool(std::size_t)> skip;           ///< whether one is passed over; once true it stays so
  std::function<const Seed&(std::size_t)> likely;  ///< what one looks like before it is made
  std::function<std::optional<Seed>(std::size_t)> seed;  ///< makes one; called from any thread
};

/// What grew from a seed, and what it is judged by that does not depend on what is claimed later.
struct Attempt {
  std::size_t number = 0;    ///< of the seed in its trial
  std::optional<Seed> seed;  ///< nothing: there is none, and nothing grew
  Grown grown;
  std::optional<TwoSheets> sheets;  ///< that the members lie on
  Surroundings beside;              ///< where they do not
};

/// How seeds are grown.
struct Growth {
  double sigma = 0.0;          ///< noise across planes
  bool flat = false;           ///< bent surfaces are taken up to where they are flat
  std::size_t min_points = 0;  ///< what has fewer members is not looked at any closer
};

/// Grows the seeds of a trial several at a time, as if none of them were accepted. Where one relied on points that one
/// before it was then given, it is grown anew: what comes out is the same as one after the other.
class GrowthAhead {
 public:
  /// Keeps references to all but `growth`.
  GrowthAhead(const PointField& field, const std::vector<std::uint8_t>& claimed, const Trial& trial,
              const Growth& growth, Workers& workers)
      : field_(field), claimed_(claimed), trial_(trial), growth_(growth), workers_(workers) {}

  /// What grows from seed `number` with the points that are unclaimed now. Numbers ascend from call to call; `left`: how
  /// many calls may come, this one included.
  Attempt take(std::size_t number, std::size_t left);

 private:
  void grow_from(std::size_t number, std::size_t left);
  bool stale(const Attempt& attempt) const;
  bool may_be_one(std::size_t number, const std::vector<std::size_t>& others) const;
  void grow(Attempt& attempt) const;

  const PointField& field_;
  const std::vector<std::uint8_t>& claimed_;
  const Trial& trial_;
  const Growth growth_;
  Workers& workers_;
  std::vector<Attempt> ahead_;  ///< by number
};

}  // namespace hallway::em
