// SPDX-License-Identifier: MIT
// What the offices of the first robot promise, measured on the solids of their maps.
#include "study/first_robot/office.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/file.hpp"
#include "map/check.hpp"
#include "map/reader.hpp"
#include "map/world.hpp"
#include "map/writer.hpp"
#include "run/pictures/map_findings.hpp"
#include "sim/scenario.hpp"
#include "study/first_robot/office_files.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/long_mode.hpp"
#include "support/temp_folder.hpp"
#include "world/compiled_world.hpp"

namespace hallway::study {
namespace {

/// An office, its map as text and as solids.
struct Built {
  explicit Built(std::uint64_t seed)
      : office(plan_office(seed)),
        text(map::print(office_map(office))),
        document(map::parse(text, "office.map")),
        world(map::build_world(document)) {}

  /// Whether a point of the floor is in a wall or in a cabinet, as deep as the robot's bumpers are high.
  bool is_solid(const Vec2& at) const {
    const Vec3 point(at.x(), at.y(), 0.1);
    bool solid = false;
    for (const map::Solid& one : world.solids)
      if (one.contains(point)) solid = one.role != map::BrushRole::kSubtract;
    return solid;
  }

  /// How far it is free from a point along a direction, in centimetres.
  int free_cm(const Vec2& from, const Vec2& direction) const {
    int way = 0;
    while (way < 10'000 && !is_solid(from + 0.01 * (way + 0.5) * direction)) ++way;
    return way;
  }

  Office office;
  std::string text;
  map::Document document;
  map::World world;
};

std::vector<std::uint64_t> seeds() {
  std::vector<std::uint64_t> all;
  for (std::uint64_t seed = 1; seed <= test::sized<std::uint64_t>(12, 200); ++seed) all.push_back(seed);
  return all;
}

std::vector<const HallwaySide*> sides_of(const Office& office) {
  std::vector<const HallwaySide*> sides;
  for (const HallwaySide& side : office.block) sides.push_back(&side);
  for (const HallwaySide& side : office.outside) sides.push_back(&side);
  return sides;
}

Vec2 place(const HallwaySide& side, double along_m, double behind_m) {
  return side.begin + along_m * side.along + behind_m * side.behind;
}

TEST(FirstRobotOffices, AreSealedAndNothingIsFoundInTheirMaps) {
  for (const std::uint64_t seed : seeds()) {
    SCOPED_TRACE(seed);
    const Built built(seed);
    for (const map::Finding& finding : run::find_faults(built.document)) ADD_FAILURE() << finding.message;
    EXPECT_TRUE(built.world.problems.empty());
    world::Settings settings;
    settings.level = std::nullopt;
    EXPECT_TRUE(world::compile(built.document, settings).sealed());
  }
}

TEST(FirstRobotOffices, AreTheSameForTheSameSeed) {
  std::set<std::string> texts;
  for (const std::uint64_t seed : seeds()) {
    const std::string text = map::print(office_map(plan_office(seed)));
    EXPECT_EQ(text, map::print(office_map(plan_office(seed))));
    EXPECT_TRUE(texts.insert(text).second) << seed;
  }
}

TEST(FirstRobotOffices, HaveLoopsWallsAndDoorwaysOfTheSizesThatTheySay) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(seed);
    const Office office = plan_office(seed);
    EXPECT_GE(office.loop_m(), kShortestLoop_m - 0.05);
    EXPECT_LE(office.loop_m(), kLongestLoop_m + 0.05);
    for (const double width : office.hallway_m)
      EXPECT_GE(width, kNarrowestHallway_m + 2.0 * kCabinetProud_m - 1e-9);
    for (const HallwaySide* side : sides_of(office)) {
      double reached = 0.0;
      for (const Section& section : side->sections) {
        EXPECT_EQ(section.extent.from_m, reached);
        reached = section.extent.to_m;
        EXPECT_GE(section.set_back_m, 0.0);
        EXPECT_LE(section.set_back_m, kMostSetBack_m);
        EXPECT_EQ(section.room.has_value(), section.doorway.has_value());
        if (!section.doorway) continue;
        EXPECT_GE(section.doorway->length_m(), kNarrowestDoorway_m - 1e-9);
        EXPECT_LE(section.doorway->length_m(), kWidestDoorway_m + 1e-9);
        EXPECT_FALSE(section.cabinet || section.side_hallway);
      }
      EXPECT_EQ(reached, side->length_m);
    }
  }
}

TEST(FirstRobotOffices, RoomsHaveWallsBetweenThem) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(seed);
    const Office office = plan_office(seed);
    std::vector<Rectangle> rooms;
    for (const HallwaySide* side : sides_of(office)) {
      for (const Section& section : side->sections) {
        if (section.room) rooms.push_back(*section.room);
        if (section.side_hallway) rooms.push_back(*section.side_hallway);
        if (section.cabinet_in_room) {
          EXPECT_FALSE(section.room->overlaps(side->rectangle(*section.doorway, -1.0, 1.0)) &&
                       section.cabinet_in_room->overlaps(side->rectangle(*section.doorway, -1.0, 1.0)))
              << "the doorway is free";
        }
      }
    }
    for (std::size_t i = 0; i < rooms.size(); ++i) {
      EXPECT_GT(rooms[i].size().minCoeff(), 1.0);
      const Rectangle grown{rooms[i].low.array() - 0.05, rooms[i].high.array() + 0.05};
      for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(grown.overlaps(rooms[k]));
    }
  }
}

