// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <png.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/small_world.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;

/// Width and height as the header of a PNG file states them.
std::pair<unsigned, unsigned> png_size(const std::string& png) {
  const auto number = [&](std::size_t at) {
    unsigned value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(png.at(at + i));
    return value;
  };
  return {number(16), number(20)};
}

Ended render(const SmallWorld& world, const std::string& input, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"render", input, "--out", world.folder() / "picture.png"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return hallway(arguments);
}

TEST(Render, MapInTheSizeAskedFor) {
  const SmallWorld world;
  const Ended ended = render(world, world.folder() / "small.map", {"--view", "top", "--size", "320x200"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const std::string png = read_file(world.folder() / "picture.png");
  EXPECT_TRUE(png.starts_with("\x89PNG\r\n"));
  EXPECT_EQ(png_size(png), std::make_pair(320u, 200u));
}

TEST(Render, APictureReplacesNothingElse) {
  const SmallWorld world;
  const std::string map = world.folder() / "small.map";
  const std::string before = read_file(map);
  EXPECT_EQ(hallway({"render", map, "--out", map}).status, 2);
  EXPECT_EQ(hallway({"map", "leak", map, "--picture", map}).status, 2);
  EXPECT_EQ(hallway({"doctor", "--picture", map}).status, 2);
  EXPECT_EQ(hallway({"edit", map, "render", map}).status, 2);
  EXPECT_EQ(hallway({"edit", map, "leak", "picture=" + map}).status, 2);
  EXPECT_EQ(read_file(map), before);
}

TEST(Render, RunFromItsFolderIsThePictureTheRunMade) {
  const SmallWorld world;
  world.folder().write("small.toml", small_scenario() +
                                         "\n[[picture]]\nfile = \"top.png\"\nview = \"top\"\n"
                                         "width_px = 320\nheight_px = 200\n");
  ASSERT_EQ(world.run({"--quiet"}).status, 0);
  const Ended ended = render(world, world.out(), {"--view", "top", "--size", "320x200"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(read_file(world.folder() / "picture.png"), read_file(fs::path(world.out()) / "top.png"));
}

TEST(Render, EveryIterationIsThePictureOfThatIteration) {
  const SmallWorld world;
  const std::string size = "width_px = 320\nheight_px = 200\n";
  world.folder().write("small.toml",
                       small_scenario() + "\n[[picture]]\nfile = \"top.png\"\nevery = 25\n" + size +
                           "[[picture]]\nfile = \"eye.png\"\nview = \"camera\"\niteration = 7\n" + size);
  ASSERT_EQ(world.run({"--quiet"}).status, 0);
  const fs::path out = world.out();
  EXPECT_FALSE(fs::exists(out / "top.png"));
  EXPECT_FALSE(fs::exists(out / "top_000075.png"));
  for (const char* iteration : {"0", "25", "50"}) {
    ASSERT_EQ(render(world, out, {"--iteration", iteration, "--size", "320x200"}).status, 0);
    const std::string number = std::string(iteration).size() == 1 ? "00000" : "0000";
    EXPECT_EQ(read_file(world.folder() / "picture.png"),
              read_file(out / ("top_" + number + iteration + ".png")));
  }
  const std::vector<std::string> eye{"--view", "camera", "--iteration", "7", "--size", "320x200"};
  ASSERT_EQ(render(world, out, eye).status, 0);
  const std::string of_table = read_file(world.folder() / "picture.png");
  EXPECT_EQ(of_table, read_file(out / "eye.png"));
  fs::remove(out / "observations.csv");
  ASSERT_EQ(render(world, out, eye).status, 0);
  EXPECT_EQ(read_file(world.folder() / "picture.png"), of_table) << "the log has what the table had";
}

TEST(Render, AnIterationBeyondTheStepsOfARunIsRefused) {
  const SmallWorld world;
  world.folder().write("small.toml",
                       small_scenario() + "\n[[picture]]\nfile = \"top.png\"\niteration = 40\n");
  const Ended refused = world.run({"--steps", "40"});
  EXPECT_EQ(refused.status, 3) << "of 40 steps the last is 39";
  EXPECT_NE(refused.err.find("picture[1].iteration"), std::string::npos) << refused.err;
}

TEST(Render, IterationsThatThereAreNotAreRefused) {
  const SmallWorld world;
  ASSERT_EQ(world.run({"--quiet"}).status, 0);
  const Ended beyond = render(world, world.out(), {"--iteration", "60"});
  EXPECT_EQ(beyond.status, 2);
  EXPECT_NE(beyond.err.find("iteration 60 is beyond the last one, 59"), std::string::npos) << beyond.err;
  EXPECT_EQ(render(world, world.out(), {"--iteration", "-1"}).status, 2);
  EXPECT_EQ(render(world, world.out(), {"--iteration", "1", "--view", "panels"}).status, 2);
  EXPECT_EQ(render(world, world.folder() / "small.map", {"--iteration", "1"}).status, 2);
  EXPECT_EQ(render(world, world.folder() / "small.map", {"--view", "camera"}).status, 2);
  fs::remove(fs::path(world.out()) / "truth_poses.csv");
  const Ended untrue = render(world, world.out(), {"--iteration", "1"});
  EXPECT_EQ(untrue.status, 3);
  EXPECT_NE(untrue.err.find("has no true poses"), std::string::npos) << untrue.err;
  EXPECT_EQ(render(world, world.out(), {}).status, 0) << "other pictures need no iterations";
  EXPECT_EQ(render(world, world.out(), {"--view", "camera"}).status, 3);
}

TEST(Render, PerspectiveFromAViewpoint) {
  const SmallWorld world;
  const Ended ended =
      render(world, world.folder() / "small.map",
             {"--view", "perspective", "--eye=-5,0,3", "--target=0,5,0", "--size", "200x120", "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(nlohmann::ordered_json::parse(ended.out).at("width_px"), 200);
}

TEST(Render, SizeThatIsNoneIsUsage) {
  const SmallWorld world;
  EXPECT_EQ(render(world, world.folder() / "small.map", {"--size", "big"}).status, 2);
}

TEST(Render, SizeThatIsTooLargeIsRefusedBeforeAllocation) {
  const SmallWorld world;
  for (const char* size : {"0x0", "100000x100000"}) {
    const Ended ended = render(world, world.folder() / "small.map", {"--size", size});
    EXPECT_EQ(ended.status, 3) << size << ended.err;
    EXPECT_FALSE(fs::exists(world.folder() / "picture.png"));
  }
}

TEST(Render, UnwritablePictureKeepsNothing) {
  const SmallWorld world;
  const Ended ended =
      hallway({"render", world.folder() / "small.map", "--out", world.folder() / "no/such/folder.png"});
  EXPECT_EQ(ended.status, 3);
  EXPECT_NE(ended.err.find("folder.png"), std::string::npos);
}

TEST(Render, FolderThatIsNoRun) {
  const SmallWorld world;
  const Ended ended = render(world, world.folder().path());
  EXPECT_EQ(ended.status, 3);
  EXPECT_NE(ended.err.find("run.json"), std::string::npos) << ended.err;
}

/// What a newcomer gives first is told as what it is, not as a defective map.
TEST(Render, AScenarioIsNoMap) {
  const SmallWorld world;
  const Ended ended = render(world, world.scenario());
  EXPECT_EQ(ended.status, 3);
  EXPECT_NE(ended.err.find("neither a map nor the folder of a run"), std::string::npos) << ended.err;
}

TEST(Render, EmptyFileIsNoMap) {
  const SmallWorld world;
  const Ended ended = render(world, world.folder().write("empty.map", ""));
  EXPECT_EQ(ended.status, 3);
  EXPECT_NE(ended.err.find("worldspawn"), std::string::npos) << ended.err;
  EXPECT_FALSE(fs::exists(world.folder() / "picture.png"));
}

/// How many pixels of a picture have the colour that is the most frequent one after the background's.
double block_pixels(const fs::path& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, file.c_str()) == 0) return 0.0;
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(image));
  png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr);
  std::map<int, int> count;
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) ++count[rgb[i] << 16 | rgb[i + 1] << 8 | rgb[i + 2]];
  std::vector<int> counts;
  for (const auto& entry : count) counts.push_back(entry.second);
  std::sort(counts.rbegin(), counts.rend());
  return counts.size() < 2 ? 0.0 : counts[1];
}

TEST(Render, AreaFramesATopView) {
  const SmallWorld world;  // with a block of 1 m x 2 m around (0.5, 6)
  const auto pixels = [&](const std::string& area) {
    const Ended ended =
        render(world, world.folder() / "small.map", {"--size", "640x480", "--hide", "all", "--area=" + area});
    EXPECT_EQ(ended.status, 0) << ended.err;
    return block_pixels(world.folder() / "picture.png");
  };
  const double near = pixels("-1,4.5,2,7.5");
  EXPECT_GT(near, 5000.0);
  EXPECT_NEAR(pixels("-2.5,3,3.5,9") / near, 0.25, 0.02) << "twice as wide and as high";
  EXPECT_EQ(pixels("2,7.5,-1,4.5"), near) << "either corner may come first";
}

TEST(Render, AnAreaWithoutBrushesIsToldAsSuch) {
  const SmallWorld world;
  const Ended ended = render(world, world.folder() / "small.map", {"--area", "1000,1000,1010,1010"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_NE(ended.err.find("--area shows no brush"), std::string::npos) << ended.err;
}

TEST(Render, FovWidensAPerspective) {
  const SmallWorld world;
  const auto pixels = [&](const char* fov) {
    const Ended ended = render(world, world.folder() / "small.map",
                               {"--size", "640x480", "--hide", "all", "--view", "perspective",
                                "--eye=0.5,-4,0.5", "--target=0.5,6,0.5", "--fov", fov});
    EXPECT_EQ(ended.status, 0) << ended.err;
    return block_pixels(world.folder() / "picture.png");
  };
  const double narrow = pixels("20");
  EXPECT_GT(narrow, 2000.0);
  const double ratio = std::tan(10.0 * M_PI / 180.0) / std::tan(20.0 * M_PI / 180.0);
  EXPECT_NEAR(pixels("40") / narrow, ratio * ratio, 0.03);
}

TEST(Render, FramesThatFitNoViewAreUsage) {
  const SmallWorld world;
  const std::string map = world.folder() / "small.map";
  for (const char* area : {"1,2,3", "1,2,3,x", "0,0,0,5", "0,0,nan,5", "1,2,3,4,5", ","})
    EXPECT_EQ(render(world, map, {std::string("--area=") + area}).status, 2) << area;
  EXPECT_EQ(render(world, map, {"--area=0,0,1,1", "--view", "perspective"}).status, 2);
  EXPECT_EQ(render(world, map, {"--fov", "40"}).status, 2);
  EXPECT_EQ(render(world, map, {"--fov", "0", "--view", "perspective"}).status, 2);
}

TEST(Render, ShowAddsToTheDefaultAndHideTakesAway) {
  const SmallWorld world;
  ASSERT_EQ(world.run({"--quiet"}).status, 0);
  const auto picture = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"--size", "320x200"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = render(world, world.out(), arguments);
    EXPECT_EQ(ended.status, 0) << ended.err;
    return read_file(world.folder() / "picture.png");
  };
  const std::string usual = picture({});
  EXPECT_EQ(picture({"--hide", "submaps"}), usual) << "lines from submaps to landmarks cover all else";
  EXPECT_EQ(picture({"--show", "truth"}), usual);
  EXPECT_NE(picture({"--show", "submaps"}), usual);
  EXPECT_NE(picture({"--hide", "truth"}), usual);
  EXPECT_EQ(picture({"--hide", "all", "--show", "map,truth,estimate,landmarks,errors,frustum,walls"}), usual);
  EXPECT_EQ(render(world, world.out(), {"--show", "rooms"}).status, 2) << "a layer of a map alone";
  EXPECT_EQ(render(world, world.out(), {"--hide", "ghosts"}).status, 2);
}

TEST(Render, UnknownLayerIsUsage) {
  const SmallWorld world;
  EXPECT_EQ(render(world, world.folder() / "small.map", {"--show", "truth,ghosts"}).status, 2);
}

}  // namespace
}  // namespace hallway::test
