// SPDX-License-Identifier: MIT
// Buildings with holes of known size, made at random: the report of a leak must name a hole, and never a slice of the tree inside a room.
// Map units are centimetres.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "bsp/compile.hpp"
#include "support/brushes.hpp"
#include "support/long_mode.hpp"

namespace hallway::bsp {
namespace {

using test::box;
using test::MapMaker;

constexpr double kMetresPerUnit = 0.01;

/// A hole through the hull: what of a wall or the roof is not there.
struct Hole {
  Vec3 low, high;  ///< map units, through the whole thickness
  int axis = 0;    ///< across the wall
};

/// A box without holes in it, as boxes: those around one hole after the other.
std::vector<std::pair<Vec3, Vec3>> boxes_around(const Vec3& low, const Vec3& high,
                                                const std::vector<Hole>& holes) {
  std::vector<std::pair<Vec3, Vec3>> boxes{{low, high}};
  for (const Hole& hole : holes) {
    std::vector<std::pair<Vec3, Vec3>> next;
    for (auto [a, b] : boxes) {
      if (((hole.high - a).array() <= 0.0).any() || ((b - hole.low).array() <= 0.0).any()) {
        next.emplace_back(a, b);
        continue;
      }
      for (int axis = 0; axis < 3; ++axis) {
        if (hole.low[axis] > a[axis]) {
          Vec3 end = b;
          end[axis] = hole.low[axis];
          next.emplace_back(a, end);
          a[axis] = hole.low[axis];
        }
        if (hole.high[axis] < b[axis]) {
          Vec3 begin = a;
          begin[axis] = hole.high[axis];
          next.emplace_back(begin, b);
          b[axis] = hole.high[axis];
        }
      }
    }
    boxes = std::move(next);
  }
  return boxes;
}

enum class Kind { kDoor, kWindow, kSlot, kSkylight, kLowWall, kNarrowRoom, kTwoHoles, kTurned, kCut };

constexpr Kind kKinds[] = {Kind::kDoor,       Kind::kWindow,   Kind::kSlot,   Kind::kSkylight, Kind::kLowWall,
                           Kind::kNarrowRoom, Kind::kTwoHoles, Kind::kTurned, Kind::kCut};

const char* name_of(Kind kind) {
  constexpr const char* kNames[] = {"door",        "window",    "slot",   "skylight", "low wall",
                                    "narrow room", "two holes", "turned", "cut"};
  return kNames[static_cast<int>(kind)];
}

/// A building of one to four rooms in a row along x, with furniture, and holes in the hull of one of them.
class Building {
 public:
  Building(Kind kind, std::uint64_t seed) : random_(seed), kind_(kind) {
    wall_ = pick(10, 40);
    depth_ = kind == Kind::kNarrowRoom ? pick(90, 140) : pick(300, 700);
    height_ = pick(220, 340);
    const int rooms = static_cast<int>(pick(1, 4));
    x_.push_back(0.0);
    for (int i = 0; i < rooms; ++i) x_.push_back(x_.back() + pick(300, 700) + (i > 0 ? wall_ : 0.0));
    make_holes();
    make_walls();
    furnish();
    if (kind == Kind::kTurned) {
      turn_ = Eigen::Quaterniond(Eigen::AngleAxisd(uniform(0.1, 1.4), Vec3::UnitZ()));
      shift_ = Vec3(uniform(-2000, 2000), uniform(-2000, 2000), uniform(-100, 100));
    }
  }

  map::World world() const {
    MapMaker maker(kMetresPerUnit);
    for (const map::Brush& brush : brushes_) maker.add(test::moved(brush, turn_, shift_));
    for (const map::Brush& brush : cuts_) maker.subtract(test::moved(brush, turn_, shift_), 1);
    return maker.world();
  }

  /// Somewhere in the first room, free of furniture.
  Vec3 occupant_m() const { return (turn_ * Vec3(40, 30, 120) + shift_) * kMetresPerUnit; }

