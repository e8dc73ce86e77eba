// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/data.hpp"
#include "support/process.hpp"
#include "support/room_maps.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Ended map_command(const std::string& command, const fs::path& map,
                  const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"map", command, map};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return hallway(arguments);
}

/// A path along x at y = 1.5 m, 0.5 m high, between two places given in map units.
std::string path_along_x(int from, int to) {
  const auto waypoint = [](int index, int x) {
    return point_entity("hw_waypoint", {x, 150, 50},
                        "\"path\" \"way\"\n\"index\" \"" + std::to_string(index) + "\"\n");
  };
  return point_entity("hw_path", {from, 150, 50}, "\"name\" \"way\"\n") + waypoint(0, from) + waypoint(1, to);
}

bool has_finding(const Json& document, const std::string& id) {
  for (const Json& finding : document.at("findings")) {
    if (finding.at("id") == id) return true;
  }
  return false;
}

Json finding(const Json& document, const std::string& id) {
  for (const Json& found : document.at("findings")) {
    if (found.at("id") == id) return found;
  }
  ADD_FAILURE() << "no finding " << id << " in " << document.dump(1);
  return Json::object();
}

// ---- check ----------------------------------------------------------------------------------------------------------

TEST(MapCheck, GoodMapHasNothing) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms({}, path_along_x(200, 300)));
  const Ended ended = map_command("check", map, {"--strict"});
  EXPECT_EQ(ended.status, 0) << ended.out;
  EXPECT_EQ(ended.out, "0 errors, 0 warnings\n");
}

TEST(MapCheck, PathThroughTheWallSaysWhereAlongIt) {
  const TempFolder folder;
  // The wall between the rooms stands from x = 4 m to x = 6 m; the path begins at x = 1 m.
  const fs::path map = folder.write("rooms.map", two_rooms({}, path_along_x(100, 900)));
  const Ended ended = map_command("check", map, {"--json"});
  EXPECT_EQ(ended.status, 1);
  const Json found = finding(Json::parse(ended.out), "path-through-wall");
  EXPECT_EQ(found.at("severity"), "error");
  const auto message = found.at("message").get<std::string>();
  EXPECT_NE(message.find("from 3.00 m to 5.00 m"), std::string::npos) << message;
  EXPECT_NE(message.find("(4.00, 1.50, 0.50)"), std::string::npos) << message;
  EXPECT_EQ(message.find("more times"), std::string::npos) << message;
}

/// Neither end is rounded to the steps in which the path is looked at.
TEST(MapCheck, PathThroughTheWallEndsWhereTheWallDoes) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms({}, path_along_x(103, 903)));
  const Json found = finding(Json::parse(map_command("check", map, {"--json"}).out), "path-through-wall");
  const auto message = found.at("message").get<std::string>();
  EXPECT_NE(message.find("from 2.97 m to 4.97 m"), std::string::npos) << message;
}

TEST(MapCheck, WaypointInAClosetWithoutADoorIsUnreachable) {
  const TempFolder folder;
  const auto unreachable = [&](const std::string& cuts, int to_x) {
    const fs::path map = folder.write("rooms.map", two_rooms(cuts, path_along_x(100, to_x)));
    const Json document = Json::parse(map_command("check", map, {"--json"}).out);
    std::vector<std::string> messages;
    for (const Json& found : document.at("findings")) {
      if (found.at("id") == "unreachable-waypoint")
        messages.push_back(found.at("message").get<std::string>());
    }
    return messages;
  };
  const std::string closet = test::box_brush({450, 100, 0}, {550, 200, 250}, "plaster");
  const std::string door = test::box_brush({390, 120, 0}, {460, 180, 200}, "plaster");
  const auto shut = unreachable(closet, 500);
  ASSERT_EQ(shut.size(), 1u);  // the path's other end is in the start's room
  EXPECT_NE(shut.front().find("(5.00, 1.50, 0.50)"), std::string::npos) << shut.front();
  EXPECT_EQ(unreachable(closet + door, 500), std::vector<std::string>());
  // Room B is reached around two corners, though the straight way is barred.
  EXPECT_EQ(unreachable({}, 900), std::vector<std::string>());
}

TEST(MapCheck, PathThatTouchesTheFloorIsFree) {
  const TempFolder folder;
  std::string path = path_along_x(100, 300);
  for (std::size_t at = path.find(" 150 50"); at != std::string::npos; at = path.find(" 150 50")) {
    path.replace(at, 7, " 150 0");
  }
  const Ended ended = map_command("check", folder.write("rooms.map", two_rooms({}, path)), {"--json"});
  EXPECT_FALSE(has_finding(Json::parse(ended.out), "path-through-wall")) << ended.out;
}

