// SPDX-License-Identifier: MIT
// Plugins as a user of the command line meets them. tests/unit/host has every cause for which one cannot be run.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/small_world.hpp"
#include "support/fixture.hpp"

namespace hallway::test {
namespace {

TEST(PluginOption, IdThatDoesNotExistListsWhatWasSearchedAndFound) {
  const SmallWorld world;
  const Ended ended = world.run({"--plugin", "slam_poin"});
  EXPECT_EQ(ended.status, 4);
  for (const char* part : {"slam_poin", "slam_point", "lib/hallway/plugins"}) {
    EXPECT_NE(ended.err.find(part), std::string::npos) << part << "\n" << ended.err;
  }
}

TEST(PluginOption, FileThatDoesNotExist) {
  const SmallWorld world;
  const Ended ended = world.run({"--plugin", "./nowhere.so"});
  EXPECT_EQ(ended.status, 4);
  EXPECT_NE(ended.err.find("nowhere.so"), std::string::npos) << ended.err;
}

TEST(PluginOption, FileThatIsNotElf) {
  const SmallWorld world;
  const auto file = world.folder().write("text.so", "not a plugin\n");
  const Ended ended = world.run({"--plugin", file});
  EXPECT_EQ(ended.status, 4);
  EXPECT_NE(ended.err.find("ELF"), std::string::npos) << ended.err;
}

/// A plugin of tests/abi/fixtures.
TEST(PluginOption, FileOfAnotherAbiMajor) {
  const SmallWorld world;
  const Ended ended = world.run({"--plugin", fixture("other_abi_major")});
  EXPECT_EQ(ended.status, 4);
  EXPECT_NE(ended.err.find("ABI"), std::string::npos) << ended.err;
}

TEST(PluginFault, ExceptionInAnIterationNamesThePluginAndItsReason) {
  const SmallWorld world;
  const Ended ended =
      world.run({"--plugin", fixture("misbehaves") + ":misbehaves", "--set", "misbehaves.fault=throws"});
  EXPECT_EQ(ended.status, 5);
  EXPECT_NE(ended.err.find("misbehaves"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("iteration 0: "), std::string::npos) << ended.err;
}

TEST(PluginFault, PoseThatIsNoNumber) {
  const SmallWorld world;
  const Ended ended = world.run(
      {"--plugin", fixture("misbehaves") + ":misbehaves", "--set", "misbehaves.fault=nan_position"});
  EXPECT_EQ(ended.status, 5);
  EXPECT_NE(ended.err.find("finite"), std::string::npos) << ended.err;
}

TEST(PluginOption, ByFileIsTheSameAsById) {
  const SmallWorld world;
  ASSERT_EQ(world.run({"--quiet"}, "by-id").status, 0);
  const std::string file = binary_folder() / "lib/hallway/plugins/slam_point.so";
  ASSERT_EQ(world.run({"--quiet", "--plugin", file}, "by-file").status, 0);
  EXPECT_EQ(read_file(std::filesystem::path(world.out("by-id")) / "trajectory.tum"),
            read_file(std::filesystem::path(world.out("by-file")) / "trajectory.tum"));
}

TEST(PluginParameter, OutOfRangeIsRefused) {
  const SmallWorld world;
  const Ended ended = world.run({"--set", "slam_point.noise_m=-1"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("noise_m"), std::string::npos) << ended.err;
}

TEST(PluginParameter, IsRecordedWithItsOrigin) {
  const SmallWorld world;
  ASSERT_EQ(world.run({"--quiet", "--set", "slam_point.noise_m=0.06"}).status, 0);
  const auto manifest =
      nlohmann::ordered_json::parse(read_file(std::filesystem::path(world.out()) / "run.json"));
  bool found = false;
  for (const auto& parameter : manifest.at("plugins").at(0).at("parameters")) {
    if (parameter.at("name") != "noise_m") continue;
    found = true;
    EXPECT_EQ(parameter.at("value"), "0.06");
    EXPECT_EQ(parameter.at("origin"), "command line");
  }
  EXPECT_TRUE(found);
}

/// A parameter of the only plugin of a run, by its name.
nlohmann::json parameter_of(const std::string& folder, const std::string& name) {
  const auto manifest = nlohmann::json::parse(read_file(std::filesystem::path(folder) / "run.json"));
  for (const auto& parameter : manifest.at("plugins").at(0).at("parameters")) {
    if (parameter.at("name") == name) return parameter;
  }
  return nullptr;
}

TEST(PluginParameter, NoiseIsTakenFromTheSensor) {
  const SmallWorld world;
  for (const std::string way : {"isolated", "in-process"}) {
    std::vector<std::string> more{"--quiet", "--set", "sensor.eyes.noise_m=0.03"};
    if (way == "in-process") more.push_back("--in-process");
    ASSERT_EQ(world.run(more, way).status, 0);
    const auto noise = parameter_of(world.out(way), "noise_m");
    EXPECT_EQ(noise.at("value"), "0.03");
    EXPECT_EQ(noise.at("origin"), "sensor");
    EXPECT_EQ(parameter_of(world.out(way), "overlap").at("origin"), "default");
  }
  const auto replay = [&](const std::string& log, const std::string& name) {
    ASSERT_EQ(
        hallway({"replay", world.out("isolated") + "/" + log, "--quiet", "--out", world.out(name)}).status,
        0);
    const auto noise = parameter_of(world.out(name), "noise_m");
    EXPECT_EQ(noise.at("value"), "0.03");
    EXPECT_EQ(noise.at("origin"), "sensor");
    EXPECT_EQ(read_file(std::filesystem::path(world.out(name)) / "trajectory.tum"),
              read_file(std::filesystem::path(world.out("isolated")) / "trajectory.tum"));
  };
  replay("run.mcap", "from-mcap");
  replay("observations.csv", "from-csv");
  const std::filesystem::path alone = world.folder().path() / "alone.csv";
  std::filesystem::copy_file(world.out("isolated") + "/observations.csv", alone);
  ASSERT_EQ(
      hallway({"replay", alone.string(), "--plugin", "slam_point", "--quiet", "--out", world.out("alone")})
          .status,
      0);
  EXPECT_EQ(parameter_of(world.out("alone"), "noise_m").at("value"), "0.05") << "no sensor is known";
  EXPECT_EQ(parameter_of(world.out("alone"), "noise_m").at("origin"), "default");
}

TEST(PluginParameter, PathsAreRelativeToTheFileThatHasThem) {
  const SmallWorld world;
  std::filesystem::create_directory(world.folder().path() / "sub");
  world.folder().write("sub/model.bin", "1234567");
  world.folder().write("sub/small.toml", replaced(replaced(small_scenario(), "small.map", "../small.map"),
                                                  "name = \"slam_point\"",
                                                  "name = \"" + fixture("reads_paths") +
                                                      "\"\nparams = { model = \"model.bin\", store = "
                                                      "\"made\", label = \"a text\" }"));
  const std::string scenario = (world.folder().path() / "sub/small.toml").string();
  const Ended ended = hallway({"run", scenario, "--quiet", "--out", world.out()});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const auto model = parameter_of(world.out(), "model");
  EXPECT_EQ(model.at("value"), "model.bin");
  EXPECT_EQ(model.at("type"), "file");
  EXPECT_NE(model.at("origin").get<std::string>().find("small.toml:"), std::string::npos);
  EXPECT_EQ(parameter_of(world.out(), "label").at("value"), "a text");
  EXPECT_TRUE(std::filesystem::exists(world.folder().path() / "sub/made/made"))
      << "the plugin has written there";
  EXPECT_EQ(hallway({"run", scenario, "--quiet", "--force", "--out", world.out(), "--set",
                     "reads_paths.model=gone.bin"})
                .status,
            3);

  // A log must not choose what is read and written.
  const Ended replayed = hallway({"replay", world.out() + "/run.mcap", "--plugin", fixture("reads_paths"),
                                  "--out", world.out("replayed")});
  ASSERT_EQ(replayed.status, 0) << replayed.err;
  EXPECT_NE(replayed.err.find("reads_paths.model"), std::string::npos) << replayed.err;
  EXPECT_EQ(parameter_of(world.out("replayed"), "model").at("value"), "");
  EXPECT_EQ(parameter_of(world.out("replayed"), "label").at("value"), "a text");

  // Nor by telling a wrong type.
  const std::filesystem::path manifest = std::filesystem::path(world.out()) / "run.json";
  std::string forged = read_file(manifest);
  for (const char* type : {"\"type\": \"file\"", "\"type\": \"folder\""}) {
    ASSERT_NE(forged.find(type), std::string::npos) << forged;
    forged = replaced(forged, type, "\"type\": \"text\"");
  }
  write_file_atomically(manifest, forged);
  std::filesystem::remove_all(world.folder().path() / "sub/made");
  const Ended again = hallway({"replay", world.out() + "/observations.csv", "--plugin",
                               fixture("reads_paths"), "--out", world.out("again")});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.err.find("`model`"), std::string::npos) << again.err;
  EXPECT_EQ(parameter_of(world.out("again"), "model").at("value"), "");
  EXPECT_EQ(parameter_of(world.out("again"), "store").at("value"), "");
  EXPECT_FALSE(std::filesystem::exists(world.folder().path() / "sub/made"));
}

TEST(PluginInfo, ShowsKindsOfPaths) {
  const Ended ended = hallway({"plugin", "info", fixture("reads_paths")});
  EXPECT_EQ(ended.status, 0) << ended.err;
  for (const char* part :
       {"label = none  (text: any)", "model =   (file: is read)", "store =   (folder: is written)"})
    EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
}

TEST(PluginList, NamesEachWithItsFile) {
  const Ended ended = hallway({"plugin", "list"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_NE(ended.out.find("slam_point"), std::string::npos) << ended.out;
}

TEST(PluginList, AsJson) {
  const auto document = nlohmann::ordered_json::parse(hallway({"plugin", "list", "--json"}).out);
  EXPECT_EQ(document.at("schema"), "hallway.plugins/1");
  bool found = false;
  for (const auto& file : document.at("files")) {
    for (const auto& plugin : file.at("plugins")) {
      if (plugin.at("id") != "slam_point") continue;
      found = true;
      EXPECT_EQ(plugin.at("inputs"), nlohmann::ordered_json::array({"points"}));
    }
  }
  EXPECT_TRUE(found);
}

/// A folder of plugins of which two end the process that loads or unloads them, and one is no plugin.
void write_bad_company(const TempFolder& folder) {
  for (const char* name : {"crashes_in_static_constructor", "crashes_in_shutdown", "minimal"}) {
    std::filesystem::copy_file(fixture(name), folder / ("a_" + std::string(name) + ".so"));
  }
  folder.write("a_text.so", "text");
}

TEST(PluginList, ALibraryThatCrashesIsALineAndTheOthersAreListed) {
  const TempFolder folder;
  write_bad_company(folder);
  const Ended ended = hallway({"plugin", "list", "--plugin-path", folder.path()});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.out.find("a_crashes_in_static_constructor.so: load(): crashed with signal 6"),
            std::string::npos)
      << ended.out;
  EXPECT_NE(ended.out.find("a_crashes_in_shutdown.so: close(): crashed with signal 6"), std::string::npos)
      << ended.out;
  EXPECT_NE(ended.out.find("\n(crash) "), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("\n(not loadable) "), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("slam_point"), std::string::npos) << ended.out;
  const auto files =
      nlohmann::ordered_json::parse(hallway({"plugin", "list", "--plugin-path", folder.path(), "--json"}).out)
          .at("files");
  EXPECT_EQ(files.at(0).at("verdict").at("what"), "crash");
  EXPECT_EQ(files.at(0).at("verdict").at("call"), "close");
  EXPECT_EQ(files.at(0).at("plugins").at(0).at("id"), "minimal");
  EXPECT_EQ(files.at(1).at("verdict").at("signal"), 6);
  EXPECT_TRUE(files.at(1).at("plugins").empty());
  EXPECT_FALSE(files.at(2).contains("problem"));
  EXPECT_FALSE(files.at(3).contains("verdict")) << "it was never run";
  EXPECT_NE(hallway({"doctor", "--plugin-path", folder.path()}).out.find("crashed with signal 6"),
            std::string::npos);
}

TEST(PluginOption, AnIdIsFoundAmongLibrariesThatCrash) {
  const SmallWorld world;
  const TempFolder folder;
  write_bad_company(folder);
  std::filesystem::remove(folder / "a_crashes_in_shutdown.so");  // of the same id
  EXPECT_EQ(world.run({"--plugin", "minimal", "--plugin-path", folder.path()}).status, 0);
  EXPECT_EQ(hallway({"plugin", "info", "minimal", "--plugin-path", folder.path()}).status, 0);
  const Ended ended = world.run({"--plugin", "minimum", "--plugin-path", folder.path()}, "none");
  EXPECT_EQ(ended.status, 4);
  EXPECT_NE(ended.err.find("crashed with signal 6"), std::string::npos) << ended.err;
}

TEST(PluginInfo, OfOneThatCrashesIsAVerdict) {
  const Ended ended = hallway({"plugin", "info", fixture("crashes_in_static_constructor")});
  EXPECT_EQ(ended.status, 5);
  EXPECT_NE(ended.err.find("load(): crashed with signal 6"), std::string::npos) << ended.err;
}

TEST(PluginCheck, SaysThatAPluginLoadsHereAndWhatItNeeds) {
  const TempFolder folder;
  const std::string file = binary_folder() / "lib/hallway/plugins/slam_point.so";
  const Ended ended = hallway({"plugin", "check", file});
  EXPECT_EQ(ended.status, 0) << ended.out << ended.err;
  for (const char* part : {"libc.so.6", "hw_entry", "GLIBC_", "it will load on"}) {
    EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
  }
  const auto json = nlohmann::ordered_json::parse(hallway({"plugin", "check", file, "--json"}).out);
  EXPECT_EQ(json["schema"], "hallway.plugin_check/1");
  EXPECT_EQ(json["loads"], true);
}

TEST(PluginCheck, SaysWhyAPluginDoesNotLoadOnAnOldRobot) {
  const TempFolder folder;
  const auto profile =
      folder.write("robot.toml",
                   "schema = \"hallway.machine/1\"\nname = \"rover\"\nmachine = \"x86-64\"\nglibc = \"2.2\"\n"
                   "glibcxx = \"3.4.30\"\ncxxabi = \"1.3.13\"\nabi_major = 0\nabi_minor = 1\nlibraries = "
                   "[\"libc.so.6\"]\n");
  const std::string file = binary_folder() / "lib/hallway/plugins/slam_point.so";
  const Ended ended = hallway({"plugin", "check", file, "--profile", profile});
  EXPECT_EQ(ended.status, 1) << ended.err;
  for (const char* part : {"it will not load on rover", "needs glibc 2.", "there is 2.2",
                           "libstdc++.so.6, which is not there"}) {
    EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
  }
}

TEST(PluginCheck, FilesThatAreNoPlugins) {
  const TempFolder folder;
  const Ended text = hallway({"plugin", "check", folder.write("a.so", "text")});
  EXPECT_EQ(text.status, 1);
  EXPECT_NE(text.out.find("not an ELF file"), std::string::npos) << text.out;
  EXPECT_EQ(hallway({"plugin", "check", folder / "none.so"}).status, 4);
  EXPECT_EQ(hallway({"plugin", "check", folder.write("b.so", ""), "--profile", folder / "none.toml"}).status,
            3);
}

TEST(PluginInfo, ListsParametersWithUnitsAndRanges) {
  const Ended ended = hallway({"plugin", "info", "slam_point"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  for (const char* part : {"takes     points", "gives     pose", "noise_m = "}) {
    EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
  }
  const auto json = nlohmann::ordered_json::parse(hallway({"plugin", "info", "slam_point", "--json"}).out);
  EXPECT_EQ(json["id"], "slam_point");
  EXPECT_EQ(json["inputs"], nlohmann::ordered_json::array({"points"}));
  EXPECT_EQ(hallway({"plugin", "info", "slam_poin"}).status, 4);
}

std::string good_plugin() {
  return binary_folder() / "lib/hallway/plugins/slam_point.so";
}

TEST(PluginValidate, ListsWhatEachTestDemands) {
  const Ended ended = hallway({"plugin", "validate", "--list"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.out.find("reset-forgets "), std::string::npos) << ended.out;
  const auto json = nlohmann::ordered_json::parse(hallway({"plugin", "validate", "--list", "--json"}).out);
  EXPECT_EQ(json["schema"], "hallway.plugin_tests/1");
  EXPECT_GE(json["tests"].size(), 40u);
}

TEST(PluginValidate, PassesWhatKeepsTheRules) {
  const Ended ended =
      hallway({"plugin", "validate", good_plugin(), "--test", "reset-forgets", "--test", "stride"});
  EXPECT_EQ(ended.status, 0) << ended.out << ended.err;
  EXPECT_EQ(ended.out, "passed     reset-forgets\npassed     stride\n2 tests: 2 passed\n");
  EXPECT_EQ(ended.err, "");
}

TEST(PluginValidate, SaysWhatFailedAndHowToSeeItAgain) {
  const TempFolder folder;
  const auto file = folder / "writes_stdout.so";
  std::filesystem::create_symlink(binary_folder() / "tests/abi/fixtures/defects/defective.so", file);
  const Ended ended = hallway({"plugin", "validate", file, "--set", "bound_m=2", "--test", "silent", "--test",
                               "threads", "--seed", "9"});
  EXPECT_EQ(ended.status, 5) << ended.err;
  const std::string again =
      "again: hallway plugin validate " + file.string() + " --set bound_m=2 --test silent --seed 9\n";
  for (const std::string& part :
       {std::string("failed     silent\n"), std::string("it wrote 6 bytes to standard output\n"),
        std::string("demanded: Nothing is written"), again, std::string("2 tests: 1 passed, 1 failed\n")}) {
    EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
  }
  const auto json =
      nlohmann::ordered_json::parse(hallway({"plugin", "validate", file, "--test", "silent", "--json"}).out);
  EXPECT_EQ(json["schema"], "hallway.plugin_validate/1");
  EXPECT_EQ(json["good"], false);
  EXPECT_EQ(json["plugin"], "defective");
  EXPECT_EQ(json["counts"]["failed"], 1);
  EXPECT_EQ(json["tests"][0]["verdict"], "failed");
}

TEST(PluginValidate, RefusesWhatItCannotTest) {
  const TempFolder folder;
  EXPECT_EQ(hallway({"plugin", "validate"}).status, 2);
  EXPECT_EQ(hallway({"plugin", "validate", good_plugin(), "--test", "none"}).status, 2);
  EXPECT_EQ(hallway({"plugin", "validate", good_plugin(), "--set", "noise_m"}).status, 2);
  EXPECT_EQ(hallway({"plugin", "validate", good_plugin(), "--set", "noise_m=-1"}).status, 2);
  EXPECT_EQ(hallway({"plugin", "validate", good_plugin() + ":other"}).status, 4);
  EXPECT_EQ(hallway({"plugin", "validate", folder / "none.so"}).status, 4);
  EXPECT_EQ(hallway({"plugin", "validate", fixture("other_abi_major")}).status, 4);
  const Ended text = hallway({"plugin", "validate", folder.write("a.so", "text"), "--json"});
  EXPECT_EQ(text.status, 4);
  EXPECT_EQ(nlohmann::ordered_json::parse(text.out)["status"], 4);
}

TEST(PluginValidate, APluginThatCrashesWhenItIsLoadedIsAtFault) {
  const Ended ended = hallway({"plugin", "validate", fixture("crashes_in_init")});
  EXPECT_EQ(ended.status, 5) << ended.err;
  EXPECT_NE(ended.err.find("in init()"), std::string::npos) << ended.err;
}

TEST(PluginNew, WritesAProjectAndNothingOverIt) {
  const TempFolder folder;
  const Ended ended = hallway({"plugin", "new", "my_slam"}, folder.path());
  EXPECT_EQ(ended.status, 0) << ended.err;
  const std::string source = read_file(folder / "my_slam/my_slam.cpp");
  EXPECT_NE(source.find("class MySlam final"), std::string::npos);
  for (const char* file : {"CMakeLists.txt", "CMakePresets.json", "README.md", "my_slam.cpp"}) {
    EXPECT_EQ(read_file(folder / "my_slam" / file).find('@'), std::string::npos) << file;
  }
  const Ended again = hallway({"plugin", "new", "my_slam"}, folder.path());
  EXPECT_EQ(again.status, 3);
  EXPECT_NE(again.err.find("is there already"), std::string::npos) << again.err;
  for (const char* name : {"My", "1a", "a-b", "../a", ""}) {
    EXPECT_EQ(hallway({"plugin", "new", name, "--folder", "other"}, folder.path()).status, 2) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "other"));
}

TEST(Doctor, FindsAllThatTheTestsRunWith) {
  const TempFolder folder;
  const Ended ended = hallway({"doctor", "--picture", folder / "a.png"});
  EXPECT_EQ(ended.status, 0) << ended.out << ended.err;
  EXPECT_EQ(ended.out.find("BROKEN"), std::string::npos) << ended.out;
  EXPECT_TRUE(read_file(folder / "a.png").starts_with("\x89PNG"));
  const auto json = nlohmann::ordered_json::parse(hallway({"doctor", "--json"}).out);
  EXPECT_EQ(json["good"], true);
  EXPECT_EQ(json["checks"].size(), 8u);
}

TEST(Doctor, SaysWhatIsNotThere) {
  const TempFolder folder;
  folder.write("bad.so", "text");
  const Ended ended = hallway({"doctor", "--plugin-path", folder.path()});
  EXPECT_NE(ended.out.find("lacking  plugins"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("not an ELF file"), std::string::npos) << ended.out;
}

}  // namespace
}  // namespace hallway::test
