// SPDX-License-Identifier: MIT
//
// What draws pictures: each renderer by itself, both against each other, and all else without any.
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/text.hpp"
#include "cli/small_world.hpp"
#include "support/data.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kOsmesa = "libOSMesa";
constexpr const char* kEgl = "libEGL";
constexpr const char* kAll = "libOSMesa:libEGL";

fs::path shim() {
  return binary_folder() / "tests" / "libhidden_libraries.so";
}

/// The test's environment without a choice of renderer, and more.
std::vector<std::string> environment(const std::vector<std::string>& more = {}) {
  std::vector<std::string> variables = more;
  for (char** entry = ::environ; *entry != nullptr; ++entry) {
    if (!std::string(*entry).starts_with("HALLWAY_RENDERER=")) variables.emplace_back(*entry);
  }
  return variables;
}

/// `hallway` on a machine where these libraries are not installed.
Ended without(const std::string& libraries, const std::vector<std::string>& arguments,
              const fs::path& folder = {}) {
  return hallway(arguments, folder,
                 environment({"LD_PRELOAD=" + shim().string(), "HIDDEN_LIBRARIES=" + libraries}));
}

/// What doctor says of a check: "ok", "lacking" or "BROKEN", and its text.
std::array<std::string, 2> examined(const Ended& doctor, const std::string& name) {
  const json document = json::parse(doctor.out);
  for (const json& check : document["checks"]) {
    if (check["name"] == name) return {check["health"].get<std::string>(), check["text"].get<std::string>()};
  }
  throw std::runtime_error("doctor does not look at " + name);
}

/// Why this machine cannot show what a renderer does; empty where it can.
std::string missing(const std::string& renderer) {
  const auto [health, text] = examined(hallway({"doctor", "--json"}, {}, environment()), renderer);
  return health == "ok" ? "" : renderer + " is not installed: " + text;
}

#define SKIP_WITHOUT(renderer) \
  if (const std::string why = missing(renderer); !why.empty()) GTEST_SKIP() << why

#define SKIP_WITHOUT_SHIM() \
  if (!fs::exists(shim())) GTEST_SKIP() << "libraries cannot be hidden from a program with sanitizers"

struct Pixels {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

Pixels read_png(const fs::path& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, file.c_str()) == 0) return {};
  image.format = PNG_FORMAT_RGB;
  Pixels pixels{image.width, image.height, std::vector<std::uint8_t>(PNG_IMAGE_SIZE(image))};
  png_image_finish_read(&image, nullptr, pixels.rgb.data(), 0, nullptr);
  return pixels;
}

/// The share of pixels of which a colour differs by more than 8 of 255; 1 for pictures of different sizes.
double share_that_differs(const Pixels& a, const Pixels& b) {
  if (a.rgb.empty() || a.width != b.width || a.height != b.height) return 1.0;
  std::size_t differing = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(a.rgb[i + c] - b.rgb[i + c]));
    differing += most > 8 ? 1 : 0;
  }
  return static_cast<double>(3 * differing) / static_cast<double>(a.rgb.size());
}

/// The share of pixels that are not of the colour of the corner.
double share_that_is_drawn(const Pixels& picture) {
  Pixels blank = picture;
  for (std::size_t i = 0; i < blank.rgb.size(); ++i) blank.rgb[i] = picture.rgb[i % 3];
  return share_that_differs(picture, blank);
}

std::string map_file(const std::string& name) {
  return source_folder() / "maps" / name;
}

/// Commands that draw into FILE, of several kinds of picture.
std::vector<std::vector<std::string>> drawings() {
  const auto render = [](const std::string& map, const std::vector<std::string>& more) {
    std::vector<std::string> command{"render", map_file(map), "--out", "FILE", "--size", "480x300"};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  };
  return {render("office.map", {}),
          render("office.map", {"--view", "perspective"}),
          render("many_planes.map", {"--view", "perspective"}),
          render("spatial_rooms.map", {"--view", "perspective", "--eye", "3,2,1.5", "--target", "0,0,1"}),
          render("regress/two_rooms_one_window.map", {"--show", "portals,bsp-depth"}),
          {"map", "leak", map_file("regress/leak_gap_1mm.map"), "--picture", "FILE"},
          {"edit", "rooms.map", "render", "FILE", "view=perspective", "width=480", "height=300"}};
}

