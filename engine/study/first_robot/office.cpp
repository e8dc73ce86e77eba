// SPDX-License-Identifier: MIT
#include "study/first_robot/office.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"

namespace hallway::study {
namespace {

constexpr double kSideWall_m = 0.06;  // half of the wall between two cubicles
constexpr double kCorner_m =
    kMostSetBack_m + kWall_m;       // what walls at a corner of the block take of its cubicles
constexpr double kTwoRows_m = 4.0;  // from here on the block has two rows of cubicles, back to back
constexpr double kJamb_m = 0.15;    // between a doorway and the side of its room
constexpr double kLeastBlock_m = 2.6;
constexpr double kStartFromBlock_m = 0.45;

double to_centimetres(double length_m) {
  return std::round(100.0 * length_m) / 100.0;
}

/// Numbers of one office, each drawn once.
class Dice {
 public:
  Dice(std::uint64_t seed, std::uint32_t attempt)
      : random_(seed, stream_id("first_robot.office")), attempt_(attempt) {}

  double within(double low, double high) { return random_.uniform(attempt_, next_++, low, high); }
  double length(double low_m, double high_m) { return to_centimetres(within(low_m, high_m)); }
  bool chance(double probability) { return random_.uniform(attempt_, next_++) < probability; }

 private:
  Random random_;
  std::uint32_t attempt_;
  std::uint64_t next_ = 0;
};

/// How a cubicle looks from the hallway.
struct Front {
  double set_back_m = 0.0;
  double doorway_m = 0.0;
  double doorway_share = 0.0;  // where the doorway is, of the places that it can have
};

class Planner {
 public:
  Planner(std::uint64_t seed, std::uint32_t attempt) : dice_(seed, attempt) { office_.seed = seed; }

  Office plan() {
    plan_size();
    usual_ = front();
    alike_ = dice_.chance(0.5);
    lay_sides();
    if (office_.block_m.y() >= kTwoRows_m) {
      plan_two_rows();
    } else {
      plan_one_row();
    }
    for (HallwaySide& side : office_.outside) plan_outside(side);
    office_.start_m = {to_centimetres(dice_.within(0.3, 0.7) * office_.block_m.x()), -kStartFromBlock_m};
    return std::move(office_);
  }

 private:
  void plan_size() {
    const double half_m = 0.5 * dice_.within(kShortestLoop_m, kLongestLoop_m);
    const double depth_m = std::max(kLeastBlock_m, to_centimetres(half_m * dice_.within(0.3, 0.45)));
    office_.block_m = {to_centimetres(half_m - depth_m), depth_m};
    for (double& width : office_.hallway_m)
      width = dice_.length(kNarrowestHallway_m + 2.0 * kCabinetProud_m, 1.9);
  }

  void lay_sides() {
    const auto [length, depth] = std::pair(office_.block_m.x(), office_.block_m.y());
    const auto& [south, north, west, east] = office_.hallway_m;
    const Vec2 x = Vec2::UnitX(), y = Vec2::UnitY();
    office_.block = {HallwaySide{{0, 0}, x, y, length}, HallwaySide{{0, depth}, x, -y, length},
                     HallwaySide{{0, 0}, y, x, depth}, HallwaySide{{length, 0}, y, -x, depth}};
    const double over_x = length + west + east, over_y = depth + south + north;
    office_.outside = {
        HallwaySide{{-west, -south}, x, -y, over_x}, HallwaySide{{-west, depth + north}, x, y, over_x},
        HallwaySide{{-west, -south}, y, -x, over_y}, HallwaySide{{length + east, -south}, y, x, over_y}};
  }

  Front front() {
    return {.set_back_m = dice_.length(0.0, kMostSetBack_m),
            .doorway_m = dice_.length(kNarrowestDoorway_m, kWidestDoorway_m),
            .doorway_share = dice_.within(0.0, 1.0)};
  }

  Front next_front() {
    const Front other = front();
    return alike_ && dice_.chance(0.5) ? usual_ : other;
  }

  std::vector<Section> divide(double length_m, double usual_m) {
    const auto count = static_cast<std::size_t>(std::max(1.0, std::round(length_m / usual_m)));
    std::vector<double> ends(count);
    double sum = 0.0;
    for (double& end : ends) end = sum += alike_ ? 1.0 : dice_.within(0.75, 1.25);
    std::vector<Section> sections(count);
    double from = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double to = i + 1 == count ? length_m : to_centimetres(length_m * ends[i] / sum);
      sections[i].extent = {from, to};
      from = to;
    }
    return sections;
  }