TEST(MapCheck, RobotInSolidIsAnErrorAndALampOnlyAWarning) {
  const TempFolder folder;
  const std::string start = "\"origin\" \"200 150 20\"";
  std::string text = two_rooms();
  const fs::path lamp = folder.write("lamp.map", two_rooms({}, point_entity("light", {500, 100, 100})));
  const fs::path robot =
      folder.write("robot.map", text.replace(text.find(start), start.size(), "\"origin\" \"500 100 100\""));
  const Ended with_lamp = map_command("check", lamp, {"--json"});
  EXPECT_EQ(with_lamp.status, 0);
  EXPECT_EQ(finding(Json::parse(with_lamp.out), "occupant-in-solid").at("severity"), "warning");
  EXPECT_EQ(map_command("check", lamp, {"--strict"}).status, 1);
  const Ended with_robot = map_command("check", robot, {"--json"});
  EXPECT_EQ(with_robot.status, 1);
  EXPECT_EQ(finding(Json::parse(with_robot.out), "occupant-in-solid").at("severity"), "error");
}

TEST(MapCheck, LeakIsAWarningWithItsOpening) {
  const TempFolder folder;
  const Ended ended = map_command("check", folder.write("rooms.map", two_rooms(hole())));
  EXPECT_EQ(ended.status, 0);
  EXPECT_NE(ended.out.find("warning"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("0.50 m x 2.00 m"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("rooms.map:"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("[leak]"), std::string::npos) << ended.out;
}

TEST(MapCheck, TwoRobotStartsAreAnErrorBesideTheOthers) {
  const TempFolder folder;
  const Ended ended = map_command(
      "check", folder.write("rooms.map", two_rooms(hole(), point_entity("hw_robot_start", {100, 100, 20}))),
      {"--json"});
  EXPECT_EQ(ended.status, 1);
  const Json document = Json::parse(ended.out);
  EXPECT_TRUE(has_finding(document, "two-robot-starts")) << ended.out;
  EXPECT_TRUE(has_finding(document, "leak")) << ended.out;
  EXPECT_EQ(document.at("errors").get<std::size_t>() + document.at("warnings").get<std::size_t>(),
            document.at("findings").size());
}

TEST(MapCheck, TextsFromTheMapAreNotEchoedRaw) {
  const TempFolder folder;
  const fs::path map =
      folder.write("rooms.map", two_rooms(hole(), point_entity("light\x1b[31m", {100, 100, 100})));
  for (const char* command : {"check", "info", "leak"}) {
    const Ended ended = map_command(command, map);
    EXPECT_EQ((ended.out + ended.err).find('\x1b'), std::string::npos) << command;
  }
}

// ---- info -----------------------------------------------------------------------------------------------------------

TEST(MapInfo, CountsWhatIsThere) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms({}, point_entity("light", {100, 100, 100}) +
                                                                   point_entity("light", {100, 200, 100})));
  const Ended ended = map_command("info", map, {"--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const Json document = Json::parse(ended.out);
  EXPECT_EQ(document.at("entities").at("light"), 2);
  EXPECT_EQ(document.at("brushes").at("roles").at("add"), 1);
  EXPECT_EQ(document.at("brushes").at("roles").at("subtract"), 5);
  EXPECT_EQ(document.at("materials").at("concrete"), 6);
  EXPECT_EQ(document.at("metres_per_unit"), 0.01);
  EXPECT_EQ(document.at("points"), 0);
  EXPECT_NEAR(document.at("bounds_m").at("high")[0].get<double>(), 11.0, 1e-9);
  const Ended text = map_command("info", map);
  EXPECT_NE(text.out.find("2 light"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("12.00 x 9.00 x 5.00 m"), std::string::npos) << text.out;
}

// ---- leak -----------------------------------------------------------------------------------------------------------

TEST(MapLeak, SealedMapSaysSo) {
  const TempFolder folder;
  const Ended ended =
      map_command("leak", folder.write("rooms.map", two_rooms()), {"--pts", folder / "way.pts"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_NE(ended.out.find("sealed"), std::string::npos) << ended.out;
  EXPECT_FALSE(fs::exists(folder / "way.pts"));
}

TEST(MapLeak, TextJsonPointsAndPicture) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms(hole()));
  const Ended ended =
      map_command("leak", map, {"--json", "--pts", folder / "way.pts", "--picture", folder / "leak.png"});
  EXPECT_EQ(ended.status, 1) << ended.err;
  EXPECT_NEAR(Json::parse(ended.out).at("leak").at("opening").at("width_m").get<double>(), 0.5, 1e-6);
  EXPECT_TRUE(read_file(folder / "leak.png").starts_with("\x89PNG"));
  EXPECT_TRUE(read_file(folder / "way.pts").starts_with("200 150 20\n")) << read_file(folder / "way.pts");
  EXPECT_FALSE(fs::exists(folder / "rooms.pts"));
  const Ended text = map_command("leak", map);
  EXPECT_EQ(text.status, 1);
  EXPECT_NE(text.out.find("hw_robot_start (line "), std::string::npos) << text.out;
}

TEST(MapLeak, TwoTimesTheSameBytes) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms(hole()));
  std::vector<std::string> outputs;
  for (int i = 0; i < 2; ++i) {
    outputs.push_back(map_command("leak", map, {"--json", "--picture", folder / "leak.png"}).out);
    outputs.push_back(read_file(folder / "leak.png"));
  }
  EXPECT_EQ(outputs[0], outputs[2]);
  EXPECT_EQ(outputs[1], outputs[3]);
}

// ---- pvs and ray ----------------------------------------------------------------------------------------------------

TEST(MapPvs, OtherRoomIsHiddenAndOwnRoomVisible) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms());
  const Ended own = map_command("pvs", map, {"1,1,1", "3.5,2.5,2", "--json"});
  EXPECT_EQ(own.status, 0) << own.err;
  EXPECT_EQ(Json::parse(own.out).at("visible"), true);
  EXPECT_EQ(Json::parse(own.out).at("ray_free"), true);
  const Ended other = map_command("pvs", map, {"1,1,1", "8,1,1", "--json"});
  EXPECT_EQ(other.status, 1);
  EXPECT_EQ(Json::parse(other.out).at("visible"), false);
  EXPECT_EQ(Json::parse(other.out).at("ray_free"), false);
  EXPECT_NEAR(Json::parse(other.out).at("ray_hit_m")[0].get<double>(), 4.0, 1e-6);
  const Ended text = map_command("pvs", map, {"1,1,1", "8,1,1"});
  EXPECT_TRUE(text.out.starts_with("hidden")) << text.out;
  EXPECT_NE(text.out.find("blocked at (4.00, 1.00, 1.00)"), std::string::npos) << text.out;
}

