// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "base/error.hpp"
#include "map/check.hpp"
#include "map/entities.hpp"
#include "map/occupants.hpp"
#include "map/path.hpp"
#include "map/reader.hpp"
#include "map/world.hpp"
#include "map/writer.hpp"
#include "map_text.hpp"
#include "random_document.hpp"
#include "support/long_mode.hpp"

namespace hallway::map {
namespace {

/// A map that uses every entity class.
std::string sample_map() {
  return "// Game: Hallway\n" + test::map_of(test::cube_faces()) +
         test::entity_text({{"classname", "hw_robot_start"}, {"origin", "1 2 3"}, {"angle", "90"}}) +
         test::entity_text({{"classname", "hw_path"},
                            {"name", "eight"},
                            {"shape", "lemniscate"},
                            {"origin", "0 0 0"},
                            {"length_m", "100"},
                            {"rise_m", "2"}}) +
         test::entity_text({{"classname", "hw_path"}, {"name", "walk"}, {"corner_radius_m", "0.1"}}) +
         test::entity_text(
             {{"classname", "hw_waypoint"}, {"path", "walk"}, {"index", "0"}, {"origin", "0 0 0"}}) +
         test::entity_text(
             {{"classname", "hw_waypoint"}, {"path", "walk"}, {"index", "1"}, {"origin", "96 0 0"}}) +
         test::entity_text(
             {{"classname", "hw_waypoint"}, {"path", "walk"}, {"index", "2"}, {"origin", "96 96 0"}}) +
         test::entity_text({{"classname", "hw_landmark_cloud"},
                            {"name", "c"},
                            {"path", "walk"},
                            {"per_100m", "10"},
                            {"sideways_m", "1"},
                            {"height_m", "1"}});
}

/// A few bytes changed, left out, doubled, or cut off at the end.
std::string mutate(std::string text, std::mt19937_64& random) {
  static const std::string kBytes = "{}()[]\"\\/;.-+e0129 \n\r\t\xff\x01nN#,";
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const std::size_t edits = 1 + below(4);
  for (std::size_t i = 0; i < edits && text.size() > 8; ++i) {
    const std::size_t at = below(text.size());
    switch (below(6)) {
      case 0:
        text.erase(at, 1 + below(8));
        break;
      case 1:
        text.insert(at, 1, kBytes[below(kBytes.size())]);
        break;
      case 2:
        text.insert(at, text.substr(below(text.size()), 1 + below(40)));
        break;
      case 3:
        if (below(8) == 0) text.resize(at);
        break;
      default:
        text[at] = kBytes[below(kBytes.size())];
        break;
    }
  }
  return text;
}

/// Everything that reads a map; only Error may come out. @return whether all of it was read
bool use(const std::string& text) {
  try {
    const Document document = parse(text, "mutant.map");
    EXPECT_EQ(print(parse(print(document), "again.map")), print(document));
    check(document);
    occupants(document);
    const World world = build_world(document);
    for (const Solid& solid : world.solids) {
      for (const SolidFace& face : solid.faces) EXPECT_GE(face.polygon.vertices.size(), 3u);
    }
    face_points(document);
    find_robot_start(document);
    landmark_clouds(document);
    for (const char* name : {"eight", "walk"}) find_path(document, name).at(1.0);
    return true;
  } catch (const Error& error) {
    EXPECT_STRNE(error.what(), "");
    return false;
  }
}

/// Damage that is never refused, or always, tests one side of the readers only.
void expect_both(int accepted, int tried) {
  EXPECT_GT(accepted, 0);
  EXPECT_LT(accepted, tried);
}

TEST(Mutation, ChangedBytesOnlyEverThrowError) {
  const std::string original = sample_map();
  std::mt19937_64 random(20);
  const int count = hallway::test::sized(2000, 200000);
  int accepted = 0;
  for (int i = 0; i < count; ++i) accepted += use(mutate(original, random)) ? 1 : 0;
  expect_both(accepted, count);
}

TEST(Mutation, CutFilesOnlyEverThrowError) {
  const std::string original = sample_map();
  int accepted = 0;  // cut between two late entities, what is left is a map
  for (std::size_t size = 0; size < original.size(); ++size)
    accepted += use(original.substr(0, size)) ? 1 : 0;
  expect_both(accepted, static_cast<int>(original.size()));
  EXPECT_TRUE(use(original));
}

TEST(Mutation, RandomDocumentsOnlyEverThrowError) {
  std::mt19937_64 random(21);
  const int count = hallway::test::sized(500, 20000);
  for (int i = 0; i < count; ++i) {
    use(mutate(print(test::RandomDocument(static_cast<std::uint64_t>(i)).make()), random));
  }
}

TEST(Mutation, TheSampleItselfIsSound) {
  const Document document = parse(sample_map(), "sample.map");
  EXPECT_TRUE(build_world(document).problems.empty());
  EXPECT_NO_THROW(find_path(document, "walk"));
  EXPECT_NO_THROW(find_path(document, "eight"));
}

}  // namespace
}  // namespace hallway::map
