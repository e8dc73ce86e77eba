// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

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

TEST(Render, EmptyFileIsNoMap) {
  const SmallWorld world;
  const Ended ended = render(world, world.folder().write("empty.map", ""));
  EXPECT_EQ(ended.status, 3);
  EXPECT_NE(ended.err.find("worldspawn"), std::string::npos) << ended.err;
  EXPECT_FALSE(fs::exists(world.folder() / "picture.png"));
}

TEST(Render, UnknownLayerIsUsage) {
  const SmallWorld world;
  EXPECT_EQ(render(world, world.folder() / "small.map", {"--show", "truth,ghosts"}).status, 2);
}

}  // namespace
}  // namespace hallway::test
