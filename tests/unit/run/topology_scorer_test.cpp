// SPDX-License-Identifier: MIT
#include "run/scoring/topology_scorer.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "eval/topology_truth.hpp"
#include "run/scoring/floor_plan.hpp"
#include "run/sources/simulated_source.hpp"
#include "support/data.hpp"
#include "support/temp_folder.hpp"
#include "unit/sim/small_world.hpp"

namespace hallway::run {
namespace {

/// Along the path `ahead`, 4 m in x at y = 3 m, a wall on the right, 0.4 m from it, that is 0.3 m farther from x = 1.5 m to x = 2.5 m.
std::string wall_with_a_niche() {
  return test::block(-200, 200, -100, 150, 260, 100) + test::block(150, 200, -100, 250, 230, 100) +
         test::block(250, 200, -100, 600, 260, 100);
}

class Along {
 public:
  explicit Along(const std::string& sensors) {
    folder_.write("small.map", test::map_text(wall_with_a_niche()));
    scenario_ = sim::load_scenario(folder_.write("s.toml",
                                                 "map = \"small.map\"\nseed = 5\nsteps = 40\nperiod_s = "
                                                 "0.1\n[robot]\npath = \"ahead\"\nspeed_m_s = 1\n" +
                                                     sensors));
    simulator_.emplace(scenario_, 1, trace::Backend::kBruteForce);
  }
  const sim::Simulator& simulator() const { return *simulator_; }
  const sim::Scenario& scenario() const { return scenario_; }

 private:
  test::TempFolder folder_;
  sim::Scenario scenario_;
  std::optional<sim::Simulator> simulator_;
};

constexpr const char* kSensors =
    "[sensor.scanner]\nkind = 'lidar'\nrings = 1\ncolumns = 4\nstep_deg = 90\n"
    "[sensor.side]\nkind = 'infrared'\nposition_m = [0, 0, 0.2]\n";

TEST(FloorPlanOfARun, IsTheSectionOfTheSolid) {
  const Along along(kSensors);
  const eval::FloorPlan plan = floor_plan_at(along.simulator(), 0.2);
  // The three blocks are one body with eight corners.
  ASSERT_EQ(plan.walls().size(), 8u);
  double length_m = 0.0;
  for (const eval::PlanWall& wall : plan.walls()) {
    length_m += wall.length_m;
    ASSERT_NE(wall.next, eval::PlanWall::kNone);
    EXPECT_EQ(plan.walls()[wall.next].start(), wall.end());
  }
  EXPECT_NEAR(length_m, 2 * 8 + 2 * 0.6 + 2 * 0.3, 1e-9);
  const auto hit = plan.first_hit({2, 3}, {0, -1}, 2);
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->range_m, 0.7, 1e-9);
  EXPECT_NEAR(hit->along_m, 0.5, 1e-9);
  EXPECT_TRUE(floor_plan_at(along.simulator(), 1.5).walls().empty()) << "above the blocks";
}

TEST(FloorPlanOfARun, OfTheOfficeIsClosedAndHasItsDoorways) {
  const sim::Simulator office(sim::load_scenario(test::source_folder() / "maps" / "office.toml"), 1,
                              trace::Backend::kBruteForce);
  const eval::FloorPlan plan = floor_plan_at(office, 0.5);
  for (const eval::PlanWall& wall : plan.walls()) EXPECT_NE(wall.next, eval::PlanWall::kNone);
  // East along the corridor, whose southern wall is at y = 7. Its doorways have frames of 5 cm, 2 cm proud of the wall. The first two rooms have a
  // doorway between them, so that neither is closed; the third has only the one.
  eval::DrivenWay way;
  for (int i = 0; i <= 1125; ++i) way.add(i, {0.5 + 0.02 * i, 7.5, 0.0});
  const eval::TopologyTruth truth = eval::find_truth(plan, way);
  std::vector<eval::TrueNode> demanded;
  for (const eval::TrueNode& node : truth.nodes) {
    if (node.is_demanded) demanded.push_back(node);
  }
  ASSERT_EQ(demanded.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(demanded[i].kind, i < 2 ? eval::TrueKind::kHallway : eval::TrueKind::kRoom);
    const double from_m = i == 0 ? 2.4 : i == 1 ? 12.4 : 21.4;
    EXPECT_NEAR(demanded[i].from.x(), from_m, 0.051);
    EXPECT_NEAR(demanded[i].to.x(), from_m + 1.2, 0.051);
    EXPECT_NEAR(demanded[i].from.y(), 7.0, 0.021);
  }
}

TEST(FloorPlanOfARun, IsAtTheHeightOfTheInfraredSensor) {
  EXPECT_DOUBLE_EQ(plan_height_above_body(Along(kSensors).scenario()), 0.2);
  EXPECT_EQ(plan_height_above_body({}), 0.0);
}

TEST(TopologyScorer, ScoresAChartOfASimulatedDrive) {
  const Along along(kSensors);
  SimulatedSource source(along.simulator());
  TopologyScorer scorer(source, {});
  log::Topology chart;
  SourceFrame frame;
  for (std::uint32_t i = 0; i < source.iterations(); ++i) {
    source.read(i, frame);
    scorer.add({.iteration = i, .frame = frame});
    if (i != 15 && i != 25) continue;
    chart.nodes.push_back({.id = i,
                           .kind = log::PlaceKind::kDiscontinuity,
                           .direction = i == 15 ? 1 : -1,
                           .size_m = 0.3,
                           .t_ns = frame.t_ns(),
                           .x_m = 0.0,
                           .y_m = -0.4});
  }
  EXPECT_FALSE(scorer.score().has_value());
  chart.edges.push_back({15, 25, 1.1});
  scorer.set_topology(chart);
  const auto score = scorer.score();
  ASSERT_TRUE(score.has_value());
  EXPECT_EQ(score->metrics.demanded, 2u);
  EXPECT_EQ(score->metrics.found, 2u);
  EXPECT_LT(score->metrics.place_m->max, 1e-6);
  EXPECT_NEAR(score->metrics.length_m->max, 0.1, 1e-6);
}

}  // namespace
}  // namespace hallway::run
