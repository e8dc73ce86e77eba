// SPDX-License-Identifier: MIT
#include "watch/page.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "watch/display.hpp"
#include "watch/keys.hpp"

namespace hallway::watch {
namespace {

Scene room() {
  Scene scene{.name = "room", .iterations = 10};
  const std::vector<Vec2> corners{Vec2(0, 0), Vec2(6, 0), Vec2(6, 4), Vec2(0, 4)};
  for (std::size_t i = 0; i < 4; ++i) scene.plan.emplace_back(corners[i], corners[(i + 1) % 4]);
  return scene;
}

Moment in_room() {
  Moment moment{.iteration = 3, .t_ns = 300'000'000, .T_world_body = Pose{Quat::Identity(), Vec3(3, 2, 0)}};
  moment.readings = {"eyes: 3 points"};
  moment.counters = {{"landmarks", 12.0}};
  moment.lines.push_back({1, "mapper", "hello"});
  return moment;
}

bool overlap(const Area& a, const Area& b) {
  return a.column < b.column + b.width && b.column < a.column + a.width && a.row < b.row + b.height &&
         b.row < a.row + a.height;
}

TEST(PageLayout, PartsAreOnThePageAndApart) {
  for (int width = kLeastWidth; width <= 220; width += 3) {
    for (int height = kLeastHeight; height <= 70; ++height) {
      const PageLayout layout = layout_of(width, height);
      for (const Area& area : {layout.canvas, layout.panel, layout.lines}) {
        EXPECT_GE(area.width, 10) << width << "x" << height;
        EXPECT_GE(area.height, 1) << width << "x" << height;
        EXPECT_GE(area.row, 1);
        EXPECT_LE(area.row + area.height, height - 1);
        EXPECT_LE(area.column + area.width, width);
      }
      EXPECT_FALSE(overlap(layout.canvas, layout.panel));
      EXPECT_FALSE(overlap(layout.canvas, layout.lines));
      EXPECT_FALSE(overlap(layout.panel, layout.lines));
    }
  }
}

TEST(PageLayout, PanelIsBesideOnAWidePageAndBelowOnANarrowOne) {
  EXPECT_EQ(layout_of(80, 24).panel.row, layout_of(80, 24).canvas.row);
  EXPECT_GE(layout_of(80, 24).canvas.width, 50);
  EXPECT_GE(layout_of(80, 24).canvas.height, 15);
  EXPECT_GE(layout_of(200, 60).canvas.width, 150);
  EXPECT_GT(layout_of(40, 12).panel.row, layout_of(40, 12).canvas.row);
}

class Pages : public testing::TestWithParam<std::pair<int, int>> {
 protected:
  std::string text(Display& display) const {
    const Grid grid = display.draw(GetParam().first, GetParam().second);
    EXPECT_EQ(grid.width(), GetParam().first);
    EXPECT_EQ(grid.height(), GetParam().second);
    std::string all;
    for (int row = 0; row < grid.height(); ++row) all += grid.row_text(row) + "\n";
    return all;
  }
};

TEST_P(Pages, ShowRobotPlanStateLogAndHelp) {
  Display display(room(), {});
  display.add(in_room());
  display.player().advance(0);
  const std::string all = text(display);
  EXPECT_NE(all.find("→"), std::string::npos) << all;
  EXPECT_NE(all.find("⡇"), std::string::npos) << "a side of the room\n" << all;
  EXPECT_NE(all.find("frame 3 of 9, 0.30 s"), std::string::npos) << all;
  EXPECT_NE(all.find("at 3.00, 2.00 m 0 deg"), std::string::npos) << all;
  EXPECT_NE(all.find("mapper: hello"), std::string::npos) << all;
  EXPECT_NE(all.find("? keys"), std::string::npos) << all;
}

TEST_P(Pages, HelpNamesKeysAndLayers) {
  Display display(room(), {});
  display.add(in_room());
  display.press('?');
  const std::string all = text(display);
  EXPECT_NE(all.find("SPACE"), std::string::npos) << all;
  EXPECT_NE(all.find("HOME"), std::string::npos) << all;
  display.press('?');
  EXPECT_EQ(text(display).find("HOME"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Pages,
                         testing::Values(std::pair(80, 24), std::pair(200, 60), std::pair(60, 20),
                                         std::pair(40, 12)));

TEST(Page, AsciiPageHasOnlyAscii) {
  Display display(room(), {.dots = Dots::kAscii});
  display.add(in_room());
  const Grid grid = display.draw(80, 24);
  for (int row = 0; row < 24; ++row) {
    for (int column = 0; column < 80; ++column)
      EXPECT_LT(grid.at(column, row).glyph, 0x80u) << column << "," << row;
  }
}

TEST(Page, TooSmallSaysSo) {
  Display display(room(), {});
  display.add(in_room());
  EXPECT_EQ(display.draw(39, 12).row_text(0), "39 x 12 is too small: 40 x 12");
  EXPECT_EQ(display.draw(80, 5).row_text(0), "80 x 5 is too small: 40 x 12");
  EXPECT_EQ(display.draw(1, 1).row_text(0), "~");
}

TEST(Page, PanelSaysHowPluginAndDriveAre) {
  const Scene scene = room();
  Past past;
  Moment moment = in_room();
  moment.pose = log::PoseAnswer{.valid = false};
  moment.obeyed =
      log::ObeyedCommand{.linear_m_s = 0.25, .cause = log::CommandCause::kTimeout, .changes = "speed"};
  moment.contacts.push_back({.t_ns = moment.t_ns, .kind = "wall"});
  past.add(moment);
  std::string all;
  for (const auto& [text, role] : panel_lines({scene, past, moment})) all += text + "\n";
  for (const char* part :
       {"lost", "0.25 m/s", "by timeout, changed: speed", "1 contact\n", "landmarks 12", "eyes: 3 points"})
    EXPECT_NE(all.find(part), std::string::npos) << part << " in\n" << all;
}

TEST(Page, PanelSaysHowTheChartIs) {
  const Scene scene = room();
  Past past;
  Moment moment{.iteration = 1};
  const auto panel = [&] { return panel_lines({scene, past, moment}); };
  const auto has = [&](const PanelLine& line) { return std::ranges::count(panel(), line) == 1; };
  EXPECT_FALSE(has({"plugin", Role::kEstimate}));
  log::Topology topology{.loop = log::LoopState::kClosed, .nodes = {{.id = 1}, {.id = 2}}};
  moment.topology = std::make_shared<const log::Topology>(topology);
  EXPECT_TRUE(has({"plugin", Role::kEstimate}));
  EXPECT_TRUE(has({"  2 nodes, loop closed", Role::kText}));
  topology.loop = log::LoopState::kUncertain;
  topology.note = "two rooms read alike";
  moment.topology = std::make_shared<const log::Topology>(topology);
  EXPECT_TRUE(has({"  2 nodes, loop uncertain", Role::kContact}));
  EXPECT_TRUE(has({"  two rooms read alike", Role::kDim}));
  moment.topology = nullptr;
  moment.drawing = {{.kind = log::DrawingKind::kText, .points_m = {{0, 0}}, .text = "sweep"}};
  EXPECT_TRUE(has({"  sweep", Role::kDrawn}));
}

TEST(Page, PanelSaysHowMuchItLeavesOut) {
  Display display(room(), {});
  Moment moment = in_room();
  for (int i = 0; i < 30; ++i) moment.readings.push_back("sensor " + std::to_string(i));
  display.add(moment);
  const PageLayout layout = layout_of(80, 24);
  const std::string last = display.draw(80, 24).row_text(layout.panel.row + layout.panel.height - 1);
  EXPECT_NE(last.find("... "), std::string::npos) << last;
  EXPECT_NE(last.find(" more"), std::string::npos) << last;
}

TEST(Page, TitleSaysStateOrNote) {
  Display display(room(), {});
  display.add(in_room());
  display.player().advance(0);
  EXPECT_NE(display.draw(80, 24).row_text(0).find("playing x1"), std::string::npos);
  display.press(' ');
  EXPECT_NE(display.draw(80, 24).row_text(0).find("PAUSED"), std::string::npos);
  display.player().end();
  EXPECT_NE(display.draw(80, 24).row_text(0).find("END"), std::string::npos);
  display.set_note("writing the run");
  EXPECT_NE(display.draw(80, 24).row_text(0).find("writing the run"), std::string::npos);
}

TEST(Keys, EachMeansOneThing) {
  std::vector<int> keys;
  for (const KeyRow& row : key_table()) keys.insert(keys.end(), row.keys.begin(), row.keys.end());
  for (const Layer& layer : layers()) keys.push_back(layer.key);
  std::vector<int> sorted = keys;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(std::unique(sorted.begin(), sorted.end()), sorted.end());
  for (const KeyRow& row : key_table()) {
    for (const int key : row.keys) EXPECT_EQ(action_of(key), row.action);
  }
  EXPECT_FALSE(action_of('%'));
}

}  // namespace
}  // namespace hallway::watch