  /// "" where the opening is one of the holes, else what is wrong with it.
  std::string fault_of(const Opening& opening) const {
    constexpr double kPlace_m = 0.01, kSize = 0.01;
    const Vec3 at = turn_.inverse() * (opening.at / kMetresPerUnit - shift_);
    std::string holes;
    for (const Hole& hole : holes_) {
      Vec3 sizes = (hole.high - hole.low) * kMetresPerUnit;
      const Vec3 away = (at - 0.5 * (hole.low + hole.high)) * kMetresPerUnit;
      const int u = (hole.axis + 1) % 3, v = (hole.axis + 2) % 3;
      const double width = std::min(sizes[u], sizes[v]), height = std::max(sizes[u], sizes[v]);
      const bool in_place = std::abs(away[u]) < kPlace_m && std::abs(away[v]) < kPlace_m &&
                            std::abs(away[hole.axis]) < 0.5 * sizes[hole.axis] + kPlace_m;
      if (in_place && std::abs(opening.width_m / width - 1.0) < kSize &&
          std::abs(opening.height_m / height - 1.0) < kSize)
        return {};
      holes += " hole " + size_text(width, height, 0.5 * (hole.low + hole.high) * kMetresPerUnit);
    }
    return "reported " + size_text(opening.width_m, opening.height_m, at * kMetresPerUnit) + "," + holes;
  }

 private:
  static std::string size_text(double width, double height, const Vec3& at) {
    return format_double(width) + " x " + format_double(height) + " at " + format_double(at.x()) + " " +
           format_double(at.y()) + " " + format_double(at.z());
  }

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  /// A whole number.
  double pick(int low, int high) {
    return low + static_cast<double>(random_() % static_cast<std::uint64_t>(high - low + 1));
  }

  /// A hole in the wall north (+y) or south of a room. @param most  how much of the wall it may take
  Hole in_long_wall(bool north, double width, double low, double high) {
    const auto room = static_cast<std::size_t>(random_() % (x_.size() - 1));
    const double begin = x_[room] + (room > 0 ? wall_ : 0.0) + 5.0, end = x_[room + 1] - 5.0;
    width = std::min(width, end - begin - 1.0);
    const double at = begin + std::floor(uniform(0.0, end - begin - width));
    const double y = north ? depth_ : -wall_;
    return {{at, y, low}, {at + width, y + wall_, high}, 1};
  }

  void make_holes() {
    switch (kind_) {
      case Kind::kDoor:
      case Kind::kTurned:
      case Kind::kCut:
        holes_ = {in_long_wall(random_() % 2 == 0, pick(70, 160), 0, pick(190, 215))};
        break;
      case Kind::kWindow: {
        const double sill = pick(60, 120);
        holes_ = {in_long_wall(random_() % 2 == 0, pick(30, 250), sill, sill + pick(20, 90))};
        break;
      }
      case Kind::kSlot:
        holes_ = {in_long_wall(random_() % 2 == 0, uniform(0.1, 2.0), 0, height_)};
        break;
      case Kind::kSkylight: {
        const double x = pick(20, 200), y = pick(20, 150);
        holes_ = {{{x, y, height_}, {x + pick(10, 60), y + pick(10, 120), height_ + wall_}, 2}};
        break;
      }
      case Kind::kLowWall: {  // between the east wall and the roof, from wall to wall
        const double gap = uniform(0.5, 30.0);
        holes_ = {{{x_.back(), 0, height_ - gap}, {x_.back() + wall_, depth_, height_}, 0}};
        break;
      }
      case Kind::kNarrowRoom:  // wider than the room
        holes_ = {in_long_wall(random_() % 2 == 0, pick(150, 280), 0, height_ - 10.0)};
        break;
      case Kind::kTwoHoles: {
        holes_ = {in_long_wall(true, pick(30, 120), 0, pick(150, 210)),
                  in_long_wall(false, pick(30, 120), pick(50, 90), pick(100, 200))};
        break;
      }
    }
  }

  void make_walls() {
    const Vec3 low(-wall_, -wall_, 0), high(x_.back() + wall_, depth_ + wall_, height_);
    const auto add = [&](const Vec3& a, const Vec3& b, const std::vector<Hole>& holes) {
      for (const auto& [from, to] : boxes_around(a, b, holes)) brushes_.push_back(box(from, to));
    };
    const std::vector<Hole> hull = kind_ == Kind::kCut ? std::vector<Hole>{} : holes_;
    add({low.x(), low.y(), -wall_}, {high.x(), high.y(), 0}, {});
    add({low.x(), low.y(), height_}, {high.x(), high.y(), height_ + wall_}, hull);
    add({low.x(), low.y(), 0}, {high.x(), 0, height_}, hull);
    add({low.x(), depth_, 0}, {high.x(), high.y(), height_}, hull);
    add({low.x(), 0, 0}, {0, depth_, height_}, hull);
    add({x_.back(), 0, 0}, {high.x(), depth_, height_}, hull);
    for (std::size_t i = 1; i + 1 < x_.size(); ++i) {  // doors between the rooms are narrower than most holes
      const double y = pick(5, static_cast<int>(depth_) - 85);
      add({x_[i], 0, 0}, {x_[i] + wall_, depth_, height_},
          {{{x_[i], y, 0}, {x_[i] + wall_, y + 80, 205}, 0}});
    }
    if (kind_ != Kind::kCut) return;
    for (const Hole& hole : holes_) {
      Vec3 more = Vec3::Zero();
      more[hole.axis] = 3.0;
      cuts_.push_back(box(hole.low - more, hole.high + more));
    }
  }

