// SPDX-License-Identifier: MIT
// The link rules of docs/architecture.md, read off the include lines.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "base/file.hpp"
#include "support/data.hpp"

namespace hallway {
namespace {

namespace fs = std::filesystem;

/// What each folder may include besides itself and the standard library.
const std::map<std::string, std::set<std::string>> kAllowed{
    {"geometry", {}},
    {"engine/base", {}},
    {"engine/image", {"base"}},
    {"engine/geom", {"geometry", "base"}},
    {"engine/map", {"base", "geometry", "geom"}},
    {"engine/csg", {"base", "geometry", "geom", "map"}},
    {"engine/bsp", {"base", "geometry", "geom", "map", "csg"}},
    {"engine/pvs", {"base", "geometry", "geom", "bsp"}},
    {"engine/trace", {"base", "geometry", "geom"}},
    {"engine/mesh", {"base", "image", "geometry", "geom", "map"}},
    {"engine/world", {"base", "geometry", "geom", "map", "csg", "bsp", "pvs", "mesh"}},
    {"engine/sense", {"base", "geometry", "geom", "map", "csg", "bsp", "pvs", "trace", "mesh", "world"}},
    {"engine/host", {"base", "hallway"}},
    {"engine/conformance", {"base", "host", "hallway"}},
    {"engine/sim",
     {"base", "geometry", "geom", "map", "csg", "bsp", "pvs", "trace", "mesh", "world", "sense", "host"}},
    {"engine/log", {"base"}},
    {"engine/record", {"base", "host", "log", "hallway"}},
    {"engine/link", {"base", "host", "hallway"}},
    {"engine/foxglove", {"base", "geometry", "geom", "host", "log", "hallway"}},
    {"engine/import", {"base", "image", "geometry", "geom", "host", "log", "hallway"}},
    {"engine/eval", {"base", "geometry", "geom", "log"}},
    {"engine/render", {"base", "image", "geometry", "geom", "map", "csg", "bsp", "mesh", "world"}},
    {"engine/planes", {"base", "image", "geometry", "geom", "host", "log", "import", "render", "hallway"}},
    {"engine/run",
     {"base",  "geometry", "geom", "map", "csg",    "bsp",  "pvs",      "trace", "mesh",   "world",
      "sense", "sim",      "host", "log", "record", "link", "foxglove", "eval",  "render", "hallway"}},
    {"engine/batch", {"base"}},
    {"engine/study",
     {"base", "geometry", "geom", "map",    "csg",  "bsp",    "pvs",  "trace",  "mesh", "world", "sense",
      "sim",  "host",     "log",  "record", "link", "import", "eval", "render", "run",  "batch", "hallway"}},
    {"editor",
     {"base", "image", "geometry", "geom", "map", "csg", "bsp", "pvs", "trace", "mesh", "world", "sense",
      "sim", "eval", "render", "run"}},
    {"robot", {"base", "host", "log", "record", "link", "hallway"}},
    {"loaders", {"base", "geometry", "geom", "mesh", "import"}},
    {"plugins/em/core", {"geometry", "em"}},
    {"plugins/slam_point/core", {"geometry", "slam_point"}},
    {"plugins/slam_plane/core", {"geometry", "slam_plane"}},
    {"plugins/slam_plane/thesis", {"geometry", "slam_plane"}},
    {"plugins/slam_plane/spatial", {"geometry", "slam_plane"}},
    {"plugins/icp/core", {"geometry", "icp"}},
    // Of plugins, the algorithm that a command has too; never what makes a plugin of it.
    {"cli", {"base",  "geometry", "geom",  "map",    "csg",  "bsp",        "pvs",
             "trace", "mesh",     "world", "sense",  "sim",  "host",       "conformance",
             "log",   "record",   "link",  "import", "eval", "render",     "planes",
             "run",   "batch",    "study", "editor", "icp",  "slam_point", "hallway"}},
};

const std::set<std::string> kLibraries{
    "base",        "image", "geom",   "map",   "csg",    "bsp",     "pvs",    "trace",      "mesh",
    "world",       "sense", "sim",    "host",  "log",    "planes",  "record", "link",       "foxglove",
    "import",      "eval",  "render", "run",   "editor", "hallway", "robot",  "slam_point", "slam_plane",
    "conformance", "em",    "icp",    "batch", "study",  "geometry"};

struct Include {
  fs::path file;
  std::string target;
};

std::vector<Include> includes_of(const fs::path& folder) {
  static const std::regex kLine("^\\s*#\\s*include\\s*[<\"]([^>\"]+)[>\"]");
  std::vector<Include> includes;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".hpp" && extension != ".cpp" && extension != ".h" && extension != ".c") continue;
    std::istringstream text(read_file(entry.path()));
    std::string line;
    std::smatch match;
    while (std::getline(text, line)) {
      if (std::regex_search(line, match, kLine)) includes.push_back({entry.path(), match[1]});
    }
  }
  return includes;
}

