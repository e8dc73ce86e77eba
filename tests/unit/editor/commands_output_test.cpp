// SPDX-License-Identifier: MIT
//
// `print`, `export`, `import`.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "base/file.hpp"
#include "base/text.hpp"
#include "map/reader.hpp"
#include "solidity.hpp"
#include "support/errors.hpp"

namespace hallway {
namespace {

namespace fs = std::filesystem;
using test::Editing;
using test::mentions;
using test::named;
using test::refusal;

std::string in(const Editing& editing, const std::string& name) {
  return (editing.folder / name).string();
}

/// Corners of the first path of a class in an SVG, a loop after the other.
std::vector<std::vector<Vec2>> path_in(const std::string& svg, const std::string& layer) {
  std::size_t at = svg.find("<g class=\"" + layer + "\">");
  at = svg.find("<path d=\"", at) + 9;
  const std::string data = svg.substr(at, svg.find('"', at) - at);
  std::vector<std::vector<Vec2>> loops;
  for (const std::string_view part : split(data, 'M')) {
    if (part.empty()) continue;
    auto& loop = loops.emplace_back();
    for (std::string_view pair : split(part, 'L')) {
      if (const auto end = pair.find('Z'); end != std::string_view::npos) pair = pair.substr(0, end);
      const auto numbers = split(trim(pair), ' ');
      loop.emplace_back(parse_double(numbers.at(0)).value(), parse_double(numbers.at(1)).value());
    }
  }
  return loops;
}

double area_of(const std::vector<std::vector<Vec2>>& loops) {
  double twice = 0.0;
  for (const auto& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
      twice += a.x() * b.y() - a.y() * b.x();
    }
  }
  return std::abs(twice) / 2.0;
}

/// Whether Python's reader takes a file for XML; nothing is said where there is no Python.
std::optional<bool> is_xml(const std::string& file) {
  const std::string python = "python3 -c 'import sys, xml.etree.ElementTree as e; ";
  if (std::system((python + "' >/dev/null 2>&1").c_str()) != 0) return std::nullopt;
  return std::system((python + "e.parse(sys.argv[1])' '" + file + "' 2>/dev/null").c_str()) == 0;
}

std::vector<std::string> flat() {
  return {"new",
          "room from 0,0 to 4,3 height 2.7 wall=0.15 name=kitchen",
          "door in kitchen side south at 1.5",
          "box from 2,1 to 3,2,0.8 name=table",
          "light at 2,1.5,2.5",
          "start at 0.5,0.5,0 heading 45",
          "path tour 0.5,0.5;3.5,0.5;3.5,2.5 corner_radius=0.3"};
}

// ---- print ----------------------------------------------------------------------------------------------------------

TEST(Print, IsTrueToItsScale) {
  Editing editing;
  editing.run_all({"new", "wall from 0,0 to 6,0 height 2.7 thickness 0.15 name=north"});
  editing.run("print " + in(editing, "plan.svg") + " height=1.2 scale=50");
  const auto loops = path_in(read_file(editing.folder / "plan.svg"), "solid");
  ASSERT_EQ(loops.size(), 1u);
  ASSERT_EQ(loops[0].size(), 4u);
  Eigen::AlignedBox2d box;
  for (const Vec2& corner : loops[0]) box.extend(corner);
  EXPECT_NEAR(box.sizes().x(), 120.0, 1e-5);
  EXPECT_NEAR(box.sizes().y(), 3.0, 1e-5);
  editing.run("print " + in(editing, "plan.svg") + " scale=200 grid=1 dimensions=off");
  EXPECT_NEAR(area_of(path_in(read_file(editing.folder / "plan.svg"), "solid")), 30.0 * 0.75, 1e-4);
}

TEST(Print, ShowsWhatIsThere) {
  Editing editing;
  editing.run_all(flat());
  const std::string before = editing.text();
  const auto report = editing.run("print " + in(editing, "plan.svg"));
  EXPECT_EQ(editing.text(), before);
  const double solid = 4.3 * 3.3 - 12.0 - 0.9 * 0.15;
  EXPECT_NEAR(report.data["solid_m2"].get<double>(), solid, 1e-9 * solid);
  const std::string svg = read_file(editing.folder / "plan.svg");
  EXPECT_NEAR(area_of(path_in(svg, "solid")), solid * 400.0, 1e-3);
  for (const char* part :
       {">kitchen</text>", ">table</text>", ">map.map</text>", ">4.00</text>", ">3.30</text>",
        "class=\"lights\"", "class=\"start\"", "stroke-dasharray", "Scale 1:50"})
    EXPECT_TRUE(mentions(svg, part)) << part;
  EXPECT_NE(is_xml(in(editing, "plan.svg")), std::optional(false));
  EXPECT_NE(is_xml(editing.folder.write("cut.svg", svg.substr(0, svg.size() / 2)).string()),
            std::optional(true));
  // The same again gives the same bytes.
  editing.run("print " + in(editing, "again.svg"));
  EXPECT_EQ(read_file(editing.folder / "again.svg"), svg);
  editing.run("hide table");
  editing.run("print " + in(editing, "bare.svg"));
  EXPECT_FALSE(mentions(read_file(editing.folder / "bare.svg"), ">table</text>"));
}

TEST(Print, PdfDrawsTheSame) {
  Editing editing;
  editing.run_all(flat());
  editing.run("print " + in(editing, "plan.svg"));
  editing.run("print " + in(editing, "plan.PDF"));
  const std::string pdf = read_file(editing.folder / "plan.PDF");
  ASSERT_TRUE(pdf.starts_with("%PDF-1.4\n"));
  for (const char* part : {"(kitchen) Tj", "(table) Tj", "(map.map) Tj", "(4.00) Tj", "[2 1.2] 0 d"})
    EXPECT_TRUE(mentions(pdf, part)) << part;
  // Corners of the solid, y up instead of down.
  const auto loops = path_in(read_file(editing.folder / "plan.svg"), "solid");
  const double height = mentions(read_file(editing.folder / "plan.svg"), "height=\"210mm\"") ? 210.0 : 297.0;
  const std::size_t fill = pdf.rfind("rg\n", pdf.find("f*\n"));
  const std::string area = pdf.substr(fill, pdf.find("f*\n") - fill);
  const auto lines = split(area, '\n');
  ASSERT_EQ(lines.size(), 1 + loops[0].size() + 2);
  for (std::size_t i = 0; i < loops[0].size(); ++i) {
    const auto words = split(lines[i + 1], ' ');
    EXPECT_NEAR(parse_double(words.at(0)).value(), loops[0][i].x(), 1e-5);
    EXPECT_NEAR(parse_double(words.at(1)).value(), height - loops[0][i].y(), 1e-5);
  }
}

TEST(Print, ForeignTextStaysText) {
  Editing editing;
  editing.run_all({"new", "box from 0,0 to 2,1,0.5 name=table", "box from 3,0 to 4,1,2"});
  editing.run("key table \"_tb_name=<script>alert(1)</script>&\"");
  editing.run("print " + in(editing, "plan.svg"));
  const std::string svg = read_file(editing.folder / "plan.svg");
  EXPECT_FALSE(mentions(svg, "<script"));
  EXPECT_TRUE(mentions(svg, "&lt;script&gt;alert(1)&lt;/script&gt;&amp;")) << svg;
  EXPECT_NE(is_xml(in(editing, "plan.svg")), std::optional(false));
}

TEST(Print, Refuses) {
  Editing editing;
  editing.run_all({"new", "box from 0,0 to 30,10,2 name=hall"});
  const std::string svg = in(editing, "plan.svg");
  EXPECT_TRUE(mentions(refusal(editing, "print " + in(editing, "plan.png")), ".svg or .pdf"));
  EXPECT_TRUE(mentions(refusal(editing, "print " + in(editing, "plan")), ".svg or .pdf"));
  EXPECT_TRUE(mentions(refusal(editing, "print"), "file"));
  EXPECT_TRUE(mentions(refusal(editing, "print " + svg), "paper=a1 or scale=200"));
  EXPECT_TRUE(mentions(refusal(editing, "print " + svg + " height=3"), "from 0 to 2 m"));
  EXPECT_TRUE(mentions(refusal(editing, "print " + svg + " height=3kg"), "height"));
  EXPECT_TRUE(mentions(refusal(editing, "print " + svg + " scale=0"), "scale"));
  EXPECT_TRUE(mentions(refusal(editing, "print " + svg + " paper=a7"), "paper"));
  EXPECT_TRUE(mentions(refusal(editing, "print " + svg + " scale=500 grid=0.1"), "grid"));
  EXPECT_FALSE(fs::exists(svg));
}

// ---- export ---------------------------------------------------------------------------------------------------------

TEST(Export, WritesTheMapAsItIs) {
  Editing editing;
  editing.run_all(flat());
  const std::string before = editing.text();
  const auto report = editing.run("export " + in(editing, "flat.obj"));
  EXPECT_EQ(editing.text(), before);
  const std::string obj = read_file(editing.folder / "flat.obj");
  EXPECT_TRUE(fs::exists(editing.folder / "flat.mtl"));
  std::size_t faces = 0;
  Box box;
  for (const std::string_view line : split(obj, '\n')) {
    if (line.starts_with("f ")) ++faces;
    if (!line.starts_with("v ")) continue;
    const auto words = split(line, ' ');
    box.extend(Vec3(parse_double(words.at(1)).value(), parse_double(words.at(2)).value(),
                    parse_double(words.at(3)).value()));
  }
  EXPECT_EQ(faces, report.data["triangles"].get<std::size_t>());
  EXPECT_GT(faces, 20u);
  EXPECT_NEAR(box.min().x(), -0.15, 1e-9);
  EXPECT_NEAR(box.max().x(), 4.15, 1e-9);
  EXPECT_NEAR(box.max().z(), 2.85, 1e-9);
  editing.run("export " + in(editing, "flat.glb"));
  EXPECT_TRUE(read_file(editing.folder / "flat.glb").starts_with("glTF"));
  editing.run("export " + in(editing, "flat.ply"));
  EXPECT_TRUE(read_file(editing.folder / "flat.ply").starts_with("ply\n"));
}

TEST(Export, OfASealedMapHasTheOutsideOnlyWithAll) {
  Editing editing;
  editing.run_all({"new", "room from 0,0 to 4,3 height 2.7 name=cell", "light at 1,1,1"});
  EXPECT_EQ(editing.run("export " + in(editing, "in.ply")).data["triangles"], 12);
  EXPECT_EQ(editing.run("export " + in(editing, "all.ply") + " all=on").data["triangles"], 24);
}

TEST(Export, Refuses) {
  Editing editing;
  editing.run("new");
  EXPECT_TRUE(mentions(refusal(editing, "export " + in(editing, "a.glb")), "no faces"));
  EXPECT_TRUE(mentions(refusal(editing, "export " + in(editing, "a.stl")), ".glb, .obj or .ply"));
  EXPECT_TRUE(mentions(refusal(editing, "export"), "file"));
  EXPECT_TRUE(mentions(refusal(editing, "export " + in(editing, "a.glb") + " all=yes"), "all"));
}

// ---- import ---------------------------------------------------------------------------------------------------------

/// A map in inches with a brush of the world, a named group, a light and a path.
std::string other_map(const Editing& editing, const std::string& name) {
  Editing other;
  other.run_all({"new scale=0.0254", "box from 0,0 to 1,1,0.5", "box from 2,0 to 3,1,0.5 name=table",
                 "light at 0.5,0.5,2 name=lamp", "path tour 0,0;2,0 corner_radius=0.2"});
  other.session->save();
  editing.folder.write(name, read_file(other.folder / "map.map"));
  return in(editing, name);
}

TEST(Import, KeepsSizesAndGivesFreeNames) {
  Editing editing;
  editing.run_all({"new scale=0.01", "box from 10,0 to 11,1,1 name=table", "path tour 10,0;12,0"});
  const std::size_t entities = editing.session->state().entities.size();
  const auto report = editing.run("import " + other_map(editing, "kitchen.map") + " at 4,0,1");
  EXPECT_FALSE(report.data["made"].empty());
  EXPECT_NEAR(test::volume(editing), 1.0 + 0.5 + 0.5, 1e-6);
  // The world's brush is a group by the file's name.
  const auto& group = named(editing, "kitchen");
  ASSERT_EQ(group.brushes.size(), 1u);
  EXPECT_TRUE(editor::group_number(group));
  EXPECT_NE(editor::group_number(group), editor::group_number(named(editing, "table")));
  EXPECT_NE(editor::group_number(group), editor::group_number(named(editing, "table-2")));
  EXPECT_TRUE(test::is_solid(editing, {4.5, 0.5, 1.25}));
  EXPECT_TRUE(test::is_solid(editing, {6.5, 0.5, 1.25}));
  EXPECT_FALSE(test::is_solid(editing, {4.5, 0.5, 0.9}));
  const auto lamp = editor::origin_of(named(editing, "lamp"));
  ASSERT_TRUE(lamp);
  EXPECT_NEAR((*lamp * 0.01 - Vec3(4.5, 0.5, 3.0)).norm(), 0.0, 1e-6);
  // Waypoints belong to the path that came with them.
  EXPECT_NO_THROW(named(editing, "tour-2"));
  std::size_t points = 0;
  for (const auto& entity : editing.session->state().entities) {
    const std::string* path = entity->head->find("path");
    if (path != nullptr && *path == "tour-2") ++points;
  }
  EXPECT_EQ(points, 2u);
  editing.session->undo(1);
  EXPECT_EQ(editing.session->state().entities.size(), entities);
}

TEST(Import, TwiceGivesTwo) {
  Editing editing;
  editing.run("new");
  const std::string file = other_map(editing, "my map.map");
  editing.run("import \"" + file + "\"");
  editing.run("import \"" + file + "\" at 0,5");
  EXPECT_NO_THROW(named(editing, "my_map"));
  EXPECT_NO_THROW(named(editing, "my_map-2"));
  EXPECT_NEAR(test::volume(editing), 2.0, 1e-6);
  editing.run("import \"" + file + "\" name=shed at 0,9");
  EXPECT_NO_THROW(named(editing, "shed"));
}

TEST(Import, LayersBecomeGroupsAndModelsAreFollowed) {
  Editing editing;
  editing.run("new");
  fs::create_directories(editing.folder / "parts");
  const fs::path file = editing.folder.write(
      "parts/a.map",
      "{\n\"classname\" \"worldspawn\"\n}\n{\n\"classname\" \"func_group\"\n\"_tb_type\" \"_tb_layer\"\n"
      "\"_tb_name\" \"lamps\"\n\"_tb_id\" \"3\"\n\"_tb_layer_sort_index\" \"0\"\n}\n{\n\"classname\" "
      "\"light\"\n\"name\" \"lamp\"\n\"origin\" \"1 2 3\"\n\"_tb_layer\" \"3\"\n}\n{\n\"classname\" "
      "\"hw_mesh\"\n\"name\" \"chair\"\n\"model\" \"chair.obj\"\n\"origin\" \"0 0 0\"\n}\n");
  editing.run("import " + file.string());
  const auto number = editor::group_number(named(editing, "lamps"));
  ASSERT_TRUE(number);
  ASSERT_NE(named(editing, "lamp").head->find("_tb_group"), nullptr);
  EXPECT_EQ(*named(editing, "lamp").head->find("_tb_group"), *number);
  EXPECT_EQ(named(editing, "lamp").head->find("_tb_layer"), nullptr);
  EXPECT_EQ(*named(editing, "chair").head->find("model"), "parts/chair.obj");
}

TEST(Import, ASecondStartStaysOutside) {
  Editing editing;
  editing.run_all({"new", "start at 1,1"});
  editing.session->save();
  editing.folder.write("other.map", editing.text() + "{\n\"classname\" \"light\"\n\"origin\" \"1 2 3\"\n}\n");
  const auto report = editing.run("import " + in(editing, "other.map"));
  std::size_t starts = 0;
  for (const auto& entity : editing.session->state().entities)
    starts += entity->classname() == "hw_robot_start" ? 1u : 0u;
  EXPECT_EQ(starts, 1u);
  EXPECT_TRUE(mentions(report.lines.at(0), "robot start without a name is left out"));
}

TEST(Import, Refuses) {
  Editing editing;
  editing.run_all({"new", "box from 0,0 to 1,1,1 name=table"});
  const std::string before = editing.text();
  editing.folder.write("broken.map", "{\n\"classname\" \"worldspawn\"\n{\n( 1 2");
  editing.folder.write("none.map", "");
  editing.folder.write("empty.map", "{\n\"classname\" \"worldspawn\"\n}\n");
  const auto error_of = [&](const std::string& line) {
    const auto error = test::error_of([&] { editing.run(line); });
    EXPECT_TRUE(error) << line;
    EXPECT_EQ(editing.text(), before) << line;
    return error.value_or(Error(ErrorCode::kInternal, ""));
  };
  const Error broken = error_of("import " + in(editing, "broken.map"));
  EXPECT_EQ(broken.code(), ErrorCode::kBadInput);
  EXPECT_EQ(broken.where().line, 4);
  EXPECT_EQ(error_of("import " + in(editing, "none.map")).code(), ErrorCode::kBadInput);
  EXPECT_EQ(error_of("import " + in(editing, "missing.map")).code(), ErrorCode::kIo);
  EXPECT_TRUE(mentions(refusal(editing, "import " + in(editing, "empty.map")), "empty world"));
  EXPECT_TRUE(mentions(refusal(editing, "import " + other_map(editing, "o.map") + " name=table"), "table"));
  EXPECT_TRUE(mentions(refusal(editing, "import " + in(editing, "o.map") + " at 4"), "at"));
  EXPECT_TRUE(mentions(refusal(editing, "import"), "file"));
}

}  // namespace
}  // namespace hallway
