// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <unordered_set>

#include "log/landmark_id.hpp"

namespace hallway::eval {

/// Counts which true landmark's observations a plugin gave to which of its landmarks.
///
/// A map landmark is owned by the true landmark that most of its observations come from; of equal ones, by the one with the
/// lowest id. A map landmark that was given observations of no true landmark has no owner.
class AssociationScore {
 public:
  /// Adds a frame without identities: the associations alone.
  void add(std::span<const log::LandmarkId> associations);
  /// Adds a frame: by observation, what the plugin associated it with and what it is; both of the same length.
  void add(std::span<const log::LandmarkId> associations, std::span<const log::LandmarkId> identities);

  std::uint64_t observations() const { return observations_; }
  /// Unassociated observations: those that were associated with no landmark.
  std::uint64_t none() const { return none_; }
  /// Different true landmarks among the observations.
  std::size_t true_landmarks() const { return seen_.size(); }

  struct Pair {
    log::LandmarkId map;
    log::LandmarkId truth;
    auto operator<=>(const Pair&) const = default;
  };
  struct PairHash {
    std::size_t operator()(const Pair& pair) const;
  };
  using Votes = std::unordered_map<Pair, std::uint64_t, PairHash>;
  /// How many observations of which true landmark were given to which of the map.
  const Votes& votes() const { return votes_; }
  /// The different true landmarks among the observations.
  const std::unordered_set<log::LandmarkId>& seen() const { return seen_; }

  /// Owners by map landmark, and the observations given to a landmark that something else owns.
  struct Ownership {
    std::map<log::LandmarkId, log::LandmarkId> owner;  ///< map landmark -> true landmark
    std::uint64_t errors = 0;
  };
  /// O(pairs log pairs).
  Ownership ownership() const;

 private:
  std::uint64_t observations_ = 0;
  std::uint64_t none_ = 0;
  Votes votes_;
  std::unordered_set<log::LandmarkId> seen_;
};

}  // namespace hallway::eval