/// The robot is 28 cm wide; it follows the wall of the block at 30 cm, or its own width from there, and needs the way there and no more.
TEST(FirstRobotOffices, ARobotPassesRoundTheBlock) {
  constexpr double kReach_m = 0.22;  // from the middle of the robot to its corners
  for (const std::uint64_t seed : seeds()) {
    SCOPED_TRACE(seed);
    const Built built(seed);
    const Vec2 size = built.office.block_m;
    const double off = 0.45;
    const std::array corners{Vec2(-off, -off), Vec2(-off, size.y() + off),
                             Vec2(size.x() + off, size.y() + off), Vec2(size.x() + off, -off)};
    EXPECT_NEAR(built.office.start_m.y(), -off, 1e-12);
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec2 way = corners[(i + 1) % 4] - corners[i];
      for (double s = 0.0; s < 1.0; s += 0.05 / way.norm()) {
        const Vec2 at = corners[i] + s * way;
        for (int turn = 0; turn < 16; ++turn) {
          const double angle = turn * std::acos(-1.0) / 8.0;
          ASSERT_FALSE(built.is_solid(at + kReach_m * Vec2(std::cos(angle), std::sin(angle))))
              << at.transpose();
        }
      }
    }
    for (const double x : {-kReach_m, 0.0, kReach_m})
      EXPECT_FALSE(built.is_solid(built.office.start_m + Vec2(x, 0.0)));
  }
}

TEST(FirstRobotOffices, HallwaysAreAsWideAsTheySay) {
  for (const std::uint64_t seed : seeds()) {
    SCOPED_TRACE(seed);
    const Built built(seed);
    for (std::size_t i = 0; i < 4; ++i) {
      const HallwaySide& side = built.office.block[i];
      for (double s = 0.105; s < side.length_m; s += 0.1) {
        const Vec2 middle = place(side, s, -0.5 * built.office.hallway_m[i]);
        const int width = built.free_cm(middle, side.behind) + built.free_cm(middle, -side.behind);
        ASSERT_GE(width, static_cast<int>(100.0 * kNarrowestHallway_m)) << s;
      }
    }
    for (const HallwaySide& side : built.office.outside) {
      for (const Section& section : side.sections) {
        if (!section.side_hallway) continue;
        const Vec2 middle = 0.5 * (section.side_hallway->low + section.side_hallway->high);
        EXPECT_GE(built.free_cm(middle, side.along) + built.free_cm(middle, -side.along), 120);
        EXPECT_LT(built.free_cm(middle, side.behind), 1000) << "it ends";
      }
    }
  }
}

TEST(FirstRobotOffices, WallsAndDoorwaysAreWhereTheySay) {
  for (const std::uint64_t seed : seeds()) {
    SCOPED_TRACE(seed);
    const Built built(seed);
    for (const HallwaySide* side : sides_of(built.office)) {
      for (const Section& section : side->sections) {
        const double in_wall_m = section.set_back_m + 0.05;
        if (section.doorway) {
          const Vec2 middle =
              place(*side, 0.5 * (section.doorway->from_m + section.doorway->to_m), in_wall_m);
          EXPECT_NEAR(built.free_cm(middle, side->along) + built.free_cm(middle, -side->along),
                      100.0 * section.doorway->length_m(), 1.01);
          EXPECT_GT(built.free_cm(middle, side->behind), 60) << "a room";
        }
        if (section.cabinet) {
          const Vec2 middle = place(*side, 0.5 * (section.cabinet->from_m + section.cabinet->to_m), -0.3);
          EXPECT_NEAR(built.free_cm(middle, side->behind),
                      100.0 * (0.3 + section.set_back_m - kCabinetProud_m), 1.01);
        }
        if (section.doorway || section.cabinet || section.side_hallway) continue;
        const Vec2 middle = place(*side, 0.5 * (section.extent.from_m + section.extent.to_m), -0.3);
        EXPECT_NEAR(built.free_cm(middle, side->behind), 100.0 * (0.3 + section.set_back_m), 1.01);
      }
    }
  }
}

