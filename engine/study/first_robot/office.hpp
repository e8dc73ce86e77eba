// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::study {

// Offices as the first robot of the thesis maps (2.2.1, figure 1; 2.2.5), made by a seed: a block of cubicles, a hallway round it, and cubicles on the other
// side of the hallway. Lengths are metres, whole centimetres; x points east, y north; the block's south-western corner is the origin.

/// An upright rectangle on the floor.
struct Rectangle {
  Vec2 low = Vec2::Zero();
  Vec2 high = Vec2::Zero();

  Vec2 size() const { return high - low; }
  bool contains(const Vec2& point) const {
    return (point.array() >= low.array()).all() && (point.array() <= high.array()).all();
  }
  bool overlaps(const Rectangle& other) const {
    return (low.array() < other.high.array()).all() && (other.low.array() < high.array()).all();
  }
};

/// A stretch of a line, by the distances of its ends from where the line begins.
struct Stretch {
  double from_m = 0.0;
  double to_m = 0.0;

  double length_m() const { return to_m - from_m; }
};

/// What is behind a stretch of a hallway's side: one wall, perhaps with a doorway to a room, or a hallway that ends.
struct Section {
  Stretch extent{};
  /// How far its wall is behind the side of the hallway: walls of neighbours stagger.
  double set_back_m = 0.0;
  std::optional<Rectangle> room{};
  std::optional<Stretch> doorway{};         ///< to the room
  std::optional<Rectangle> side_hallway{};  ///< from the side of the hallway to its end
  /// A black filing cabinet that is a part of the wall, in front of which it stands by kCabinetProud_m.
  std::optional<Stretch> cabinet{};
  std::optional<Rectangle> cabinet_in_room{};
};

/// A side of the hallway, of which the walls are behind.
struct HallwaySide {
  Vec2 begin = Vec2::Zero();
  Vec2 along = Vec2::UnitX();   ///< unit, to the east or to the north
  Vec2 behind = Vec2::UnitY();  ///< unit, away from the hallway
  double length_m = 0.0;
  std::vector<Section> sections{};  ///< without gaps, from begin on

  /// The rectangle over a stretch, from one distance behind the side to another; negative: in the hallway.
  Rectangle rectangle(const Stretch& stretch, double from_behind_m, double to_behind_m) const;
};

/// The four sides, as places in arrays.
enum Compass : std::size_t { kSouth, kNorth, kWest, kEast };

struct Office {
  std::uint64_t seed = 0;
  Vec2 block_m = Vec2::Zero();        ///< size of the block
  std::array<double, 4> hallway_m{};  ///< width of the hallway on each side of the block, by Compass
  std::array<HallwaySide, 4>
      block{};  ///< the sides of the block, which a robot that goes round has on its right
  std::array<HallwaySide, 4> outside{};  ///< the other sides of the hallway
  Vec2 start_m = Vec2::Zero();           ///< in the hallway south of the block; the robot looks west

  /// The way round the block, by its four sides.
  double loop_m() const { return 2.0 * (block_m.x() + block_m.y()); }
  /// The hallway round the block, without what walls are set back: four rectangles, by Compass.
  std::array<Rectangle, 4> hallways() const;
};

inline constexpr double kShortestLoop_m = 15.0;
inline constexpr double kLongestLoop_m = 40.0;
inline constexpr double kNarrowestHallway_m = 1.2;
inline constexpr double kNarrowestDoorway_m = 0.8;
inline constexpr double kWidestDoorway_m = 1.0;
inline constexpr double kMostSetBack_m = 0.3;
inline constexpr double kWall_m = 0.1;  ///< the thinnest wall between a hallway and a room
inline constexpr double kCabinetProud_m = 0.02;

/// An office; the same seed gives the same one. The way round the block is 15 to 40 m long. All hallways are at least 1.2 m wide, doorways 0.8 to 1 m; walls
/// are set back by up to 0.3 m. The block has a doorway or more, and so has the outside. In half of the offices about half of the cubicles are alike; the
/// block is never the same to a robot that stands on its other side, though.
Office plan_office(std::uint64_t seed);

}  // namespace hallway::study