TEST(MapPvs, PlaceInSolidAndLeakingMapAreBadInput) {
  const TempFolder folder;
  const Ended solid = map_command("pvs", folder.write("rooms.map", two_rooms()), {"1,1,1", "5,1,1"});
  EXPECT_EQ(solid.status, 3);
  EXPECT_NE(solid.err.find("TO (5.00, 1.00, 1.00)"), std::string::npos) << solid.err;
  const Ended outside = map_command("pvs", folder / "rooms.map", {"-50,1,1", "1,1,1"});
  EXPECT_EQ(outside.status, 3) << outside.err;
  const Ended leaks = map_command("pvs", folder.write("hole.map", two_rooms(hole())), {"1,1,1", "2,1,1"});
  EXPECT_EQ(leaks.status, 3);
  EXPECT_NE(leaks.err.find("leaks"), std::string::npos) << leaks.err;
}

TEST(MapRay, FirstFaceWithItsBrushAndMaterial) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms());
  const Ended ended = map_command("ray", map, {"1,1,1", "8,1,1", "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const Json hit = Json::parse(ended.out).at("hit");
  EXPECT_NEAR(hit.at("distance_m").get<double>(), 3.0, 1e-9);
  EXPECT_NEAR(hit.at("at_m")[0].get<double>(), 4.0, 1e-9);
  EXPECT_NEAR(hit.at("normal")[0].get<double>(), -1.0, 1e-12);
  EXPECT_EQ(hit.at("entity"), 1);
  EXPECT_EQ(hit.at("brush"), 0);
  EXPECT_EQ(hit.at("material"), "plaster");
  // The line of the face: it is the second of its brush.
  std::istringstream lines(read_file(map));
  std::string line;
  for (int i = 0; i < hit.at("line").get<int>(); ++i) std::getline(lines, line);
  EXPECT_TRUE(line.starts_with("( 400 0 0 ) ( 400 0 300 ) ( 400 300 0 ) plaster")) << line;
}

TEST(MapRay, ModelsAreMetAsBrushesAre) {
  const std::string office = test::source_folder() / "maps" / "office.map";
  // From above the sculpture in the hall straight down onto it, and past it.
  const auto met =
      Json::parse(hallway({"map", "ray", office, "33.447,7.879,3", "33.447,7.879,0.31", "--json"}).out)
          .at("hit");
  EXPECT_EQ(met.at("model"), "models/knot.glb");
  EXPECT_LT(met.at("distance_m").get<double>(), 2.5);
  EXPECT_GT(met.at("normal")[2].get<double>(), 0.0);
  const auto beside =
      Json::parse(hallway({"map", "ray", office, "32.5,8,3", "32.5,8,-2", "--json"}).out).at("hit");
  EXPECT_EQ(beside.at("material"), "floor_stone");
}

TEST(MapRay, FreeLineSaysSo) {
  const TempFolder folder;
  const Ended ended = map_command("ray", folder.write("rooms.map", two_rooms()), {"1,1,1", "3,1,1"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_EQ(ended.out, "free: 2.00 m\n");
}

TEST(MapRay, PlacesThatAreNoneAreUsage) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms());
  for (const char* place : {"1,1", "1,1,1,1", "a,b,c", "1,,1", "nan,1,1", "1e999,1,1"}) {
    const Ended ended = map_command("ray", map, {place, "1,1,1"});
    EXPECT_EQ(ended.status, 2) << place << ended.err;
    EXPECT_NE(ended.err.find("FROM"), std::string::npos) << ended.err;
  }
  EXPECT_EQ(map_command("ray", map, {"1,1,1"}).status, 2);
}

// ---- export ---------------------------------------------------------------------------------------------------------

TEST(MapExport, WritesEveryFormat) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms());
  for (const char* name : {"rooms.glb", "rooms.obj", "rooms.PLY"}) {
    const Ended ended = map_command("export", map, {"--out", folder / name, "--json"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_GT(Json::parse(ended.out).at("triangles").get<int>(), 20) << name;
    EXPECT_GT(fs::file_size(folder / name), 100u);
  }
  EXPECT_TRUE(read_file(folder / "rooms.glb").starts_with("glTF"));
  EXPECT_TRUE(read_file(folder / "rooms.PLY").starts_with("ply\n"));
  EXPECT_NE(read_file(folder / "rooms.obj").find("mtllib rooms.mtl"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "rooms.mtl"));
}

/// Lowest x of an OBJ file's vertices.
double lowest_x(const fs::path& obj) {
  std::istringstream text(read_file(obj));
  double lowest = 1e9;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("v ")) lowest = std::min(lowest, std::stod(line.substr(2)));
  }
  return lowest;
}