/// Runs a drawing command. @param renderer  what --renderer names; none where empty
Ended draw(std::vector<std::string> command, const fs::path& file, const std::string& renderer) {
  std::replace(command.begin(), command.end(), std::string("FILE"), file.string());
  if (!renderer.empty()) {
    const auto at =
        command.begin() + (command[0] == "edit" ? 1 : static_cast<std::ptrdiff_t>(command.size()));
    command.insert(at, {"--renderer", renderer});
  }
  return hallway(command, file.parent_path(), environment());
}

/// Writes the map that `drawings()` edits.
void write_rooms(const TempFolder& folder) {
  fs::copy_file(map_file("regress/two_rooms_one_window.map"), folder / "rooms.map");
}

TEST(Renderer, BothDrawTheSame) {
  SKIP_WITHOUT("osmesa");
  SKIP_WITHOUT("egl");
  const TempFolder folder;
  write_rooms(folder);
  for (const auto& command : drawings()) {
    const std::string what = command[0] + " " + command[1] + " " + command[2];
    std::array<Pixels, 2> pictures;
    for (std::size_t i = 0; i < 2; ++i) {
      const fs::path file = folder / (i == 0 ? "osmesa.png" : "egl.png");
      const Ended ended = draw(command, file, i == 0 ? "osmesa" : "egl");
      ASSERT_LE(ended.status, 1) << what << ended.err;
      pictures[i] = read_png(file);
    }
    ASSERT_FALSE(pictures[0].rgb.empty()) << what;
    EXPECT_GT(share_that_is_drawn(pictures[0]), 0.05) << what;
    EXPECT_LE(share_that_differs(pictures[0], pictures[1]), 0.01) << what;
  }
}

TEST(Renderer, EachDrawsTheSameBytesAgain) {
  const TempFolder folder;
  write_rooms(folder);
  std::size_t tried = 0;
  for (const char* renderer : {"osmesa", "egl"}) {
    if (!missing(renderer).empty()) continue;
    ++tried;
    ASSERT_EQ(draw(drawings()[3], folder / "a.png", renderer).status, 0);
    ASSERT_EQ(draw(drawings()[3], folder / "b.png", renderer).status, 0);
    EXPECT_EQ(read_file(folder / "a.png"), read_file(folder / "b.png")) << renderer;
  }
  if (tried == 0) GTEST_SKIP() << "neither OSMesa nor EGL is installed";
}

