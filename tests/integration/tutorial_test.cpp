// SPDX-License-Identifier: MIT
//
// Follows docs/tutorial-map.md to the letter.
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/text.hpp"
#include "support/data.hpp"
#include "support/process.hpp"
#include "support/temp_folder.hpp"

namespace hallway {
namespace {

namespace fs = std::filesystem;

/// The lines within ``` fences.
std::vector<std::string> commands_of(const std::string& page) {
  std::vector<std::string> lines;
  bool inside = false;
  for (const std::string_view line : split(page, '\n')) {
    if (line == "```") {
      inside = !inside;
    } else if (inside) {
      lines.emplace_back(line);
    }
  }
  return lines;
}

/// The lines that are indented by four blanks below a heading.
std::string indented_after(const std::string& page, const std::string& words) {
  std::string text;
  for (const std::string_view line : split(std::string_view(page).substr(page.find(words)), '\n')) {
    if (!line.empty() && !line.starts_with("    ") && !text.empty()) break;
    if (line.starts_with("    ")) text += std::string(line.substr(4)) + "\n";
    if (line.empty() && !text.empty()) text += "\n";
  }
  return text;
}

struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

Picture read_png(const fs::path& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  Picture picture;
  if (png_image_begin_read_from_file(&image, file.c_str()) == 0) return picture;
  image.format = PNG_FORMAT_RGB;
  picture.rgb.resize(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr) == 0) return {};
  picture.width = static_cast<int>(image.width);
  picture.height = static_cast<int>(image.height);
  return picture;
}

/// The share of pixels in which two pictures differ by more than a shade.
double difference(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.height != b.height || a.rgb.empty()) return 1.0;
  constexpr int kShade = 24;
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(a.rgb[i + c] - b.rgb[i + c]));
    different += most > kShade ? 1 : 0;
  }
  return 3.0 * static_cast<double>(different) / static_cast<double>(a.rgb.size());
}

class Tutorial : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    page = read_file(test::source_folder() / "docs" / "tutorial-map.md");
    folder = std::make_unique<test::TempFolder>();
    std::string script;
    for (const std::string& line : commands_of(page)) script += line + "\n";
    folder->write("flat.hwe", script);
    ended = test::hallway({"edit", "flat.map", "-f", "flat.hwe"}, folder->path());
  }
  static void TearDownTestSuite() { folder.reset(); }

  static std::string page;
  static std::unique_ptr<test::TempFolder> folder;
  static test::Ended ended;
};

std::string Tutorial::page;
std::unique_ptr<test::TempFolder> Tutorial::folder;
test::Ended Tutorial::ended;

TEST_F(Tutorial, IsShortAndWorks) {
  const auto commands = commands_of(page);
  EXPECT_GT(commands.size(), 30u);
  EXPECT_LT(commands.size(), 60u);
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.out.find("nothing is wrong"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("sealed; "), std::string::npos);
  EXPECT_NE(page.find(": " + std::to_string(commands.size()) + " commands"), std::string::npos)
      << commands.size() << " commands; the page says something else";
}

TEST_F(Tutorial, LooksAsThePageShowsIt) {
  const Picture made = read_png(*folder / "flat.png");
  const Picture shown = read_png(test::source_folder() / "renders" / "tutorial.png");
  ASSERT_FALSE(made.rgb.empty());
  EXPECT_LT(difference(made, shown), 0.005);
  // The comparison sees what it is for: the same flat without its roofless walls cut open looks different.
  const auto other = test::hallway({"edit", "flat.map", "render", "other.png", "view=perspective",
                                    "eye=-3,-6,14", "target=11,8,0", "cut=1", "width=960", "height=600"},
                                   folder->path());
  ASSERT_EQ(other.status, 0) << other.err;
  EXPECT_GT(difference(read_png(*folder / "other.png"), shown), 0.02);
}

TEST_F(Tutorial, ARobotDrivesThroughIt) {
  const fs::path scenario =
      folder->write("flat.toml", indented_after(page, "A scenario makes a robot drive the path"));
  const auto run = test::hallway({"run", scenario, "--out", *folder / "run"}, folder->path());
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err.find("stopped"), std::string::npos) << run.err;
}

/// Maps that people learn from are made by scripts that stand beside them.
TEST(EditScripts, MakeTheMapsBesideThem) {
  const fs::path maps = test::source_folder() / "maps";
  std::size_t scripts = 0;
  for (const auto& entry : fs::directory_iterator(maps)) {
    if (entry.path().extension() != ".hwe") continue;
    ++scripts;
    const test::TempFolder made;
    fs::copy(maps / "models", made / "models", fs::copy_options::recursive);
    const std::string name = entry.path().stem().string() + ".map";
    const auto ended = test::hallway({"edit", name, "-f", entry.path()}, made.path());
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(read_file(made / name), read_file(maps / name)) << name << " is not what its script makes";
  }
  EXPECT_GE(scripts, 3u);
}

TEST_F(Tutorial, MakesTheMapOfTheSameName) {
  EXPECT_EQ(read_file(*folder / "flat.map"), read_file(test::source_folder() / "maps" / "flat.map"));
}

}  // namespace
}  // namespace hallway
