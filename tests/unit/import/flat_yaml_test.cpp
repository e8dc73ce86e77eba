// SPDX-License-Identifier: MIT
#include "import/flat_yaml.hpp"

#include <gtest/gtest.h>

#include "unit/import/rig_scene.hpp"

namespace hallway::import {
namespace {

TEST(FlatYaml, ReadsWhatSensorFilesHave) {
  const FlatYaml yaml(
      "\xEF\xBB\xBF%YAML:1.0\r\n---\n# a comment: not a key\ncomment: VI-Sensor#1 (ADIS16448)  # the "
      "IMU\nquoted: 'a # b: c'\nempty:\n"
      "T_BS: !!opencv-matrix\n   cols: 4\n   rows: 4 \t\n   data: [1.0, 0,\n # within\n\n  -2e-3, "
      "4]\nrate_hz: 200",
      "s.yaml");
  EXPECT_EQ(yaml.text("comment"), "VI-Sensor#1 (ADIS16448)");
  EXPECT_EQ(yaml.text("quoted"), "a # b: c");
  EXPECT_EQ(yaml.text("empty"), "");
  EXPECT_EQ(yaml.number("T_BS.cols", 0, 9), 4.0);
  EXPECT_EQ(yaml.numbers("T_BS.data", 4), (std::vector<double>{1.0, 0.0, -2e-3, 4.0}));
  EXPECT_EQ(yaml.number("rate_hz", 0, 1e9), 200.0);
  EXPECT_FALSE(yaml.has("cols"));
}

TEST(FlatYaml, SaysByLineWhatItDoesNotRead) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"a: 1\n- b\n", "s.yaml:2: \"key: value\" is needed, \"- b\" found; other YAML is not read"},
      {"a: 1\na: 2\n", "s.yaml:2: a is there twice"},
      {"a: 1\n\tb: 2\n", "s.yaml:2: a tab at the beginning of a line"},
      {"a: 1\n  b: 2\n", "s.yaml:2: the line is indented, and belongs to no key above it"},
      {"a:\n  b: 1\n   c: 2\n", "s.yaml:3: the line is indented"},
      {"a:\n  b:\n    c: 2\n", "s.yaml:2: an indented key needs a value"},
      {"a: [1, 2\nb: 3\n", "the file ends within a list"},
      {"a: [1] 2\n", "s.yaml:1: something follows a list"},
      {"a: \"b\n", "s.yaml:1: a quoted text does not end in its line"},
      {"a: \"b\\n\"\n", "s.yaml:1: a quoted text with quotes or backslashes"},
      {"a: {b: 1}\n", "s.yaml:1: \"{b: 1}\" is not read"},
      {"a: &anchor 1\n", "s.yaml:1: \"&anchor 1\" is not read"},
      {"a: |\n", "s.yaml:1: \"|\" is not read"},
      {"a: !tag 1\n", "s.yaml:1: \"!tag 1\" is not read"},
      {"a: 1\n%YAML:1.0\n", "s.yaml:2: \"key: value\" is needed"},
      {"a:1\n", "s.yaml:1: \"key: value\" is needed"},
      {"no words\n", "s.yaml:1: \"key: value\" is needed"},
  };
  for (const auto& entry : cases) {
    test::expect_error([&] { FlatYaml(entry.first, "s.yaml"); }, ErrorCode::kBadInput, entry.second);
  }
}

TEST(FlatYaml, ValuesOfAnotherKindAreNamed) {
  const FlatYaml yaml("a: 1\n\nb: [1, x]\nc: nan\n", "s.yaml");
  const auto refused = [](const std::function<void()>& work, const std::string& words) {
    test::expect_error(work, ErrorCode::kBadInput, words);
  };
  refused([&] { yaml.number("z", 0, 1); }, "s.yaml: has no key z");
  refused([&] { yaml.number("b", 0, 1); }, "s.yaml:3: key b: one value is needed, not a list");
  refused([&] { yaml.numbers("a", 1); }, "s.yaml:1: key a: a list is needed");
  refused([&] { yaml.number("a", 2, 3); }, "s.yaml:1: key a: a number from 2 to 3 is needed, \"1\" found");
  refused([&] { yaml.number("c", 0, 1); }, "s.yaml:4: key c: a number from 0 to 1 is needed, \"nan\" found");
  refused([&] { yaml.numbers("b", 3); }, "s.yaml:3: key b: 2 numbers where 3 are needed");
  refused([&] { yaml.numbers("b", 2); }, "s.yaml:3: key b: a finite number is needed, \"x\" found");
}

}  // namespace
}  // namespace hallway::import
