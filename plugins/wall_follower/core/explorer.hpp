// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "wall_follower/core/angles.hpp"
#include "wall_follower/core/options.hpp"
#include "wall_follower/core/senses.hpp"

namespace hallway::wall_follower {

/// A direction away from a wall, as a sweep at an opening in it saw it: to the left, ahead, or through the opening.
struct Exit {
  Vec2 from = Vec2::Zero();            ///< where the robot stood, by the reckoned way [m]
  int quarter = 0;                     ///< direction of the wall there, in turns of 90 degrees
  int turn = 0;                        ///< 1: to the left of the wall's direction; 0: along it
  double depth_m = 0.0;                ///< how far the space is free
  double way_m = 0.0;                  ///< along the wall, by odometry
  std::optional<std::uint32_t> node;   ///< id of the opening in the chart
  std::optional<std::size_t> circuit;  ///< of its wall, once that is closed
  bool is_tried = false;               ///< the robot went there, or could not
  int misses = 0;                      ///< how often the robot wanted to leave there, and did not

  Vec2 direction() const { return unit((quarter + turn) * kQuarter); }
};

/// Where a ray from an exit meets a wall that is known.
struct Landing {
  std::size_t circuit = 0;
  double station_m = 0.0;  ///< way along that wall since its lap's beginning
};

/// What the robot does next on a known wall: it leaves it at an exit.
struct Route {
  std::size_t exit = 0;  ///< index in Explorer::exits()
  std::optional<Landing>
      landing;          ///< on a known wall, on the way to a further exit; empty: what is there is not known
  double way_m = 0.0;   ///< along the wall to the exit
  double cost_m = 0.0;  ///< way to the exit that is aimed at, and across it
};

/// Which opening is next, after a loop.
enum class Exploration {
  none = 0,  ///< none: the robot stands
  right_hand =
      1,  ///< the next one along the wall on the right; where there is none on this wall, the one with the least cost
  cost = 2  ///< the one with the least way there and across
};

/// Remembers the outlines of walls and the exits from them, and says where to go on (thesis 2.2.4: "After closing the loop, the robot would then go to new area"). An exit is explained where its ray meets the outline of a
/// closed wall. An opening in the wall itself is an exit where that wall is one of a room: from it nothing but itself is seen. Else rooms are passed.
/// Frame: the reckoned way. Outlines have a point for each 0.2 m: O(way).
class Explorer {
 public:
  explicit Explorer(const Options& options) : options_(options) {}

  /// Begins a wall that is not known. What is of one that was not closed is forgotten.
  void begin();
  /// Forgets what was seen of the wall behind a way along it.
  void forget(double from_m);
  /// The wall is at that point.
  void see_wall(const Vec2& at, double way_m);
  /// A sweep at an opening. @param from  where the robot stands  @param slant  from the wall's direction to the robot's [rad]
  void see_exits(const Sweep& sweep, const Vec2& from, int quarter, double slant, double way_m,
                 bool is_hallway);
  /// The opening at which the last sweep was is a landmark of the chart, or none.
  void name_exits(std::optional<std::uint32_t> node);
  /// The lap from one way to another is a circuit. @param correction  is shared out over it  @param is_around  the wall is around the robot: it turns to the left
  void close(double from_m, double to_m, const Vec2& correction, bool is_around);
  void try_exit(std::size_t exit) { exits_[exit].is_tried = true; }
  /// The robot wanted to leave there, and did not. After the third time it does not try again.
  void miss_exit(std::size_t exit) { exits_[exit].is_tried = ++exits_[exit].misses >= kMostMisses; }

  /// The next exit from a place of a known wall; empty where none is left. O(exits^2 * outlines).
  std::optional<Route> next(std::size_t circuit, double station_m, Exploration rule) const;
  /// Where an exit meets a known wall; the nearest one.
  std::optional<Landing> landing(const Exit& exit) const;
  /// The way along a circuit from one station ahead to another one.
  double ahead_m(std::size_t circuit, double from_m, double to_m) const;
  /// Of an exit whose wall is closed.
  double station_m(const Exit& exit) const { return exit.way_m - outlines_[*exit.circuit].from_m; }

  std::span<const Exit> exits() const { return exits_; }
  /// Exits that are neither tried nor explained.
  std::size_t left() const;

 private:
  static constexpr int kMostMisses = 3;

  struct Point {
    Vec2 at;
    double way_m;
  };
  struct Outline {
    std::vector<Point> points;
    double from_m = 0.0, length_m = 0.0;
    bool is_around = false;
  };

  bool is_room(std::size_t circuit) const;
  /// Whether what is behind an exit is to be explored, if its ray meets no wall that is known.
  bool is_aim(const Exit& exit) const;

  Options options_;
  std::vector<Outline> outlines_;  // by circuit
  std::vector<Point> wall_;        // that is followed
  std::vector<Exit> exits_;
};

}  // namespace hallway::wall_follower
