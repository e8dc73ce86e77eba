// SPDX-License-Identifier: MIT
//
// What the editor writes, read by a second reader that shares no code with ours.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <regex>
#include <sstream>

#include "base/error.hpp"
#include "base/file.hpp"
#include "editing.hpp"
#include "map/reader.hpp"
#include "map/writer.hpp"
#include "random_commands.hpp"
#include "support/data.hpp"
#include "support/long_mode.hpp"

namespace hallway {
namespace {

namespace fs = std::filesystem;
using test::Editing;

struct ReadFace {
  std::array<double, 9> points{};
  std::string material;
  std::array<double, 8> axes{};
};

/// Faces by brush, line by line, as an importer of Valve 220 maps would read them. Fails on a line that is none of the format's.
std::vector<std::vector<ReadFace>> second_reader(const std::string& text) {
  std::vector<std::vector<ReadFace>> brushes;
  int depth = 0;
  std::istringstream lines(text);
  static const std::regex kKey("\"((?:[^\"\\\\]|\\\\.)*)\" \"((?:[^\"\\\\]|\\\\.)*)\"");
  for (std::string line; std::getline(lines, line);) {
    if (line == "{") {
      if (++depth == 2) brushes.emplace_back();
    } else if (line == "}") {
      --depth;
    } else if (line.starts_with("( ")) {
      ReadFace face;
      std::istringstream words(line);
      std::string mark;
      for (int point = 0; point < 3; ++point) {
        words >> mark;
        for (int k = 0; k < 3; ++k) words >> face.points[static_cast<std::size_t>(3 * point + k)];
        words >> mark;
        EXPECT_EQ(mark, ")") << line;
      }
      words >> face.material;
      for (int axis = 0; axis < 2; ++axis) {
        words >> mark;
        EXPECT_EQ(mark, "[") << line;
        for (int k = 0; k < 4; ++k) words >> face.axes[static_cast<std::size_t>(4 * axis + k)];
        words >> mark;
        EXPECT_EQ(mark, "]") << line;
      }
      double rotation = 0.0, u = 0.0, v = 0.0;
      words >> rotation >> u >> v;
      EXPECT_FALSE(words.fail()) << line;
      EXPECT_EQ(depth, 2) << line;
      brushes.back().push_back(std::move(face));
    } else {
      EXPECT_TRUE(line.starts_with("//") || std::regex_match(line, kKey)) << line;
    }
  }
  EXPECT_EQ(depth, 0);
  return brushes;
}

void expect_same_planes(const std::string& text) {
  const auto read = second_reader(text);
  const map::Document document = map::parse(text, "map");
  std::size_t b = 0;
  for (const map::Entity& entity : document.entities) {
    for (const map::Brush& brush : entity.brushes) {
      ASSERT_LT(b, read.size());
      ASSERT_EQ(brush.faces.size(), read[b].size());
      for (std::size_t f = 0; f < brush.faces.size(); ++f) {
        const map::Face& face = brush.faces[f];
        for (std::size_t k = 0; k < 9; ++k)
          ASSERT_EQ(face.points[k / 3][static_cast<Eigen::Index>(k % 3)], read[b][f].points[k]);
        for (std::size_t k = 0; k < 3; ++k) {
          ASSERT_EQ(face.u_axis[static_cast<Eigen::Index>(k)], read[b][f].axes[k]);
          ASSERT_EQ(face.v_axis[static_cast<Eigen::Index>(k)], read[b][f].axes[4 + k]);
        }
        ASSERT_EQ(face.material, read[b][f].material);
      }
      ++b;
    }
  }
  ASSERT_EQ(b, read.size());
}

TEST(ValveFormat, ASecondReaderFindsTheSamePlanes) {
  std::size_t brushes = 0;
  for (std::uint64_t round = 0; round < test::sized(12u, 60u); ++round) {
    Editing editing;
    test::RandomCommands random(5000 + round);
    editing.run("new");
    for (int i = 0; i < 60; ++i) {
      try {
        editing.run(random.next(editing.session->state()));
      } catch (const Error&) {
        continue;
      }
    }
    expect_same_planes(editing.text());
    brushes += second_reader(editing.text()).size();
  }
  EXPECT_GT(brushes, 100u);
}

TEST(ValveFormat, RealMapsGoThroughTheEditorUnchanged) {
  HALLWAY_DATA_OR_SKIP(folder, "maps");
  std::vector<fs::path> maps;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".map") maps.push_back(entry.path());
  }
  std::sort(maps.begin(), maps.end());
  const std::size_t step = test::sized(maps.size() / 30 + 1, std::size_t{1});
  std::size_t opened = 0;
  for (std::size_t i = 0; i < maps.size(); i += step) {
    map::Document document;
    try {
      document = map::load(maps[i]);
    } catch (const Error&) {
      continue;  // what is no map
    }
    SCOPED_TRACE(maps[i].string());
    Editing editing;
    editing.session.reset();
    fs::copy_file(maps[i], editing.folder / "map.map");
    editing.reopen();
    const std::string text = editing.text();
    ASSERT_EQ(text, map::print(document));
    editing.run("entity light at 1,2,3 targetname=added-here");
    editing.session->save();
    editing.reopen();
    editing.run("delete added-here");
    editing.session->save();
    ASSERT_EQ(map::print(map::load(editing.folder / "map.map")), text);
    ++opened;
  }
  EXPECT_GT(opened, 10u);
}

}  // namespace
}  // namespace hallway