TEST(FirstRobotOffices, AllThatIsPromisedHappens) {
  int steps = 0, cabinets = 0, dead_ends = 0, alike = 0, end_doorways = 0, single_rows = 0;
  double shortest = 100.0, longest = 0.0;
  constexpr int kOffices = 200;
  for (std::uint64_t seed = 1; seed <= kOffices; ++seed) {
    const Office office = plan_office(seed);
    shortest = std::min(shortest, office.loop_m());
    longest = std::max(longest, office.loop_m());
    single_rows += office.block_m.y() < 4.0 ? 1 : 0;
    std::multiset<std::pair<double, double>> fronts;
    for (const HallwaySide* side : sides_of(office)) {
      for (std::size_t i = 0; i < side->sections.size(); ++i) {
        const Section& section = side->sections[i];
        steps += i > 0 && std::abs(section.set_back_m - side->sections[i - 1].set_back_m) > 0.1 ? 1 : 0;
        cabinets += section.cabinet ? 1 : 0;
        dead_ends += section.side_hallway ? 1 : 0;
        if (section.doorway)
          fronts.emplace(section.set_back_m, std::round(100.0 * section.doorway->length_m()));
      }
    }
    for (const Compass end : {kWest, kEast})
      for (const Section& section : office.block[end].sections) end_doorways += section.doorway ? 1 : 0;
    alike += std::ranges::any_of(fronts, [&](const auto& front) { return fronts.count(front) >= 3; }) ? 1 : 0;
  }
  EXPECT_LT(shortest, 17.0);
  EXPECT_GT(longest, 38.0);
  EXPECT_GT(steps, kOffices);
  EXPECT_GT(cabinets, kOffices / 4);
  EXPECT_GT(dead_ends, kOffices / 4);
  EXPECT_GT(end_doorways, kOffices / 10);
  EXPECT_GT(alike, kOffices / 4);
  EXPECT_LT(alike, kOffices * 3 / 4);
  EXPECT_GT(single_rows, kOffices / 10);
}

TEST(FirstRobotOffices, TheirScenariosDifferByFaults) {
  const test::TempFolder folder;
  const auto robot = test::source_folder() / "maps/robots/first.map";
  const auto files = write_office(5, folder / "o.map", robot);
  ASSERT_EQ(files.size(), 4u);
  EXPECT_EQ(read_file(files[3]), read_file(robot));
  const sim::Scenario plain = sim::load_scenario(files[1]), faulty = sim::load_scenario(files[2]);
  EXPECT_EQ(plain.map_file, files[0]);
  EXPECT_EQ(faulty.map_file, files[0]);
  EXPECT_EQ(plain.steps, 32000u);
  EXPECT_EQ(plain.period_ns, 50'000'000);
  ASSERT_EQ(plain.settings.size(), faulty.settings.size());
  std::set<std::string> changed;
  for (std::size_t i = 0; i < plain.settings.size(); ++i) {
    ASSERT_EQ(plain.settings[i].key, faulty.settings[i].key);
    if (plain.settings[i].value != faulty.settings[i].value) changed.insert(plain.settings[i].key);
  }
  std::set<std::string> expected{"robot.drive.turn_slip",    "robot.drive.turn_slip_noise",
                                 "sensor.sonar.missed_rate", "sensor.sonar.false_rate",
                                 "sensor.sonar.crosstalk",   "material.*white*.echo_deg"};
  for (const std::string detector : {"left", "front-left", "front", "front-right", "right"})
    for (const std::string key : {"noise_per_m", "missed_rate", "false_rate"})
      expected.insert("sensor.ir-" + detector + "." + key);
  EXPECT_EQ(changed, expected);
}

TEST(FirstRobotOffices, WithoutTheRobotFileNothingIsWritten) {
  const test::TempFolder folder;
  const auto error = test::error_of([&] { write_office(5, folder / "o.map", folder / "none.map"); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kIo);
  EXPECT_FALSE(std::filesystem::exists(folder / "o.map"));
}

}  // namespace
}  // namespace hallway::study