/// With one library alone every kind of picture is drawn, without a word about renderers on the command line.
void expect_all_pictures_without(const char* hidden) {
  const SmallWorld world;
  const fs::path folder = world.folder().path();
  write_rooms(world.folder());
  const auto all = drawings();
  for (auto command : {all[3], all[5], all[6]}) {
    const fs::path file = folder / "picture.png";
    fs::remove(file);
    std::replace(command.begin(), command.end(), std::string("FILE"), file.string());
    const Ended ended = without(hidden, command, folder);
    EXPECT_LE(ended.status, 1) << command[1] << ended.err;
    EXPECT_GT(share_that_is_drawn(read_png(file)), 0.05) << command[1] << ended.err;
  }
  world.folder().write(
      "small.toml", small_scenario() + "[[picture]]\nfile = \"top.png\"\nwidth_px = 320\nheight_px = 200\n");
  const Ended run = without(hidden, {"run", world.scenario(), "--out", world.out(), "--json"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(json::parse(run.out)["missing_pictures"], json::array());
  EXPECT_TRUE(fs::exists(fs::path(world.out()) / "top.png"));
  const Ended compared =
      without(hidden, {"compare", world.scenario(), "--plugin", "slam_point", "--out", world.out("c")});
  EXPECT_EQ(compared.status, 0) << compared.err;
  EXPECT_TRUE(fs::exists(fs::path(world.out("c")) / "comparison.png")) << compared.err;
}

TEST(Renderer, EglAloneDrawsAll) {
  SKIP_WITHOUT_SHIM();
  SKIP_WITHOUT("egl");
  expect_all_pictures_without(kOsmesa);
}

TEST(Renderer, OsmesaAloneDrawsAll) {
  SKIP_WITHOUT_SHIM();
  SKIP_WITHOUT("osmesa");
  expect_all_pictures_without(kEgl);
}

TEST(Renderer, UnknownNameIsRefused) {
  const SmallWorld world;
  const fs::path map = world.folder() / "small.map", picture = world.folder() / "a.png";
  const std::vector<std::vector<std::string>> commands{
      {"render", map, "--out", picture},
      {"run", world.scenario(), "--out", world.out()},
      {"map", "leak", map},
      {"edit", map, "validate"},
      {"doctor"},
      {"compare", world.scenario(), "--plugin", "slam_point"},
      {"batch", "plan.toml"}};
  for (const auto& command : commands) {
    for (const char* name : {"vulkan", "EGL", ""}) {
      std::vector<std::string> arguments = command;
      arguments.insert(arguments.begin() + (command[0] == "map" ? 2 : 1), {"--renderer", name});
      const Ended ended = hallway(arguments, world.folder().path(), environment());
      EXPECT_EQ(ended.status, 2) << command[0] << ended.err;
      if (*name == '\0') continue;  // "the value is empty"
      for (const char* known : {"auto", "osmesa", "egl"})
        EXPECT_NE(ended.err.find(known), std::string::npos) << ended.err;
    }
    const Ended ended = hallway(command, world.folder().path(), environment({"HALLWAY_RENDERER=vulkan"}));
    EXPECT_EQ(ended.status, 2) << command[0] << ended.err;
    EXPECT_NE(ended.err.find("HALLWAY_RENDERER: there is no renderer \"vulkan\""), std::string::npos)
        << ended.err;
  }
  EXPECT_FALSE(fs::exists(picture));
  EXPECT_FALSE(fs::exists(world.out()));
}

TEST(Renderer, CommandLineOverridesTheEnvironment) {
  SKIP_WITHOUT_SHIM();
  SKIP_WITHOUT("osmesa");
  const SmallWorld world;
  const std::vector<std::string> command{"render", world.folder() / "small.map", "--out",
                                         world.folder() / "a.png"};
  const auto hidden = environment(
      {"LD_PRELOAD=" + shim().string(), std::string("HIDDEN_LIBRARIES=") + kEgl, "HALLWAY_RENDERER=egl"});
  EXPECT_EQ(hallway(command, {}, hidden).status, 3);
  std::vector<std::string> named = command;
  named.insert(named.end(), {"--renderer", "osmesa"});
  EXPECT_EQ(hallway(named, {}, hidden).status, 0);
}

TEST(Renderer, MissingOneNamesLibrariesAndPackages) {
  SKIP_WITHOUT_SHIM();
  const SmallWorld world;
  const std::vector<std::string> command{"render", world.folder() / "small.map", "--out",
                                         world.folder() / "a.png"};
  const auto expect_words = [&](const std::string& renderer, const std::vector<std::string>& words) {
    std::vector<std::string> arguments = command;
    if (!renderer.empty()) arguments.insert(arguments.end(), {"--renderer", renderer});
    const Ended ended = without(kAll, arguments);
    EXPECT_EQ(ended.status, 3) << ended.err;
    for (const std::string& word : words)
      EXPECT_NE(ended.err.find(word), std::string::npos) << word << ended.err;
  };
  expect_words("osmesa", {"libOSMesa.so.8", "libOSMesa.so.6", "libosmesa6"});
  expect_words("egl", {"libEGL.so.1", "libegl1", "libgl1-mesa-dri"});
  expect_words("", {"libOSMesa.so.8", "libosmesa6", "libEGL.so.1", "libegl1"});
  EXPECT_FALSE(fs::exists(world.folder() / "a.png"));
}

TEST(Renderer, WithoutAnyDoctorAndVersionStart) {
  SKIP_WITHOUT_SHIM();
  EXPECT_EQ(without(kAll, {"--version"}).status, 0);
  const Ended doctor = without(kAll, {"doctor", "--json"});
  EXPECT_EQ(doctor.status, 0) << doctor.err;
  EXPECT_EQ(json::parse(doctor.out)["good"], true);
  for (const char* name : {"osmesa", "egl", "picture"})
    EXPECT_EQ(examined(doctor, name)[0], "lacking") << name;
  const Ended named = without(kAll, {"doctor", "--json", "--renderer", "egl"});
  EXPECT_EQ(named.status, 1) << named.err;
  EXPECT_EQ(examined(named, "picture")[0], "BROKEN");
}

TEST(Renderer, WithoutAnyRunKeepsItsResults) {
  SKIP_WITHOUT_SHIM();
  const SmallWorld world;
  world.folder().write("small.toml", small_scenario() +
                                         "[[picture]]\nfile = \"top.png\"\n[[picture]]\n"
                                         "file = \"side.png\"\nview = \"perspective\"\n");
  const Ended ended = without(kAll, {"run", world.scenario(), "--out", world.out(), "--json"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.err.find("top.png, side.png: no picture can be drawn"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("libosmesa6"), std::string::npos) << ended.err;
  const json document = json::parse(ended.out);
  EXPECT_EQ(document["pictures"], json::array());
  ASSERT_EQ(document["missing_pictures"].size(), 2u);
  EXPECT_EQ(document["missing_pictures"][0]["file"], "top.png");
  EXPECT_GT(document["metrics"]["landmarks_mapped"], 0);
  const fs::path folder = world.out();
  EXPECT_EQ(json::parse(read_file(folder / "run.json"))["missing_pictures"], document["missing_pictures"]);
  for (const char* file : {"run.mcap", "landmarks.csv", "metrics.json", "trajectory.tum"})
    EXPECT_TRUE(fs::exists(folder / file)) << file;
  EXPECT_FALSE(fs::exists(folder / "top.png"));

  // The same run with a renderer differs in nothing else.
  ASSERT_EQ(world.run({"--quiet"}, "with").status, 0);
  for (const char* file : {"landmarks.csv", "trajectory.tum", "observations.csv"})
    EXPECT_EQ(read_file(folder / file), read_file(fs::path(world.out("with")) / file)) << file;
}

TEST(Renderer, NamedOneIsAskedForBeforeTheRun) {
  SKIP_WITHOUT_SHIM();
  const SmallWorld world;
  const std::vector<std::string> run{"run", world.scenario(), "--out", world.out(), "--renderer",
                                     "egl", "--quiet"};
  EXPECT_EQ(without(kAll, run).status, 0) << "a scenario without pictures needs none";
  world.folder().write(
      "small.toml", small_scenario() + "[[picture]]\nfile = \"top.png\"\nwidth_px = 320\nheight_px = 200\n");
  std::vector<std::string> other = run;
  other[3] = world.out("other");
  const Ended ended = without(kAll, other);
  EXPECT_EQ(ended.status, 3);
  EXPECT_NE(ended.err.find("libEGL.so.1"), std::string::npos) << ended.err;
  EXPECT_FALSE(fs::exists(world.out("other")));
}

TEST(Renderer, WithoutAnyMapsAreEditedAndCompiled) {
  SKIP_WITHOUT_SHIM();
  const TempFolder folder;
  const std::string map = folder / "home.map";
  EXPECT_EQ(without(kAll, {"edit", map, "new"}).status, 0);
  EXPECT_EQ(without(kAll, {"edit", map, "room", "from", "0,0", "to", "6,4", "height", "2.7"}).status, 0);
  EXPECT_EQ(without(kAll, {"edit", map, "render", folder / "a.png"}).status, 3);
  EXPECT_EQ(without(kAll, {"edit", map, "entity", "light", "at", "1,2,2"}).status, 0);
  EXPECT_EQ(without(kAll, {"compile", map}).status, 0);
  EXPECT_EQ(without(kAll, {"map", "check", map}).status, 0);
}

TEST(Renderer, NoProgramLinksALibraryThatDraws) {
  const std::array names{"libOSMesa", "libEGL",   "libGL",  "libOpenGL",
                         "libgbm",    "libglapi", "libX11", "libwayland"};
  std::size_t programs = 0;
  for (const char* folder : {"bin", "lib", "libexec"}) {
    for (const auto& entry : fs::recursive_directory_iterator(binary_folder() / folder)) {
      if (!entry.is_regular_file() || !read_file(entry.path())
                                           .starts_with("\x7f"
                                                        "ELF"))
        continue;
      const Ended ended = Process({"/usr/bin/readelf", "-dW", entry.path()}).wait();
      ASSERT_EQ(ended.status, 0) << ended.err;
      ++programs;
      for (const std::string_view line : split(ended.out, '\n')) {
        if (line.find("(NEEDED)") == std::string_view::npos) continue;
        for (const char* name : names)
          EXPECT_EQ(line.find(std::string("[") + name), std::string_view::npos) << entry.path() << line;
      }
    }
  }
  EXPECT_TRUE(fs::exists(hallway_program()));
  EXPECT_GE(programs, 4u);  // hallway, its helpers, plugins
}

}  // namespace
}  // namespace hallway::test