TEST(Layout, NoFolderIncludesWhatStandsToItsRight) {
  for (const auto& [folder, allowed] : kAllowed) {
    const auto includes = includes_of(test::source_folder() / folder);
    EXPECT_FALSE(includes.empty()) << folder;
    const std::string own = fs::path(folder).filename().string();
    for (const Include& include : includes) {
      const std::string library = include.target.substr(0, include.target.find('/'));
      if (library == own || !kLibraries.contains(library) || include.target.find('/') == std::string::npos)
        continue;
      EXPECT_TRUE(allowed.contains(library)) << include.file.string() << " includes " << include.target;
    }
  }
}

TEST(Layout, EachHeavyLibraryIsIncludedByOneFile) {
  std::map<std::string, std::set<std::string>> users;
  for (const char* folder : {"geometry", "engine", "editor", "loaders", "cli", "robot", "plugins", "sdk"}) {
    for (const Include& include : includes_of(test::source_folder() / folder)) {
      if (include.target.starts_with("embree")) users["Embree"].insert(include.file.string());
      if (include.target.starts_with("CLI/")) users["CLI11"].insert(include.file.string());
      if (include.target.starts_with("EGL/")) users["EGL"].insert(include.file.string());
      if (include.target.starts_with("GL/")) users["OpenGL"].insert(include.file.string());
      if (include.target.starts_with("toml++/")) users["toml++"].insert(include.file.string());
      if (include.target.starts_with("assimp/")) users["assimp"].insert(include.file.stem().string());
      if (include.target == "tiny_gltf.h") users["tinygltf"].insert(include.file.string());
      if (include.target == "muParser.h") users["muParser"].insert(include.file.string());
      if (include.target.starts_with("editline/")) users["libedit"].insert(include.file.string());
      if (include.target == "zstd.h") users["zstd"].insert(include.file.string());
      if (include.target.starts_with("google/protobuf/") || include.target.ends_with(".pb.h"))
        users["Protobuf"].insert(include.file.string());
      if (include.target.starts_with("rosbag/")) users["ROS"].insert(include.file.string());
      if (include.target == "png.h") users["libpng"].insert(include.file.parent_path().string());
      if (include.target == "gmp.h") users["GMP"].insert(include.file.string());
    }
  }
  for (const char* library : {"CLI11", "Embree", "EGL", "OpenGL", "toml++", "assimp", "tinygltf", "GMP",
                              "muParser", "libpng", "libedit", "zstd", "Protobuf", "ROS"}) {
    EXPECT_EQ(users[library].size(), 1u) << library;
  }
}

TEST(Layout, PluginsIncludeNothingOfTheEngine) {
  for (const Include& include : includes_of(test::source_folder() / "plugins")) {
    const std::string library = include.target.substr(0, include.target.find('/'));
    EXPECT_FALSE(fs::is_regular_file(test::source_folder() / "engine" / include.target))
        << include.file.string() << " includes " << include.target;
    EXPECT_NE(library, "base") << include.file.string();
  }
}

TEST(Layout, EveryLibraryHasAShortReadme) {
  for (const auto& entry : fs::directory_iterator(test::source_folder() / "engine")) {
    if (!entry.is_directory()) continue;
    const fs::path readme = entry.path() / "README.md";
    ASSERT_TRUE(fs::exists(readme)) << readme;
    const std::string text = read_file(readme);
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 40) << readme;
  }
}

TEST(Layout, EverySourceFileNamesItsLicence) {
  for (const char* folder :
       {"geometry", "engine", "loaders", "cli", "robot", "plugins", "sdk", "tests", "bench"}) {
    for (const auto& entry : fs::recursive_directory_iterator(test::source_folder() / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".hpp" && extension != ".cpp" && extension != ".h" && extension != ".c") continue;
      EXPECT_TRUE(read_file(entry.path()).starts_with("// SPDX-License-Identifier: MIT\n")) << entry.path();
    }
  }
}

}  // namespace
}  // namespace hallway