TEST(MapExport, LeavesOutTheShellUnlessAllIsAskedFor) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms());
  ASSERT_EQ(map_command("export", map, {"--out", folder / "inside.obj"}).status, 0);
  ASSERT_EQ(map_command("export", map, {"--out", folder / "all.obj", "--all"}).status, 0);
  EXPECT_NEAR(lowest_x(folder / "inside.obj"), 0.0, 1e-9);
  EXPECT_NEAR(lowest_x(folder / "all.obj"), -1.0, 1e-9);
}

/// Writes a sloping red square of 1 m with a picture of one pixel; gives the entity that places it in room A.
std::string red_square(const TempFolder& folder) {
  folder.write("square.obj",
               "mtllib square.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0.5\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 "
               "1\nusemtl red\n"
               "f 1/1 2/2 3/3 4/4\n");
  folder.write("square.mtl", "newmtl red\nKd 1 1 1\nmap_Kd red.tga\n");
  folder.write("red.tga", std::string("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x18\x20\0\0\xdc", 21));
  return point_entity("hw_mesh", {100, 100, 50}, "\"model\" \"square.obj\"\n");
}

TEST(MapLeak, PictureShowsTheModels) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms(hole(), red_square(folder)));
  const TempFolder other;
  const fs::path bare = other.write("rooms.map", two_rooms(hole()));
  for (const auto& [file, name] : {std::pair{map, "with.png"}, {bare, "without.png"}})
    EXPECT_EQ(map_command("leak", file, {"--picture", folder / name}).status, 1);
  ASSERT_EQ(hallway({"render", map, "--show", "leak", "--out", folder / "rendered.png"}).status, 0);
  EXPECT_TRUE(read_file(folder / "with.png") == read_file(folder / "rendered.png"));
  EXPECT_FALSE(read_file(folder / "with.png") == read_file(folder / "without.png"));
}

