// SPDX-License-Identifier: MIT
// Layers of a map through `hallway render`. What their pixels show: tests/unit/render/map_layers_test.cpp.
#include <gtest/gtest.h>

#include <set>

#include "cli/small_world.hpp"
#include "support/room_maps.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;

Ended render(const TempFolder& folder, const fs::path& input, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"render", input, "--out", folder / "picture.png", "--size", "480x320"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return hallway(arguments);
}

TEST(MapPictures, EachLayerIsAnotherPicture) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms());
  std::set<std::string> pictures;
  for (const char* layers :
       {"map", "portals", "pvs-from=1,1,1", "bsp-depth", "wireframe", "portals,pvs-from=1,1,1",
        "pvs-from=8,1,1,portals", "wireframe,portals", "leak"}) {
    const Ended ended = render(folder, map, {"--show", layers});
    ASSERT_EQ(ended.status, 0) << layers << ended.err;
    EXPECT_TRUE(pictures.insert(read_file(folder / "picture.png")).second)
        << layers << " is like another one";
  }
}

TEST(MapPictures, SameMapGivesTheSameBytes) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms());
  std::vector<std::string> pictures;
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(render(folder, map, {"--show", "portals,pvs-from=1,1,1", "--view", "perspective"}).status, 0);
    pictures.push_back(read_file(folder / "picture.png"));
  }
  EXPECT_EQ(pictures[0], pictures[1]);
}

TEST(MapPictures, OfARunToo) {
  const SmallWorld world;
  ASSERT_EQ(world.run({"--quiet"}).status, 0);
  for (const char* layers : {"portals", "leak,truth", "wireframe,estimate", "bsp-depth"}) {
    EXPECT_EQ(render(world.folder(), world.out(), {"--show", layers}).status, 0) << layers;
  }
}

TEST(MapPictures, UnknownLayerIsSuggested) {
  const TempFolder folder;
  const Ended ended = render(folder, folder.write("rooms.map", two_rooms()), {"--show", "map,portal"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("did you mean \"portals\""), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("pvs-from"), std::string::npos) << ended.err;
}

TEST(MapPictures, PlacesThatAreNoneAndTwoColouringsAreUsage) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms());
  for (const char* layers :
       {"pvs-from", "pvs-from=", "pvs-from=1,2", "pvs-from=1,2,portals", "bsp-depth,pvs-from=1,1,1", ""}) {
    EXPECT_EQ(render(folder, map, {"--show", layers}).status, 2) << layers;
  }
  EXPECT_FALSE(fs::exists(folder / "picture.png"));
}

TEST(MapPictures, ViewpointInSolidAndLeakingMapAreBadInput) {
  const TempFolder folder;
  const Ended solid = render(folder, folder.write("rooms.map", two_rooms()), {"--show", "pvs-from=5,1,1"});
  EXPECT_EQ(solid.status, 3);
  EXPECT_NE(solid.err.find("(5.00, 1.00, 1.00)"), std::string::npos) << solid.err;
  const Ended leaks =
      render(folder, folder.write("hole.map", two_rooms(hole())), {"--show", "pvs-from=1,1,1"});
  EXPECT_EQ(leaks.status, 3);
  EXPECT_NE(leaks.err.find("leaks"), std::string::npos) << leaks.err;
}

TEST(MapPictures, ModelThatIsMissingIsAWarning) {
  const TempFolder folder;
  const fs::path map = folder.write(
      "rooms.map", two_rooms({}, point_entity("hw_mesh", {100, 100, 0}, "\"model\" \"missing.obj\"\n")));
  const Ended ended = render(folder, map, {});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.err.find("missing.obj"), std::string::npos) << ended.err;
  EXPECT_EQ(render(folder, map, {"--strict"}).status, 3);
}

TEST(MapPictures, HelpNamesTheLayers) {
  const Ended ended = hallway({"render", "--help"});
  for (const char* word : {"portals", "pvs-from", "leak", "bsp-depth", "wireframe", "truth"}) {
    EXPECT_NE(ended.out.find(word), std::string::npos) << word;
  }
}

}  // namespace
}  // namespace hallway::test
