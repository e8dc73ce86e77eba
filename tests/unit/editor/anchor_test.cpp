// SPDX-License-Identifier: MIT
// Places by name: @NAME.ANCHOR.
#include "editor/anchor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "base/error.hpp"
#include "editing.hpp"
#include "editor/complete.hpp"
#include "editor/help.hpp"

namespace hallway {
namespace {

using test::Editing;

class Anchors : public ::testing::Test {
 protected:
  Anchors() {
    editing.run_all({"new", "room from 0,0 to 5,4 height=2.5 name=hall",
                     "wall from 7,1 to 9,3 name=north-wall", "box from 10,0,1 to 12,1,1.75 name=a.b",
                     "light at 3,3,2.4 name=lamp", "path way 1,1,0.3;4,1,0.3;4,3,0.3",
                     "arc centre=20,0 radius=3 from=0 to=90 name=bay"});
  }

  Vec3 place(const std::string& text) { return editor::anchor_place(editing.session->state(), text); }
  /// The place that `light` is given.
  Vec3 given(const std::string& word) {
    return editor::parse_line("light at " + word, editing.session->units()).arguments.place("at");
  }
  std::string refusal(const std::string& word) {
    try {
      given(word);
      return {};
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kUsage);
      return error.what();
    }
  }
  void expect_near(const Vec3& a, const Vec3& b) { EXPECT_LT((a - b).norm(), 1e-9) << a.transpose(); }

  Editing editing;
};

TEST_F(Anchors, CornersAndSides) {
  expect_near(place("hall.ne"), {5, 4, 0});
  expect_near(place("hall.nw"), {0, 4, 0});
  expect_near(place("hall.se"), {5, 0, 0});
  expect_near(place("hall.sw"), {0, 0, 0});
  expect_near(place("hall.n"), {2.5, 4, 0});
  expect_near(place("hall.e"), {5, 2, 0});
  expect_near(place("hall.s"), {2.5, 0, 0});
  expect_near(place("hall.w"), {0, 2, 0});
  expect_near(place("hall.centre"), {2.5, 2, 0});
  expect_near(place("hall.top"), {2.5, 2, 2.5});
  expect_near(place("a.b.sw"), {10, 0, 1});
  expect_near(place("a.b.top"), {11, 0.5, 1.75});
  expect_near(place("lamp.ne"), {3, 3, 2.4});
}

TEST_F(Anchors, Ends) {
  expect_near(place("north-wall.start"), {7, 1, 0});
  expect_near(place("north-wall.end"), {9, 3, 0});
  expect_near(place("way.start"), {1, 1, 0.3});
  expect_near(place("way.end"), {4, 3, 0.3});
  expect_near(place("bay.start"), {23, 0, 0});
  expect_near(place("bay.end"), {20, 3, 0});
}

TEST_F(Anchors, Offsets) {
  expect_near(given("@hall.ne+0.1,0"), {5.1, 4, 0});
  expect_near(given("@hall.ne+10cm,-0.5,2"), {5.1, 3.5, 2});
  expect_near(given("@hall.ne-0.1,0.2"), {4.9, 4.2, 0});
  expect_near(given("@north-wall.end+1,-1"), {10, 2, 0});
  expect_near(given("@#2.ne"), place("hall.ne"));
}

TEST_F(Anchors, InListsAndInJson) {
  const auto places = editor::parse_line("path p @hall.sw+1,1;@hall.ne-1,-1;3,3", editing.session->units())
                          .arguments.places("places");
  ASSERT_EQ(places.size(), 3u);
  expect_near(places[0], {1, 1, 0});
  expect_near(places[1], {4, 3, 0});
  const auto call = editor::parse_script_line(R"({"command": "wall", "from": "@hall.ne", "to": [9, 4]})",
                                              editing.session->units());
  expect_near(call.arguments.place("from"), {5, 4, 0});
}

TEST_F(Anchors, AWallIsMadeFromOneToAnother) {
  editing.run("wall from @north-wall.end to @north-wall.end+2,0 name=next");
  expect_near(place("next.start"), {9, 3, 0});
  expect_near(place("next.end"), {11, 3, 0});
  editing.run("remake next to=@hall.ne");
  expect_near(place("next.end"), {5, 4, 0});
  // A made wall stays where it is when what it began at moves.
  editing.run("move north-wall by 1,0");
  expect_near(place("next.start"), {9, 3, 0});
}

TEST_F(Anchors, Refusals) {
  const auto says = [&](const std::string& word, const std::string& part) {
    EXPECT_NE(refusal(word).find(part), std::string::npos) << word << ": " << refusal(word);
  };
  says("@hal.ne", "did you mean \"hall\"");
  says("@hall.nee", "there are ne, nw");
  says("@hall.nee", "did you mean \"ne\"");
  says("@hall", "an anchor is missing, as in `@hall.ne`");
  says("@hall.start", "has no start; walls");
  says("@hall.ne+1", "anchor");
  says("@hall.ne+1,x", "behind an anchor there is");
  says("@.ne", "missing");
  says("@", "missing");
  EXPECT_THROW(editor::parse_line("light at @hall.ne", {0.01}), Error) << "there is no map";
  EXPECT_THROW(editor::parse_line("move hall by @hall.ne", editing.session->units()), Error) << "no place";
}

TEST_F(Anchors, AreCompletedAndExplained) {
  const auto has = [&](const std::vector<std::string>& words, const std::string& typed,
                       const std::string& wanted) {
    const auto found = editor::completions(editing.session->state(), words, typed);
    return std::find(found.begin(), found.end(), wanted) != found.end();
  };
  EXPECT_TRUE(has({"wall", "from"}, "@ha", "@hall."));
  EXPECT_TRUE(has({"wall"}, "from=@hall.n", "from=@hall.ne"));
  EXPECT_TRUE(has({"wall"}, "from=@hall.", "from=@hall.start"));
  EXPECT_TRUE(has({"wall", "from"}, "@a.b.", "@a.b.top"));
  EXPECT_TRUE(has({"path", "p", "places"}, "1,1;@hall.s", "1,1;@hall.sw"));
  EXPECT_FALSE(has({"wall", "from"}, "", "@hall."));
  for (const editor::Anchor& anchor : editor::anchors())
    EXPECT_NE(editor::help_text(*editor::find_command("wall")).find(anchor.name), std::string::npos);
}

}  // namespace
}  // namespace hallway
