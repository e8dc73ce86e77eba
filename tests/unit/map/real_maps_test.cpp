// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "map/check.hpp"
#include "map/occupants.hpp"
#include "map/reader.hpp"
#include "map/world.hpp"
#include "solid_checks.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"

namespace hallway::map {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> maps_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".map") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Maps of the collection that are none, and what is said of them. Three are fragments that an editor copied, one is of
/// Hexen II.
const std::map<std::string, std::string>& refused() {
  static const std::map<std::string, std::string> messages{
      {"curvetut-crash.map", "a face that is in no brush"},
      {"subtrahend.map", "a face that is in no brush"},
      {"weirdcurvemerge.map", "a face that is in no brush"},
      {"h2rotate.map", "one number after the texture's scale, as Hexen II has it, is not read"}};
  return messages;
}

/// A brush of a map as it was sold, which has one plane twice.
bool is_known(const fs::path& file, const Problem& problem) {
  return file.filename() == "dm2.map" && problem.line == 4007 &&
         problem.message == "the faces at lines 4004 and 4007 lie on the same plane";
}

TEST(RealMaps, AreReadOrRefusedForWhatTheyAre) {
  HALLWAY_DATA_OR_SKIP(folder, "maps");
  std::size_t read = 0;
  std::map<std::string, std::string> seen;
  for (const fs::path& file : maps_below(folder)) {
    const auto error = hallway::test::error_of([&] { load(file); });
    if (!error) {
      ++read;
      continue;
    }
    const auto expected = refused().find(file.filename().string());
    ASSERT_NE(expected, refused().end()) << error->what();
    EXPECT_NE(error->message().find(expected->second), std::string::npos) << error->what();
    seen.insert(*expected);
  }
  EXPECT_GE(read, 275u);
  EXPECT_EQ(seen, refused());
}

TEST(RealMaps, HaveSoundSolids) {
  HALLWAY_DATA_OR_SKIP(folder, "maps");
  std::size_t solids = 0;
  for (const fs::path& file : maps_below(folder)) {
    if (refused().contains(file.filename().string())) continue;
    SCOPED_TRACE(file.string());
    const World world = build_world(load(file));
    for (const Problem& problem : world.problems)
      EXPECT_TRUE(is_known(file, problem)) << problem.line << ": " << problem.message;
    solids += world.solids.size();
    for (const Solid& solid : world.solids) {
      test::expect_sound_faces(solid, 2e-6 * world.metres_per_unit);
      test::expect_closed(solid);
    }
  }
  EXPECT_GE(solids, 9000u);
}

TEST(RealMaps, EveryMapOfTheGameHasOccupants) {
  HALLWAY_DATA_OR_SKIP(folder, "maps/id1");
  for (const fs::path& file : maps_below(folder)) {
    SCOPED_TRACE(file.string());
    const Document document = load(file);
    const auto found = occupants(document);
    EXPECT_GE(found.size(), 50u);
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [](const Occupant& occupant) {
      return occupant.classname == "info_player_start" || occupant.classname == "info_player_deathmatch";
    }));
  }
}

TEST(RealMaps, NoMapOfQuakeHasErrorsButForItsBrushes) {
  HALLWAY_DATA_OR_SKIP(folder, "maps");
  for (const fs::path& file : maps_below(folder)) {
    if (refused().contains(file.filename().string())) continue;
    for (const Finding& finding : check(load(file))) {
      if (finding.severity == Severity::kWarning) continue;
      EXPECT_EQ(finding.id, "bad-brush") << file << ":" << finding.where.line << ": " << finding.message;
    }
  }
}

}  // namespace
}  // namespace hallway::map