  /// A doorway to a room that reaches over `room` along the side; none where it is too narrow.
  static std::optional<Stretch> doorway(const Front& front, const Stretch& room) {
    const double free_m = room.length_m() - 2.0 * kJamb_m - front.doorway_m;
    if (free_m < 0.0) return std::nullopt;
    const double from = to_centimetres(room.from_m + kJamb_m + front.doorway_share * free_m);
    return Stretch{from, to_centimetres(from + front.doorway_m)};
  }

  /// Gives a section a room behind its wall and a doorway to it, where a doorway has place.
  void open(const HallwaySide& side, Section& section, const Front& front, const Stretch& room,
            double depth_m) {
    section.doorway = doorway(front, room);
    if (!section.doorway) return;
    const double front_m = section.set_back_m + kWall_m;
    section.room = side.rectangle(room, front_m, depth_m);
    if (dice_.chance(0.3))
      section.cabinet_in_room =
          side.rectangle({room.to_m - 0.55, room.to_m - 0.05}, depth_m - 0.45, depth_m - 0.05);
  }

  void put_cabinet(Section& section, double margin_m) {
    const double width_m = dice_.length(0.45, 0.8);
    const bool wanted = dice_.chance(0.25);
    const double free_m = section.extent.length_m() - 2.0 * margin_m - width_m;
    const double from = to_centimetres(section.extent.from_m + margin_m + dice_.within(0.0, 1.0) * free_m);
    if (wanted && free_m >= 0.0) section.cabinet = Stretch{from, to_centimetres(from + width_m)};
  }

  /// What a section of the block has for a room, of a side of this length.
  static Stretch inside(const Section& section, double length_m) {
    const bool first = section.extent.from_m == 0.0, last = section.extent.to_m == length_m;
    return {to_centimetres(section.extent.from_m + (first ? kCorner_m : kSideWall_m)),
            to_centimetres(section.extent.to_m - (last ? kCorner_m : kSideWall_m))};
  }

  /// A blank wall across an end of the block, in two parts.
  void plan_end(HallwaySide& side) {
    side.sections = {Section{.extent = {0.0, to_centimetres(0.5 * side.length_m)}},
                     Section{.extent = {to_centimetres(0.5 * side.length_m), side.length_m}}};
    for (Section& section : side.sections) section.set_back_m = next_front().set_back_m;
  }

  void plan_row(HallwaySide& side, double depth_m) {
    side.sections = divide(side.length_m, dice_.within(2.1, 2.9));
    for (Section& section : side.sections) {
      const Front front = next_front();
      section.set_back_m = front.set_back_m;
      if (dice_.chance(0.75)) {
        open(side, section, front, inside(section, side.length_m), depth_m);
      } else {
        put_cabinet(section, kCorner_m);
      }
    }
  }

  /// Some cubicles at the corners of the block are entered from its end.
  void turn_corner_rooms(HallwaySide& row, std::size_t half) {
    for (const bool east : {false, true}) {
      Section& corner = east ? row.sections.back() : row.sections.front();
      HallwaySide& end = office_.block[east ? kEast : kWest];
      const Front front = next_front();
      if (!dice_.chance(0.3) || !corner.room) continue;
      const Stretch room{corner.room->low.y(), corner.room->high.y()};
      end.sections[half].doorway = doorway(front, room);
      if (!end.sections[half].doorway) continue;
      end.sections[half].room = corner.room;
      corner.room.reset();
      corner.doorway.reset();
      corner.cabinet_in_room.reset();
    }
  }

  void plan_two_rows() {
    plan_end(office_.block[kWest]);
    plan_end(office_.block[kEast]);
    const double depth_m = to_centimetres(0.5 * office_.block_m.y()) - kSideWall_m;
    for (const Compass row : {kSouth, kNorth}) {
      plan_row(office_.block[row], depth_m);
      turn_corner_rooms(office_.block[row], row == kSouth ? 0 : 1);
    }
  }