TEST(MapExport, ModelsAndTheirPictures) {
  const TempFolder folder;
  const std::string missing = point_entity("hw_mesh", {100, 100, 0}, "\"model\" \"missing.obj\"\n");
  const fs::path map = folder.write("rooms.map", two_rooms({}, red_square(folder) + missing));
  const auto exported = [&](const fs::path& file, const char* name) {
    const Ended ended = map_command("export", file, {"--out", folder / name, "--json"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    return Json::parse(ended.out);
  };
  const Json bare = exported(folder.write("bare.map", two_rooms()), "bare.obj");
  const Json obj = exported(map, "rooms.obj");
  EXPECT_EQ(obj.at("triangles").get<int>(), bare.at("triangles").get<int>() + 2);
  ASSERT_EQ(obj.at("warnings").size(), 1u);
  EXPECT_NE(obj.at("warnings")[0].get<std::string>().find("missing.obj"), std::string::npos);
  const fs::path picture = folder / "rooms_0.png";
  EXPECT_NE(std::find(obj.at("files").begin(), obj.at("files").end(), picture.string()),
            obj.at("files").end());
  EXPECT_TRUE(read_file(picture).starts_with("\x89PNG"));
  EXPECT_NE(read_file(folder / "rooms.mtl").find("map_Kd rooms_0.png"), std::string::npos);
  EXPECT_NE(read_file(folder / "rooms.obj").find("v 2 2 1\n"), std::string::npos);
  exported(map, "rooms.glb");
  EXPECT_NE(read_file(folder / "rooms.glb").find("\x89PNG"), std::string::npos);
}

TEST(MapExport, PointsOfTheFaces) {
  const TempFolder folder;
  std::string text = two_rooms();
  const std::string scale = "\"_scale\" \"0.01\"\n";
  const fs::path map = folder.write(
      "rooms.map", text.replace(text.find(scale), scale.size(), scale + "\"_points_per_m2\" \"2\"\n"));
  const Ended ended = map_command("export", map, {"--out", folder / "points.ply", "--points", "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_GT(Json::parse(ended.out).at("points").get<int>(), 50);
  const Ended none =
      map_command("export", folder.write("bare.map", two_rooms()), {"--out", folder / "p.ply", "--points"});
  EXPECT_EQ(none.status, 3);
}

TEST(MapExport, OtherEndingsAreUsage) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms());
  EXPECT_EQ(map_command("export", map, {"--out", folder / "rooms.stl"}).status, 2);
  EXPECT_EQ(map_command("export", map, {"--out", folder / "rooms.glb", "--points"}).status, 2);
  EXPECT_EQ(map_command("export", map).status, 2);
}

// ---- all of them ----------------------------------------------------------------------------------------------------

TEST(MapCommands, BadInputsAreStatusThreeWithTheFileNamed) {
  const TempFolder folder;
  const std::vector<fs::path> inputs{folder.write("empty.map", ""), folder.write("byte.map", "x"),
                                     folder.path(), "/dev/zero", folder / "missing.map"};
  const std::vector<std::vector<std::string>> commands{{"check"},
                                                       {"info"},
                                                       {"leak"},
                                                       {"pvs", "1,1,1", "2,2,2"},
                                                       {"ray", "1,1,1", "2,2,2"},
                                                       {"export", "--out", folder / "out.glb"}};
  for (const std::vector<std::string>& command : commands) {
    for (const fs::path& input : inputs) {
      const Ended ended = map_command(command[0], input, {command.begin() + 1, command.end()});
      EXPECT_EQ(ended.status, 3) << command[0] << " " << input;
      EXPECT_NE(ended.err.find(input.filename().string()), std::string::npos) << ended.err;
    }
  }
}

TEST(MapCommands, MisspeltOneIsSuggested) {
  const Ended ended = hallway({"map", "chek", "x.map"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("did you mean \"check\""), std::string::npos) << ended.err;
}

TEST(MapCommands, FailureInJsonIsADocument) {
  const Ended ended = hallway({"map", "ray", "missing.map", "1,1,1", "2,2,2", "--json"});
  EXPECT_EQ(ended.status, 3);
  EXPECT_EQ(Json::parse(ended.out).at("schema"), "hallway.error/1");
}

TEST(MapCommands, HelpHasAnExampleEach) {
  for (const char* command : {"check", "info", "leak", "pvs", "ray", "export"}) {
    const Ended ended = hallway({"map", command, "--help"});
    EXPECT_EQ(ended.status, 0);
    EXPECT_NE(ended.out.find(std::string("Example: hallway map ") + command), std::string::npos) << ended.out;
    EXPECT_NE(ended.out.find("--json"), std::string::npos) << ended.out;
  }
}

}  // namespace
}  // namespace hallway::test
