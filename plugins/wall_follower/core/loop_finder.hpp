// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "wall_follower/core/chart.hpp"
#include "wall_follower/core/options.hpp"

namespace hallway::wall_follower {

/// A pair of nodes that are one landmark, seen in two laps.
struct SameLandmark {
  std::size_t first, again;  ///< indices into Chart::nodes, first < again
};

/// What the string of landmarks says of a loop.
struct LoopVerdict {
  Loop loop = Loop::open;
  std::vector<SameLandmark> same;  ///< of a closed loop, ascending
  double score = 0.0;              ///< of the best place
  double other = 0.0;              ///< of the next best one
};

/// Finds where the string of landmarks repeats itself: a local alignment (Smith and Waterman, 1981) of the landmarks seen last with earlier ones. A pair of landmarks that match by kind, direction and size adds to the score; their
/// differences, the difference of the ways since the pair before, and landmarks that are only in one of the laps take from it. Both of a pair are a whole turn apart, left or right: a wall that leads back to
/// its beginning turns by 360 degrees.
class LoopFinder {
 public:
  explicit LoopFinder(const Options& options) : options_(options) {}

  void clear() { rows_.clear(); }
  /// Takes the last node of the chart. O(nodes).
  LoopVerdict add(const Chart& chart);

 private:
  struct Cell {
    float score = 0.0F;  ///< of the best alignment that ends with this pair; 0: the pair does not match
    std::int8_t first_back = 0, again_back = 0;  ///< to the pair before; 0: there is none
    std::int16_t length = 0;                     ///< pairs
  };

  Cell cell_of(const std::vector<Node>& nodes, std::size_t first, std::size_t again) const;
  /// Whether the wall turns along the landmarks of an alignment: along a straight wall places may be alike that are none.
  bool turns_between(const std::vector<Node>& nodes, std::size_t first, std::size_t again) const;
  bool leads_back(const Node& first, const Node& again, double times) const;

  Options options_;
  std::vector<std::vector<Cell>> rows_;  ///< [again][first]
};

/// The first sight of the landmark of a node. @param same  pairs, ascending
std::size_t first_sight(const std::vector<SameLandmark>& same, std::size_t node);

/// One lap of a closed loop: landmarks that were seen twice are one, with their visits added, and an edge leads from the end of the lap to its beginning.
void close_loop(Chart& chart, const std::vector<SameLandmark>& same);

}  // namespace hallway::wall_follower
