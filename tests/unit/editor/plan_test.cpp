// SPDX-License-Identifier: MIT
//
// What a floor plan shows, and the page as SVG and PDF.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.hpp"
#include "base/text.hpp"
#include "editor/plan.hpp"
#include "map/reader.hpp"
#include "solidity.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"

namespace hallway {
namespace {

using editor::FloorPlan;
using editor::PlanPaper;
using editor::Section;
using editor::Sheet;
using test::Editing;

csg::Surface surface_of(const Editing& editing) {
  return csg::build_surface(test::world_of(editing));
}

Section section_of(const Editing& editing, double height) {
  return editor::section_at(surface_of(editing), height);
}

FloorPlan plan_of(const Editing& editing, double height = 1.2) {
  return editor::make_plan(editing.session->state(), "folder/flat.map", height);
}

void expect_area(const Section& section, double expected) {
  EXPECT_NEAR(section.area_m2(), expected, 1e-9 * expected);
}

bool is_inside(const Section& section, const Vec2& at) {
  bool inside = false;
  for (const auto& loop : section.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
      if ((a.y() > at.y()) != (b.y() > at.y()) &&
          at.x() < a.x() + (at.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
        inside = !inside;
    }
  }
  return inside;
}

double length_of(const std::vector<editor::PlanLine>& lines) {
  double sum = 0.0;
  for (const auto& line : lines) sum += (line.to - line.from).norm();
  return sum;
}

// ---- sections -------------------------------------------------------------------------------------------------------

TEST(PlanSection, OfARoomWithADoorHasTheAreaOfItsWalls) {
  Editing editing;
  editing.run_all({"new", "room from 0,0 to 4,3 height 2.7 wall=0.15 name=kitchen",
                   "door in kitchen side south at 1.5 width 0.9 height 2.1"});
  const double walls = 4.3 * 3.3 - 12.0;
  expect_area(section_of(editing, 1.2), walls - 0.9 * 0.15);
  expect_area(section_of(editing, 2.4), walls);
  // The door opens the ring: one outline. Over it there are two.
  EXPECT_EQ(section_of(editing, 1.2).loops.size(), 1u);
  EXPECT_EQ(section_of(editing, 1.2).loops[0].size(), 12u);
  ASSERT_EQ(section_of(editing, 2.4).loops.size(), 2u);
  EXPECT_EQ(section_of(editing, 2.4).loops[0].size() + section_of(editing, 2.4).loops[1].size(), 8u);
}

TEST(PlanSection, OfSlopingAndRoundShapesFollowsTheHeight) {
  Editing editing;
  editing.run_all(
      {"new", "wedge from 0,0 to 2,1,0.5 high=east", "cylinder at 5,2 radius 0.4 height 2.5 sides=12"});
  // The wedge rises to the east: at a height the part beyond is solid.
  const double corner = 0.5 * 0.4 * 0.4 * std::sin(2.0 * std::numbers::pi / 12.0) * 12.0;
  for (const double height : {0.1, 0.25, 0.4}) {
    const Section section = section_of(editing, height);
    ASSERT_EQ(section.loops.size(), 2u);
    double wedge = 0.0, cylinder = 0.0;
    for (const auto& loop : section.loops) {
      Section one;
      one.loops = {loop};
      (loop[0].x() < 3.0 ? wedge : cylinder) = one.area_m2();
    }
    EXPECT_NEAR(wedge, 2.0 * 1.0 * (1.0 - height / 0.5), 1e-9) << height;
    EXPECT_NEAR(cylinder, corner, 1e-5 * corner) << height;  // its corners are rounded to the map's grid
  }
}

TEST(PlanSection, OfOverlappingBrushesIsTheirUnion) {
  Editing editing;
  editing.run_all({"new", "box from 0,0 to 4,1,2", "box from 3,0 to 4,5,2", "box from 3.5,0.5 to 6,1,1.5"});
  const Section section = section_of(editing, 1.2);
  ASSERT_EQ(section.loops.size(), 1u);
  EXPECT_EQ(section.loops[0].size(), 10u);
  expect_area(section, 4.0 + 4.0 + 2.0 * 0.5);
}

TEST(PlanSection, IsJustAboveItsHeight) {
  Editing editing;
  editing.run_all({"new", "box from 0,0 to 1,1,1.2", "box from 2,0,1.2 to 3,1,2"});
  const Section section = section_of(editing, 1.2);
  ASSERT_EQ(section.loops.size(), 1u);
  EXPECT_GE(section.bounds().min().x(), 2.0 - 1e-9);
}

/// Compares a section with the world at random places; returns how many of them are solid.
std::size_t compare_at(const map::World& world, const csg::Surface& surface, double height, int places) {
  const Section section = editor::section_at(surface, height);
  const Random random(7, stream_id("plan"));
  const Vec3 low = world.bounds.min(), high = world.bounds.max();
  std::size_t solid = 0;
  for (int i = 0; i < places; ++i) {
    const auto n = 2 * static_cast<std::uint64_t>(i);
    const double x = random.uniform(0, n, low.x(), high.x()), y = random.uniform(0, n + 1, low.y(), high.y());
    const bool expected = test::is_solid(world, {x, y, height});
    solid += expected ? 1u : 0u;
    EXPECT_EQ(is_inside(section, {x, y}), expected) << x << " " << y << " " << height;
  }
  return solid;
}

TEST(PlanSection, HasExactlyThePointsThatAreSolid) {
  Editing editing;
  editing.run_all({"new", "room from 0,0 to 6,4 height 2.7 name=hall", "door in hall side east at 2",
                   "window in hall side north at 3", "arc 2,1 1 from 0 to 180 height 2 thickness 0.2",
                   "cylinder at 4.5,2 radius 0.5 height 2.2", "wedge from 3.2,0.3 to 4.2,1,1.8 high=north",
                   "box from 4.2,1.7 to 5,2.2,3 name=cut", "subtract cut"});
  const map::World world = test::world_of(editing);
  const csg::Surface surface = csg::build_surface(world);
  std::size_t solid = 0;
  for (const double height : {0.05, 0.9, 1.2, 1.93, 2.15, 2.6})
    solid += compare_at(world, surface, height, 2000);
  EXPECT_GT(solid, 500u);
}

TEST(PlanSection, OfARealMapIsWhatIsSolidThere) {
  HALLWAY_DATA_OR_SKIP(file, "maps/id1/e1m1.map");
  const map::World world = map::build_world(map::load(file));
  const csg::Surface surface = csg::build_surface(world);
  std::size_t solid = 0;
  // Floors and ceilings of the map lie at whole units: those heights are the hard ones.
  for (const double height : {-5.0, 2.0, 2.013}) solid += compare_at(world, surface, height + 1e-7, 500);
  EXPECT_GT(solid, 30u);
}

// ---- what is below --------------------------------------------------------------------------------------------------

TEST(PlanBelow, AnEdgeIsDrawnOnceAndAsFarAsItIsSeen) {
  Editing editing;
  editing.run_all({"new", "box from 0,0 to 2,1,0.4"});
  const auto lines = [&](double height) {
    const csg::Surface surface = surface_of(editing);
    return editor::edges_below(surface, editor::PlanColumns(surface), height);
  };
  EXPECT_NEAR(length_of(lines(1.2)), 6.0, 1e-9);
  // A board over its right half: there the edges of the board are seen, two of its own and no more of the box.
  editing.run("box from 1,-1,0.7 to 3,2,0.8");
  EXPECT_NEAR(length_of(lines(1.2)), 2.0 * (2.0 + 3.0) + 1.0 + 1.0 + 1.0, 1e-9);
  // Under the board there is the box alone.
  EXPECT_NEAR(length_of(lines(0.6)), 6.0, 1e-9);
  // What is solid at the height is no edge below but at its foot: the box alone has none.
  EXPECT_NEAR(length_of(lines(0.2)), 0.0, 1e-9);
}

TEST(PlanBelow, FacesThatGoOnHaveNoEdgeBetweenThem) {
  Editing editing;
  editing.run_all({"new", "box from 0,0 to 2,1,0.4 material=wood", "box from 2,0 to 3,1,0.4 material=tile",
                   "box from 0,1 to 3,2,0.4"});
  const csg::Surface surface = surface_of(editing);
  EXPECT_NEAR(length_of(editor::edges_below(surface, editor::PlanColumns(surface), 1.2)), 10.0, 1e-9);
}

TEST(Plan, ThingsOfOtherStoreysAreLeftOut) {
  Editing editing;
  editing.run_all({"new", "room from 0,0 to 4,3 height 2.7 name=below",
                   "room from 0,0,3 to 4,3,3 height 2.7 name=above", "light at 1,1,2.5", "light at 1,1,5.5",
                   "light at 3,2,0.5", "start at 2,1,0 heading 90",
                   "path tour 0.5,0.5;3.5,0.5 corner_radius=0.2"});
  const FloorPlan ground = plan_of(editing);
  EXPECT_EQ(ground.lights.size(), 2u);
  ASSERT_EQ(ground.starts.size(), 1u);
  EXPECT_NEAR(ground.starts[0].ahead.y(), 1.0, 1e-12);
  ASSERT_EQ(ground.paths.size(), 1u);
  EXPECT_NEAR((ground.paths[0].back() - ground.paths[0].front()).norm(), 3.0, 1e-9);
  ASSERT_EQ(ground.names.size(), 1u);
  EXPECT_EQ(ground.names[0].text, "below");
  EXPECT_NEAR((ground.names[0].at - Vec2(2.0, 1.5)).norm(), 0.0, 1e-9);
  ASSERT_EQ(ground.widths.size(), 2u);
  EXPECT_NEAR((ground.widths[0].to - ground.widths[0].from).norm(), 4.0, 1e-9);
  EXPECT_NEAR((ground.widths[1].to - ground.widths[1].from).norm(), 3.0, 1e-9);
  const FloorPlan upper = plan_of(editing, 4.2);
  EXPECT_EQ(upper.lights.size(), 1u);
  EXPECT_TRUE(upper.starts.empty());
  ASSERT_EQ(upper.names.size(), 1u);
  EXPECT_EQ(upper.names[0].text, "above");
}

TEST(Plan, AWidthAvoidsTheDoors) {
  Editing editing;
  editing.run_all({"new", "room from 0,0 to 4,4 height 2.7 name=hall", "door in hall side west at 1 width 1",
                   "door in hall side south at 1 width 1", "door in hall side north at 3 width 1"});
  const FloorPlan plan = plan_of(editing);
  ASSERT_EQ(plan.widths.size(), 2u);
  for (const auto& width : plan.widths) EXPECT_NEAR((width.to - width.from).norm(), 4.0, 1e-9);
}

TEST(Plan, NamesStandWhereTheyCanBeRead) {
  Editing editing;
  editing.run_all({"new", "room from 0,0 to 8,4 height 2.7 name=hall",
                   "cylinder at 4,2 radius 0.2 height 2.7",
                   "wall from 6,0.5 to 6,3.5 height 2.7 thickness 0.2 name=screen",
                   "box from 1,1 to 2,2,0.7 name=table", "box from 1.4,1.4,0.7 to 1.6,1.6,0.9",
                   "box from 1,3 to 2,3.5,0.7 name=stool", "box from 0.5,2.5,0.8 to 2.5,3.9,0.9 name=board"});
  const FloorPlan plan = plan_of(editing);
  ASSERT_EQ(plan.names.size(), 4u);  // the stool is under the board
  EXPECT_EQ(plan.names[0].text, "hall");
  EXPECT_FALSE(plan.names[0].beside);
  EXPECT_FALSE(is_inside(plan.section, plan.names[0].at));
  EXPECT_LT((plan.names[0].at - Vec2(4.0, 2.0)).norm(), 1.0);
  EXPECT_EQ(plan.names[1].text, "screen");
  EXPECT_TRUE(plan.names[1].beside && plan.names[1].upwards);
  EXPECT_NEAR((plan.names[1].at - Vec2(5.9, 2.0)).norm(), 0.0, 1e-6);
  EXPECT_EQ(plan.names[2].text, "table");
  EXPECT_NEAR((plan.names[2].at - Vec2(1.5, 1.5)).norm(), 0.0, 1e-6);
  EXPECT_EQ(plan.names[3].text, "board");
}

TEST(Plan, WhatCannotBeDrawnIsNoted) {
  Editing editing;
  editing.run_all({"new", "box from 0,0 to 4,3,2", "entity hw_path name=lost radius=1"});
  const FloorPlan plan = plan_of(editing);
  ASSERT_EQ(plan.notes.size(), 1u);
  EXPECT_TRUE(test::mentions(plan.notes[0], "\"lost\"")) << plan.notes[0];
}

TEST(Plan, AStartThatNoPathBeginsAtIsNotedWithBothPlaces) {
  Editing editing;
  editing.run_all({"new", "room from 0,0 to 8,6", "start at 1,1,0.5", "path round 3,1,0.5;6,1,0.5;6,4,0.5"});
  FloorPlan plan = plan_of(editing);
  ASSERT_EQ(plan.notes.size(), 1u);
  for (const char* part :
       {"warning", "(1, 1, 0.5)", "`round` begins at (3, 1, 0.5)", "the start has no effect"})
    EXPECT_TRUE(test::mentions(plan.notes[0], part)) << part << "\n" << plan.notes[0];
  editing.run("path other 1,1,0.5;6,1,0.5;6,4,0.5");
  plan = plan_of(editing);
  EXPECT_TRUE(plan.notes.empty()) << plan.notes[0];
}

TEST(Plan, AHeightAtWhichNothingIsSolidIsRefused) {
  Editing editing;
  editing.run("new");
  auto error = test::error_of([&] { plan_of(editing); });
  ASSERT_TRUE(error);
  EXPECT_TRUE(test::mentions(error->what(), "nothing solid in the map")) << error->what();
  editing.run("box from 0,0,-0.5 to 4,3,2");
  error = test::error_of([&] { plan_of(editing, 2.5); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kUsage);
  EXPECT_TRUE(test::mentions(error->what(), "from -0.5 to 2 m")) << error->what();
}

// ---- the page -------------------------------------------------------------------------------------------------------

const editor::SheetLayer* layer(const Sheet& sheet, const std::string& name) {
  for (const editor::SheetLayer& one : sheet.layers) {
    if (one.name == name) return &one;
  }
  return nullptr;
}

std::vector<std::string> texts(const Sheet& sheet, const std::string& name) {
  std::vector<std::string> found;
  const auto* one = layer(sheet, name);
  for (std::size_t i = 0; one != nullptr && i < one->items.size(); ++i) {
    if (const auto* text = std::get_if<editor::SheetText>(&one->items[i])) found.push_back(text->text);
  }
  return found;
}

TEST(PlanPage, HasSizesInMetresAndATitleBlock) {
  Editing editing;
  editing.run_all({"new", "room from 0,0 to 4,3.125 height 2.7 wall=0.15 name=kitchen"});
  const Sheet sheet = editor::draw_plan(plan_of(editing), {});
  const std::vector<std::string> sizes{"4.00", "3.125", "4.30", "3.425"};
  EXPECT_EQ(texts(sheet, "dimensions"), sizes);
  EXPECT_EQ(texts(sheet, "names"), std::vector<std::string>{"kitchen"});
  const std::vector<std::string> block{
      "flat.map", "Scale 1:50 (a4)", "Cut at 1.20 m; lengths in m", "0", "2 m", "N"};
  EXPECT_EQ(texts(sheet, "title-block"), block);
  const Sheet bare = editor::draw_plan(plan_of(editing), {.dimensions = false});
  EXPECT_EQ(layer(bare, "dimensions"), nullptr);
}

TEST(PlanPage, LiesAsItFits) {
  Editing editing;
  editing.run_all({"new", "box from 0,0 to 9,3,2"});
  const FloorPlan wide = plan_of(editing);
  const Sheet lying = editor::draw_plan(wide, {});
  EXPECT_EQ(lying.width_mm, 297.0);
  EXPECT_EQ(lying.height_mm, 210.0);
  EXPECT_EQ(editor::draw_plan(wide, {.scale = 100.0}).width_mm, 297.0);
  EXPECT_EQ(editor::draw_plan(wide, {.orientation = "portrait", .scale = 100.0}).width_mm, 210.0);
  EXPECT_EQ(editor::draw_plan(wide, {.name = "letter", .scale = 100.0}).width_mm, 279.4);
  EXPECT_TRUE(test::error_of([&] { editor::draw_plan(wide, {.orientation = "portrait"}); }));
}

TEST(PlanPage, WhatDoesNotFitIsRefusedWithWhatWould) {
  Editing editing;
  editing.run_all({"new", "box from 0,0 to 30,15,2"});
  const FloorPlan plan = plan_of(editing);
  const auto error = test::error_of([&] { editor::draw_plan(plan, {}); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kUsage);
  const std::string message = error->what();
  EXPECT_TRUE(test::mentions(message, "30.00 x 15.00 m")) << message;
  EXPECT_TRUE(test::mentions(message, "600 x 300 mm at 1:50")) << message;
  EXPECT_TRUE(test::mentions(message, "paper=a1 or scale=200")) << message;
  // What it proposes does it.
  EXPECT_FALSE(test::error_of([&] { editor::draw_plan(plan, {.name = "a1"}); }));
  EXPECT_FALSE(test::error_of([&] { editor::draw_plan(plan, {.scale = 200.0}); }));
  EXPECT_TRUE(test::error_of([&] { editor::draw_plan(plan, {.name = "a2"}); }));
  EXPECT_TRUE(test::error_of([&] { editor::draw_plan(plan, {.scale = 100.0}); }));
}

TEST(PlanPage, AGridTooFineIsRefused) {
  Editing editing;
  editing.run_all({"new", "box from 0,0 to 3,2,2"});
  const FloorPlan plan = plan_of(editing);
  const Sheet sheet = editor::draw_plan(plan, {.grid_m = 0.5});
  ASSERT_NE(layer(sheet, "grid"), nullptr);
  EXPECT_EQ(layer(sheet, "grid")->items.size(), 7u + 5u);
  const auto error = test::error_of([&] { editor::draw_plan(plan, {.grid_m = 0.04}); });
  ASSERT_TRUE(error);
  EXPECT_TRUE(test::mentions(error->what(), "from 0.05 m on")) << error->what();
}

// ---- PDF, SVG -------------------------------------------------------------------------------------------------------

Sheet small_sheet() {
  Sheet sheet{.width_mm = 210.0, .height_mm = 297.0, .title = "a (b) \\ <c> & \"d\"", .layers = {}};
  editor::SheetLayer layer{.name = "all", .items = {}};
  layer.items.emplace_back(editor::SheetLine{{{10, 10}, {20, 10}}, {.dash_mm = 2.0, .gap_mm = 1.0}});
  layer.items.emplace_back(
      editor::SheetFill{{{{0, 0}, {8, 0}, {8, 8}}, {{1, 0.5}, {2, 0.5}, {2, 1}}}, {255, 0, 51}});
  layer.items.emplace_back(editor::SheetText{.at = {50, 60},
                                             .text = "K\xc3\xbc"
                                                     "che \xe2\x82\xac <script>\x01\xff"});
  sheet.layers.push_back(layer);
  return sheet;
}

TEST(Pdf, TheTableLeadsToEveryObject) {
  const std::string pdf = editor::to_pdf(small_sheet());
  EXPECT_EQ(pdf, editor::to_pdf(small_sheet()));
  EXPECT_TRUE(pdf.starts_with("%PDF-1.4\n"));
  EXPECT_TRUE(pdf.ends_with("%%EOF\n"));
  const std::size_t start = pdf.rfind("startxref\n");
  ASSERT_NE(start, std::string::npos);
  const std::string after = pdf.substr(start + 10);
  const std::size_t table = *parse_uint(after.substr(0, after.find('\n')));
  ASSERT_EQ(pdf.substr(table, 9), "xref\n0 7\n");
  const std::string entries = pdf.substr(table + 9, 7 * 20);
  EXPECT_EQ(entries.substr(0, 20), "0000000000 65535 f \n");
  for (std::size_t i = 1; i < 7; ++i) {
    const std::string entry = entries.substr(20 * i, 20);
    EXPECT_EQ(entry.substr(10), " 00000 n \n");
    const std::string digits = entry.substr(0, 10);
    const std::size_t at = static_cast<std::size_t>(std::stoull(digits));
    EXPECT_EQ(pdf.substr(at, 8), std::to_string(i) + " 0 obj\n") << i;
  }
  EXPECT_EQ(pdf.substr(table + 9 + 140, 8), "trailer\n");
  // The stream is as long as it says.
  const std::size_t length_at = pdf.find("/Length ") + 8;
  const std::size_t length = static_cast<std::size_t>(std::stoull(pdf.substr(length_at)));
  const std::size_t stream = pdf.find("stream\n") + 7;
  EXPECT_EQ(pdf.substr(stream + length, 11), "\nendstream\n");
}

TEST(Pdf, HasTheSizeOfThePaperAndLatinTexts) {
  const std::string pdf = editor::to_pdf(small_sheet());
  const std::string box = "/MediaBox [0 0 ";
  const std::string size = pdf.substr(pdf.find(box) + box.size());
  EXPECT_NEAR(std::stod(size), 595.2756, 1e-3);
  EXPECT_NEAR(std::stod(size.substr(size.find(' '))), 841.8898, 1e-3);
  EXPECT_TRUE(test::mentions(pdf,
                             "(K\\374che ? <script>?"
                             "?) Tj"));
  EXPECT_TRUE(test::mentions(pdf, "/Title (a \\(b\\) \\\\ <c> & \"d\")"));
  EXPECT_TRUE(test::mentions(pdf, "[2 1] 0 d\n10 10 m\n20 10 l\nS\n"));
  EXPECT_TRUE(test::mentions(pdf, "1 0 0.2 rg\n0 0 m\n8 0 l\n8 8 l\nh\n1 0.5 m\n2 0.5 l\n2 1 l\nh\nf*\n"));
  for (const char c : pdf) EXPECT_TRUE((c >= ' ' && c < 0x7F) || c == '\n');
}

TEST(Svg, IsInMillimetresWithTextsAsTexts) {
  const std::string svg = editor::to_svg(small_sheet());
  EXPECT_EQ(svg, editor::to_svg(small_sheet()));
  EXPECT_TRUE(test::mentions(svg, "width=\"210mm\" height=\"297mm\" viewBox=\"0 0 210 297\""));
  EXPECT_TRUE(test::mentions(svg, "<title>a (b) \\ &lt;c&gt; &amp; &quot;d&quot;</title>"));
  EXPECT_TRUE(test::mentions(svg,
                             "K\xc3\xbc"
                             "che \xe2\x82\xac &lt;script&gt;\xef\xbf\xbd\xef\xbf\xbd</text>"));
  EXPECT_TRUE(test::mentions(svg, "d=\"M10 287 L20 287\""));
  EXPECT_TRUE(test::mentions(svg,
                             "d=\"M0 297 L8 297 L8 289 ZM1 296.5 L2 296.5 L2 296 Z\" fill=\"#ff0033\" "
                             "fill-rule=\"evenodd\""));
}

TEST(SheetText, IsAsWideAsInHelvetica) {
  EXPECT_NEAR(editor::text_width_mm("", 10.0), 0.0, 1e-12);
  // 722 + 222 + 556 + 278 thousandths (Adobe's metrics of H, l, 0 and the blank).
  EXPECT_NEAR(editor::text_width_mm("Hl0 ", 10.0), 17.78, 1e-9);
  EXPECT_NEAR(editor::text_width_mm("@W~", 10.0), 10.15 + 9.44 + 5.84, 1e-9);
  EXPECT_NEAR(editor::text_width_mm("\xc3\xbc", 10.0), 5.56, 1e-9);
}

TEST(SheetNumber, HasNoExponent) {
  EXPECT_EQ(editor::sheet_number(0.0), "0");
  EXPECT_EQ(editor::sheet_number(-1e-9), "0");
  EXPECT_EQ(editor::sheet_number(1e-5), "0.00001");
  EXPECT_EQ(editor::sheet_number(1e7), "10000000");
  EXPECT_EQ(editor::sheet_number(-2.5), "-2.5");
}

}  // namespace
}  // namespace hallway
