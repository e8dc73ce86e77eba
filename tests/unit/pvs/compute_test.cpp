// SPDX-License-Identifier: MIT
#include "pvs/compute.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "split_world.hpp"
#include "support/errors.hpp"

namespace hallway::pvs {
namespace {

using bsp::Portal;
using bsp::PortalGraph;
using Visible = std::vector<std::vector<std::uint32_t>>;

Visible rows_of(const VisibleSets& sets) {
  Visible rows;
  for (std::uint32_t cluster = 0; cluster < sets.clusters(); ++cluster)
    rows.push_back(sets.visible_from(cluster));
  return rows;
}

/// A rectangle in the plane x = `x`, passed along +x from `behind` to `front`.
Portal door_x(double x, double y0, double y1, double z0, double z1, std::uint32_t behind,
              std::uint32_t front) {
  return {.polygon = {{{x, y0, z0}, {x, y1, z0}, {x, y1, z1}, {x, y0, z1}}, {Vec3::UnitX(), x}},
          .cluster = {front, behind}};
}

/// The same in the plane y = `y`, passed along +y.
Portal door_y(double y, double x0, double x1, double z0, double z1, std::uint32_t behind,
              std::uint32_t front) {
  return {.polygon = {{{x0, y, z0}, {x0, y, z1}, {x1, y, z1}, {x1, y, z0}}, {Vec3::UnitY(), y}},
          .cluster = {front, behind}};
}

/// A row of rooms [i, i + 1] x [0, 1] x [0, 1] with a door in each wall.
PortalGraph rooms_in_a_row(const std::vector<std::pair<double, double>>& doors) {
  PortalGraph graph;
  graph.clusters = static_cast<std::uint32_t>(doors.size() + 1);
  for (std::uint32_t i = 0; i < doors.size(); ++i) {
    graph.portals.push_back(door_x(i + 1.0, doors[i].first, doors[i].second, 0.0, 1.0, i, i + 1));
  }
  return graph;
}

test::SplitWorld large_world() {
  test::WorldSettings settings;
  settings.cells = 150;
  settings.size = 30.0;
  return test::split_world(77, settings);
}

TEST(Compute, WithoutPortalsAClusterSeesItself) {
  for (const Level level : {Level::kFast, Level::kFull}) {
    EXPECT_EQ(compute({}, {.level = level}).clusters(), 0u);
    EXPECT_EQ(rows_of(compute({.clusters = 1, .portals = {}}, {.level = level})), (Visible{{0}}));
    EXPECT_EQ(rows_of(compute({.clusters = 3, .portals = {}}, {.level = level})), (Visible{{0}, {1}, {2}}));
  }
}

TEST(Compute, DoorsInLineAreSeenThrough) {
  const PortalGraph graph = rooms_in_a_row({{0.4, 0.6}, {0.4, 0.6}, {0.4, 0.6}});
  for (const Level level : {Level::kFast, Level::kFull}) {
    EXPECT_EQ(compute(graph, {.level = level}).mean_share(), 1.0);
  }
}

TEST(Compute, DoorsOutOfLineHideTheLastRoom) {
  // From (1, 0.1) through (2, 0.9) a line leaves the third room through its side before it comes to the third
  // door.
  const PortalGraph graph = rooms_in_a_row({{0.0, 0.1}, {0.9, 1.0}, {0.0, 0.1}});
  EXPECT_EQ(rows_of(compute(graph, {})), (Visible{{0, 1, 2}, {0, 1, 2, 3}, {0, 1, 2, 3}, {1, 2, 3}}));
  EXPECT_EQ(compute(graph, {.level = Level::kFast}).mean_share(), 1.0);
}

TEST(Compute, TwoDoorsOfOneWallDoNotSeeEachOther) {
  // Room 1 lies behind two doors of the same wall, from room 0 and to room 2.
  PortalGraph graph{.clusters = 3, .portals = {door_x(1, 0, 1, 0, 1, 0, 1), door_x(1, 2, 3, 0, 1, 2, 1)}};
  for (const Level level : {Level::kFast, Level::kFull}) {
    EXPECT_EQ(rows_of(compute(graph, {.level = level})), (Visible{{0, 1}, {0, 1, 2}, {1, 2}}));
  }
  // A touch of a micrometre behind the wall is seen.
  graph.portals[1] = door_y(2, 1, 1 + 1e-6, 0, 1, 1, 2);
  EXPECT_EQ(compute(graph, {}).mean_share(), 1.0);
}

TEST(Compute, SeesThroughASlitThatTwoEdgesLeave) {
  // The doors leave a slit of a micrometre along y = 0.5.
  const PortalGraph open = rooms_in_a_row({{0.0, 0.5 + 1e-6}, {0.5, 1.0}, {0.0, 0.5 + 1e-6}});
  EXPECT_EQ(compute(open, {}).mean_share(), 1.0);
  const PortalGraph touching = rooms_in_a_row({{0.0, 0.5}, {0.5, 1.0}, {0.0, 0.5}});
  EXPECT_EQ(compute(touching, {}).mean_share(), 1.0) << "a line that grazes three edges";
  const PortalGraph closed = rooms_in_a_row({{0.0, 0.5 - 1e-6}, {0.5, 1.0}, {0.0, 0.5 - 1e-6}});
  EXPECT_EQ(rows_of(compute(closed, {}))[0], (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(Compute, TakesPortalsWithManyVertices) {
  PortalGraph graph = rooms_in_a_row({{0.4, 0.6}, {0.4, 0.6}});
  auto& polygon = graph.portals[0].polygon;
  polygon.vertices.clear();
  for (int i = 0; i < 100; ++i) {
    const double angle = 0.01 * i * 2.0 * 3.14159265358979323846;
    polygon.vertices.emplace_back(1.0, 0.5 + 0.1 * std::cos(angle), 0.5 + 0.1 * std::sin(angle));
  }
  EXPECT_EQ(compute(graph, {}).mean_share(), 1.0);
}

TEST(Compute, TakesPortalsThatRoundingMadeFlat) {
  for (const double width : {1e-7, 1e-13, 0.0, -1e-13}) {
    EXPECT_EQ(compute(rooms_in_a_row({{0.4, 0.6}, {0.5, 0.5 + width}, {0.4, 0.6}}), {}).mean_share(), 1.0)
        << width;
  }
}

TEST(Compute, DoesNotDependOnTheNumberOfThreads) {
  const PortalGraph graph = large_world().graph;
  for (const Level level : {Level::kFast, Level::kFull}) {
    for (const std::uint64_t work_limit : {std::uint64_t{300'000}, Options{}.work_limit}) {
      Statistics first;
      const Visible expected = rows_of(compute(graph, {.level = level, .work_limit = work_limit}, &first));
      for (const unsigned threads : {2u, 3u, 8u}) {
        Statistics statistics;
        const VisibleSets sets =
            compute(graph, {.level = level, .threads = threads, .work_limit = work_limit}, &statistics);
        EXPECT_EQ(rows_of(sets), expected) << threads << " threads";
        EXPECT_EQ(statistics.work, first.work);
        EXPECT_EQ(statistics.cut_short, first.cut_short);
        EXPECT_EQ(statistics.seen, first.seen);
      }
    }
  }
}

TEST(Compute, CountsWhatItDoes) {
  const PortalGraph graph = large_world().graph;
  Statistics statistics;
  compute(graph, {}, &statistics);
  EXPECT_EQ(statistics.portals, 2 * graph.portals.size());
  EXPECT_GE(statistics.candidates, statistics.seen);
  EXPECT_GT(statistics.seen, statistics.portals);
  EXPECT_GT(statistics.work, 0u);
  EXPECT_EQ(statistics.cut_short, 0u);
  EXPECT_FALSE(statistics.too_large);
  compute(graph, {.work_limit = 0}, &statistics);
  EXPECT_GT(statistics.cut_short, 0u);
}

TEST(Compute, ReportsRisingProgressToTheEnd) {
  const PortalGraph graph = large_world().graph;
  for (const Level level : {Level::kFast, Level::kFull}) {
    for (const unsigned threads : {1u, 3u}) {
      std::size_t last = 0;
      std::atomic<int> inside = 0;
      bool orderly = true;
      const auto progress = [&](std::size_t done, std::size_t total) {
        orderly = orderly && ++inside == 1 && done > last && done <= total && total == 1000;
        last = done;
        --inside;
      };
      compute(graph, {.level = level, .threads = threads, .progress = progress});
      EXPECT_TRUE(orderly);
      EXPECT_EQ(last, 1000u);
    }
  }
}

TEST(Compute, WhatProgressThrowsComesOut) {
  const PortalGraph graph = large_world().graph;
  for (const Level level : {Level::kFast, Level::kFull}) {
    for (const unsigned threads : {1u, 2u, 8u}) {
      for (const std::size_t moment : {1u, 90u, 150u, 600u, 1000u}) {
        std::size_t calls_after = 0;
        bool thrown = false;
        const auto progress = [&](std::size_t done, std::size_t) {
          calls_after += thrown ? 1 : 0;
          if (done < moment) return;
          thrown = true;
          throw std::domain_error("stop");
        };
        EXPECT_THROW(compute(graph, {.level = level, .threads = threads, .progress = progress}),
                     std::domain_error);
        EXPECT_EQ(calls_after, 0u);
      }
    }
  }
}

/// The element that the error names; empty if the graph is taken or the error is another one.
std::string refused(const std::function<void(PortalGraph&)>& spoil) {
  PortalGraph graph = rooms_in_a_row({{0.4, 0.6}, {0.3, 0.5}});
  spoil(graph);
  const auto error = hallway::test::error_of([&] { compute(graph, {}); });
  return error && error->code() == ErrorCode::kInternal ? error->where().element : "";
}

TEST(Compute, RefusesGraphsThatAreNone) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refused([](PortalGraph&) {}), "");
  EXPECT_EQ(refused([](PortalGraph& g) { g.portals[1].cluster[0] = 3; }), "portal 1");
  EXPECT_EQ(refused([](PortalGraph& g) { g.portals[1].cluster[0] = g.portals[1].cluster[1]; }), "portal 1");
  EXPECT_EQ(refused([](PortalGraph& g) { g.portals[0].polygon.vertices.resize(2); }), "portal 0");
  EXPECT_EQ(refused([](PortalGraph& g) { g.portals[0].polygon.vertices[2].y() = kNan; }), "portal 0");
  EXPECT_EQ(refused([](PortalGraph& g) { g.portals[0].polygon.vertices[2].y() = kInfinity; }), "portal 0");
  EXPECT_EQ(refused([](PortalGraph& g) { g.portals[0].polygon.plane.offset = kNan; }), "portal 0");
  EXPECT_EQ(refused([](PortalGraph& g) { g.portals[0].polygon.plane.normal *= 2.0; }), "portal 0");
  EXPECT_EQ(refused([](PortalGraph& g) { g.portals[0].polygon.vertices[0].x() += 0.01; }), "portal 0");
  EXPECT_EQ(refused([](PortalGraph& g) {
              std::swap(g.portals[0].polygon.vertices[1], g.portals[0].polygon.vertices[3]);
            }),
            "portal 0");
  EXPECT_EQ(refused([](PortalGraph& g) {
              std::swap(g.portals[0].polygon.vertices[1], g.portals[0].polygon.vertices[2]);
            }),
            "portal 0");
  EXPECT_EQ(refused([](PortalGraph& g) { g.portals[0].polygon.vertices.assign(4, Vec3(1, 0.5, 0.5)); }),
            "portal 0");
}

}  // namespace
}  // namespace hallway::pvs