  /// Tables, shelves and pillars that leave 75 cm free along the walls; they cut the rooms into slices.
  void furnish() {
    if (depth_ < 200.0) return;
    for (std::size_t i = 0; i + 1 < x_.size(); ++i) {
      const double begin = x_[i] + (i > 0 ? wall_ : 0.0) + 75.0, end = x_[i + 1] - 75.0;
      for (int k = static_cast<int>(pick(0, 3)); k > 0 && end - begin > 30.0; --k) {
        const double x = begin + std::floor(uniform(0.0, end - begin - 20.0));
        const double y = 75.0 + std::floor(uniform(0.0, depth_ - 170.0));
        const Vec3 low(x, y, random_() % 3 == 0 ? pick(40, 90) : 0.0);
        const Vec3 high(std::min(x + pick(15, 150), end), std::min(y + pick(15, 150), depth_ - 75.0),
                        low.z() + pick(5, 110));
        brushes_.push_back(box(low, high));
      }
    }
  }

  std::mt19937_64 random_;
  Kind kind_;
  double wall_ = 0.0, depth_ = 0.0, height_ = 0.0;
  std::vector<double> x_;  ///< where the rooms end
  std::vector<Hole> holes_;
  std::vector<map::Brush> brushes_, cuts_;
  Eigen::Quaterniond turn_ = Eigen::Quaterniond::Identity();
  Vec3 shift_ = Vec3::Zero();
};

TEST(LeakOpenings, RandomBuildings) {
  const int rounds = test::long_mode() ? 300 : 25;
  for (const Kind kind : kKinds) {
    int wrong = 0;
    std::string first;
    for (int round = 0; round < rounds; ++round) {
      const Building building(kind, static_cast<std::uint64_t>(1000 * round + static_cast<int>(kind)));
      const Compiled compiled = compile(building.world(), {building.occupant_m()}, {});
      ASSERT_TRUE(compiled.enclosure.leak.has_value()) << name_of(kind) << " " << round;
      const std::string fault = building.fault_of(compiled.enclosure.leak->narrowest);
      if (fault.empty()) continue;
      if (++wrong <= 5) first += "\n  round " + std::to_string(round) + ": " + fault;
    }
    EXPECT_EQ(wrong, 0) << name_of(kind) << ", of " << rounds << ":" << first;
  }
}

/// Where the roof floats above all four walls the hole is in no plane: what is said is the gap's width, and no more.
TEST(LeakOpenings, GapAllAroundBelowTheRoof) {
  const std::vector<map::Brush> walls = test::room({0, 0, 0}, {800, 600, 300}, 20.0);
  MapMaker maker(kMetresPerUnit);
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (i != 1) maker.add(walls[i]);
  }
  maker.add(box({-20, -20, 310}, {820, 620, 330}));
  const Compiled compiled = compile(maker.world(), {Vec3(4, 3, 1)}, {});
  ASSERT_TRUE(compiled.enclosure.leak.has_value());
  const Opening& opening = compiled.enclosure.leak->narrowest;
  EXPECT_FALSE(opening.is_measured());
  EXPECT_NEAR(opening.width_m, 0.1, 1e-6);
  EXPECT_NEAR(opening.at.z(), 3.05, 1e-6);
}

TEST(LeakOpenings, NobodyInsideMeansNoHole) {
  MapMaker maker(kMetresPerUnit);
  maker.add(test::room({0, 0, 0}, {800, 600, 300}, 20.0));
  const Compiled compiled = compile(maker.world(), {Vec3(4, 3, 8)}, {});
  ASSERT_TRUE(compiled.enclosure.leak.has_value());
  EXPECT_FALSE(compiled.enclosure.leak->narrowest.is_measured());
  EXPECT_EQ(compiled.enclosure.leak->narrowest.width_m, 0.0);
}

}  // namespace
}  // namespace hallway::bsp
