// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "wall_follower/core/chart.hpp"
#include "wall_follower/core/options.hpp"

namespace hallway::wall_follower {

/// A pair of landmarks that are one, seen twice.
struct SameLandmark {
  std::size_t first;  ///< index in the wall that is followed, or in Circuit::lap
  std::size_t again;  ///< index in the wall that is followed
};

/// What the string of landmarks says of the wall that is followed.
struct LoopVerdict {
  Loop loop = Loop::open;
  std::optional<std::size_t>
      circuit;  ///< of a closed loop: the known wall that it is, as an index in Chart::circuits; empty: one of its own
  std::vector<SameLandmark> same;  ///< of a closed loop, in the order of the way
  double score = 0.0;              ///< of the best place
  double other = 0.0;              ///< the best one of another place, at any landmark of it
};

/// Finds where the string of landmarks repeats itself: a local alignment (Smith and Waterman, 1981) of the landmarks seen last with earlier ones, and with those of walls that are known. A pair of landmarks
/// that match by kind, direction and size adds to the score; their differences, the difference of the ways since the pair before, and landmarks that are only in one of the strings take from it. Both of a pair
/// are a whole turn apart, left or right: a wall that leads back to its beginning turns by 360 degrees. Those of a known wall are all turned by the same angle, which is 0 unless a turn was miscounted.
class LoopFinder {
 public:
  explicit LoopFinder(const Options& options) : options_(options) {}

  /// Begins a wall. The circuits of the chart are known walls.
  void begin(const Chart& chart);
  /// Takes the next landmark of the wall. O(landmarks).
  LoopVerdict add(const Node& node);
  /// Takes back the landmarks from one on.
  void forget(std::size_t from);
  /// The best alignment of landmarks of the wall with those of a known one: pairs in the order of the way; empty where there is none with `match_score`.
  std::vector<SameLandmark> best_with(std::size_t circuit) const;

 private:
  struct Cell {
    float score = 0.0F;  ///< of the best alignment that ends with this pair; 0: the pair does not match
    std::int8_t first_back = 0, again_back = 0;  ///< to the pair before; 0: there is none
    std::int16_t length = 0;                     ///< pairs
  };
  struct Alignment {
    std::vector<SameLandmark> same;  ///< in the order of the way
    double score = 0.0, other = 0.0;
    bool turns =
        false;  ///< whether the wall turns along it: along a straight wall places may be alike that are none
  };
  /// A landmark of a known wall, or of the one that is followed.
  struct Place {
    Node node;
    std::optional<std::size_t> circuit;
    std::size_t index = 0;  ///< in the lap, or in the wall
  };

  const Node& seen(std::size_t again) const { return places_[known_ + again].node; }
  Cell cell_of(std::size_t first, std::size_t again) const;
  bool may_be_one(const Place& first, const Node& again) const;
  /// The pairs of an alignment, by its last one.
  std::vector<SameLandmark> pairs_of(std::size_t first, std::size_t again) const;
  /// The best score that a landmark has with another place than one.
  double best_beside(std::size_t first, std::size_t again, bool is_strong) const;
  /// The last part of an alignment, in which no landmark fits much better elsewhere. Rooms that are alike and evenly spaced fit when shifted by one: where the better alignment has broken off, the shifted one may go on.
  Alignment trusted(std::size_t first, std::size_t again) const;
  static bool is_turned_alike(const Place& a, const Node& again_a, const Place& b, const Node& again_b);
  /// Whether the reckoned way does not speak against a pair. It counts less where the score is strong, and nothing then where a turn was miscounted on the way to a known wall.
  bool leads_back(const Place& first, const Node& again, bool is_strong) const;

  Options options_;
  std::vector<Place>
      places_;  // laps of known walls, each twice, so that an alignment may go on over its end; then the wall
  std::size_t known_ = 0;                // number of those of known walls
  std::vector<std::vector<Cell>> rows_;  // [again][index in places_]
};

}  // namespace hallway::wall_follower