  /// Cubicles reach from one long side to the other, and are entered from one of them.
  void plan_one_row() {
    plan_end(office_.block[kWest]);
    plan_end(office_.block[kEast]);
    HallwaySide& south = office_.block[kSouth];
    HallwaySide& north = office_.block[kNorth];
    south.sections = divide(south.length_m, dice_.within(1.9, 2.6));
    north.sections = south.sections;
    for (std::size_t i = 0; i < south.sections.size(); ++i) {
      const Front fronts[2] = {next_front(), next_front()};
      south.sections[i].set_back_m = fronts[0].set_back_m;
      north.sections[i].set_back_m = fronts[1].set_back_m;
      const bool from_north = dice_.chance(0.5);
      HallwaySide& side = from_north ? north : south;
      const double other_m = (from_north ? south : north).sections[i].set_back_m;
      if (dice_.chance(0.75)) {
        open(side, side.sections[i], fronts[from_north ? 1 : 0], inside(side.sections[i], side.length_m),
             to_centimetres(office_.block_m.y() - other_m - kWall_m));
      } else {
        put_cabinet(side.sections[i], kCorner_m);
      }
    }
  }

  void plan_outside(HallwaySide& side) {
    side.sections = divide(side.length_m, dice_.within(2.1, 2.9));
    for (Section& section : side.sections) {
      const Front front = next_front();
      section.set_back_m = front.set_back_m;
      const double depth_m = dice_.length(2.0, 3.0) + kMostSetBack_m;
      const double width_m = dice_.length(kNarrowestHallway_m + 0.05, 1.5);
      if (dice_.chance(0.1) && side_hallways_ < 2 && section.extent.length_m() >= width_m + 2.0 * kJamb_m) {
        const double from = to_centimetres(0.5 * (section.extent.from_m + section.extent.to_m - width_m));
        section.side_hallway = side.rectangle({from, to_centimetres(from + width_m)}, 0.0,
                                              to_centimetres(depth_m + dice_.within(0.5, 1.5)));
        ++side_hallways_;
      } else if (dice_.chance(0.6)) {
        open(side, section, front,
             {to_centimetres(section.extent.from_m + kSideWall_m),
              to_centimetres(section.extent.to_m - kSideWall_m)},
             depth_m);
      } else {
        put_cabinet(section, kCorner_m);
      }
    }
  }

  Dice dice_;
  Office office_;
  Front usual_;
  bool alike_ = false;
  int side_hallways_ = 0;
};

/// The middles of the doorways of a side, as a robot meets them that has the block on its right.
std::vector<double> doorways_met(const HallwaySide& side, bool from_end) {
  std::vector<double> met;
  for (const Section& section : side.sections) {
    if (!section.doorway) continue;
    const double middle_m = 0.5 * (section.doorway->from_m + section.doorway->to_m);
    met.push_back(from_end ? side.length_m - middle_m : middle_m);
  }
  std::ranges::sort(met);
  return met;
}

bool are_alike(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double kFarEnough_m = 0.3;
  return a.size() == b.size() && std::ranges::equal(a, b, [](double one, double other) {
           return std::abs(one - other) < kFarEnough_m;
         });
}

bool has_doorway(const HallwaySide& side) {
  return std::ranges::any_of(side.sections,
                             [](const Section& section) { return section.doorway.has_value(); });
}

bool is_wanted(const Office& office) {
  const auto& block = office.block;
  const bool same = are_alike(doorways_met(block[kSouth], true), doorways_met(block[kNorth], false)) &&
                    are_alike(doorways_met(block[kWest], false), doorways_met(block[kEast], true));
  return !same && std::ranges::any_of(block, has_doorway) && std::ranges::any_of(office.outside, has_doorway);
}

}  // namespace

Rectangle HallwaySide::rectangle(const Stretch& stretch, double from_behind_m, double to_behind_m) const {
  const Vec2 one = begin + along * stretch.from_m + behind * from_behind_m;
  const Vec2 other = begin + along * stretch.to_m + behind * to_behind_m;
  return {one.cwiseMin(other), one.cwiseMax(other)};
}

std::array<Rectangle, 4> Office::hallways() const {
  const auto& [south, north, west, east] = hallway_m;
  const double right = block_m.x() + east, top = block_m.y() + north;
  return {Rectangle{{-west, -south}, {right, 0.0}}, Rectangle{{-west, block_m.y()}, {right, top}},
          Rectangle{{-west, 0.0}, {0.0, block_m.y()}}, Rectangle{{block_m.x(), 0.0}, {right, block_m.y()}}};
}

Office plan_office(std::uint64_t seed) {
  for (std::uint32_t attempt = 0;; ++attempt) {
    Office office = Planner(seed, attempt).plan();
    if (is_wanted(office)) return office;
  }
}

}  // namespace hallway::study
