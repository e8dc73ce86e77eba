// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "base/error.hpp"
#include "batch/plan.hpp"
#include "support/errors.hpp"

namespace hallway::batch {
namespace {

TEST(Combine, MakesEveryCombinationOnce) {
  Dimensions dimensions;
  dimensions.inputs = {"office.toml", "eight.toml"};
  dimensions.seeds = {"1", "2", "3"};
  dimensions.settings = {{"sensor.eyes.noise_m", {"0.01", "0.05"}}};
  dimensions.plugins = {{"slam_point", {{"noise_m", {"0.01", "0.02"}}, {"overlap", {"0.3", "0.5"}}}},
                        {"./other.so", {}}};
  const auto cells = combine(dimensions);
  EXPECT_EQ(cells.size(), 2u * 3u * 2u * (4u + 1u));
  std::set<std::vector<std::string>> arguments;
  std::set<std::string> names;
  for (const Cell& cell : cells) {
    arguments.insert(cell.arguments);
    names.insert(cell.name);
    EXPECT_EQ(cell.arguments.front(), "run");
    EXPECT_EQ(
        cell.name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._=+-"),
        std::string::npos)
        << cell.name;
  }
  EXPECT_EQ(arguments.size(), cells.size());
  EXPECT_EQ(names.size(), cells.size());
}

TEST(Combine, ArgumentsAreThoseOfTheCommandLine) {
  Dimensions dimensions;
  dimensions.inputs = {"maps/office.toml"};
  dimensions.seeds = {"7"};
  dimensions.settings = {{"sensor.eyes.noise_m", {"0.05"}}};
  dimensions.plugins = {{"build/my.so", {{"match_m", {"0.2"}}}}};
  dimensions.more = {"--steps", "9"};
  const auto cells = combine(dimensions);
  ASSERT_EQ(cells.size(), 1u);
  EXPECT_EQ(cells[0].arguments,
            (std::vector<std::string>{"run", "maps/office.toml", "--steps", "9", "--seed", "7", "--set",
                                      "sensor.eyes.noise_m=0.05", "--plugin", "build/my.so", "--set",
                                      "my.match_m=0.2"}));
  EXPECT_EQ(cells[0].inputs, (std::vector<std::filesystem::path>{"maps/office.toml", "build/my.so"}));
  EXPECT_EQ(cells[0].name, "office");  // nothing else varies
}

TEST(Combine, OneOfSeveralPluginsOfAFile) {
  Dimensions dimensions;
  dimensions.inputs = {"a.toml"};
  dimensions.plugins = {{"lib/two.so:second", {{"x", {"1", "2"}}}}};
  const auto cells = combine(dimensions);
  ASSERT_EQ(cells.size(), 2u);
  EXPECT_EQ(cells[1].arguments.back(), "second.x=2");
  EXPECT_EQ(cells[1].inputs.back(), "lib/two.so");
  EXPECT_EQ(cells[1].name, "a+x=2");
}

/// What was recorded has its seed: it is replayed once, and with each plugin.
TEST(Combine, LogsHaveNoSeedsAndNoSettings) {
  Dimensions dimensions;
  dimensions.inputs = {"run.mcap", "a.toml"};
  dimensions.seeds = {"1", "2"};
  dimensions.plugins = {{"p", {}}, {"q", {}}};
  const auto cells = combine(dimensions);
  ASSERT_EQ(cells.size(), 2u + 4u);
  EXPECT_EQ(cells[0].arguments, (std::vector<std::string>{"replay", "run.mcap", "--plugin", "p"}));
}

TEST(Combine, NamesThatWouldBeTheSameAreNumbered) {
  Dimensions dimensions;
  dimensions.inputs = {"one/a.toml", "two/a.toml"};
  const auto cells = combine(dimensions);
  EXPECT_EQ(cells[0].name, "a");
  EXPECT_EQ(cells[1].name, "a-2");
}

TEST(Combine, TooManyAreRefused) {
  Dimensions dimensions;
  dimensions.inputs = {"a.toml"};
  std::vector<std::string> many(1000);
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = std::to_string(i);
  dimensions.seeds = many;
  dimensions.settings = {{"period_s", many}};
  const auto error = test::error_of([&] { combine(dimensions); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
}

}  // namespace
}  // namespace hallway::batch
