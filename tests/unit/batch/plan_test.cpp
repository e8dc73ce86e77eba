// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "base/error.hpp"
#include "batch/plan.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"

namespace hallway::batch {
namespace {

constexpr const char* kPlan = R"(schema = "hallway.batch/1"
scenarios = ["office.toml"]
seeds = [1, 2]
steps = 100
[set]
"sensor.eyes.noise_m" = [0.01, 0.05]
[[plugin]]
name = "slam_point"
params = { noise_m = [0.01, 0.02], mode = "thesis" }
[[plugin]]
name = "build/my.so"
[[picture]]
name = "top"
view = "top"
show = ["map", "truth"]
[threshold]
"landmark_rmse_m.aligned" = { most = 0.05 }
lost_iterations.most = 0
)";

TEST(ReadPlan, HasAllThatStandsInIt) {
  const test::TempFolder folder;
  const Plan plan = read_plan(folder.write("plan.toml", kPlan));
  EXPECT_EQ(plan.cells.size(), 2u * 2u * (2u + 1u));
  EXPECT_EQ(plan.cells[0].labels, (std::vector<Label>{{"input", (folder / "office.toml").string()},
                                                      {"seed", "1"},
                                                      {"sensor.eyes.noise_m", "0.01"},
                                                      {"plugin", "slam_point"},
                                                      {"slam_point.noise_m", "0.01"},
                                                      {"slam_point.mode", "thesis"}}));
  EXPECT_EQ(plan.cells[2].labels.back().value, (folder / "build/my.so").string());
  ASSERT_EQ(plan.pictures.size(), 1u);
  EXPECT_EQ(plan.pictures[0].arguments,
            (std::vector<std::string>{"--view", "top", "--hide", "all", "--show", "map,truth"}));
  ASSERT_EQ(plan.thresholds.size(), 2u);
  EXPECT_EQ(plan.thresholds[0].metric, "landmark_rmse_m.aligned");
  EXPECT_EQ(plan.thresholds[0].most, 0.05);
  EXPECT_EQ(plan.thresholds[1].metric, "lost_iterations");
  EXPECT_EQ(plan.thresholds[1].most, 0.0);
  EXPECT_FALSE(plan.thresholds[1].least);
}

/// Each line replaced by a wrong one is refused with that line's number.
TEST(ReadPlan, RefusesWhatIsWrongWithItsLine) {
  struct Wrong {
    std::string line, by, says;
  };
  for (const Wrong& wrong :
       {Wrong{"steps = 100", "stepz = 100", "did you mean \"steps\""},
        Wrong{"seeds = [1, 2]", "seeds = [1, -2]", "-2"}, Wrong{"seeds = [1, 2]", "seeds = []", "is empty"},
        Wrong{"seeds = [1, 2]", "seeds = [[1]]", "seeds"},
        Wrong{"scenarios = [\"office.toml\"]", "scenarios = [3]", "not a text"},
        Wrong{"schema = \"hallway.batch/1\"", "schema = \"hallway.scenario/1\"", "hallway.batch/1"},
        Wrong{"name = \"build/my.so\"", "nam = \"build/my.so\"", "did you mean \"name\""},
        Wrong{"name = \"top\"", "name = \"../top\"", "other letters"},
        Wrong{"lost_iterations.most = 0", "lost_iterations.most = \"none\"", "not a number"},
        Wrong{"lost_iterations.most = 0", "lost_iterations = 0", "not a table"},
        Wrong{"lost_iterations.most = 0", "lost_iterations.mots = 0", "did you mean \"most\""},
        Wrong{"lost_iterations.most = 0", "lost_iterations = {}", "neither"},
        Wrong{"steps = 100", "steps = \"ten\"", "`steps`"}, Wrong{"steps = 100", "steps = [1, 2]", "`steps`"},
        Wrong{"steps = 100", "steps = = 100", ""}}) {
    SCOPED_TRACE(wrong.by);
    const test::TempFolder folder;
    std::string text = kPlan;
    const std::size_t at = text.find(wrong.line);
    ASSERT_NE(at, std::string::npos);
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    text.replace(at, wrong.line.size(), wrong.by);
    const auto error = test::error_of([&] { read_plan(folder.write("plan.toml", text)); });
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
    EXPECT_NE(error->message().find(wrong.says), std::string::npos) << error->message();
    if (wrong.says != "hallway.batch/1" && wrong.says != "neither") {
      EXPECT_NEAR(error->where().line, static_cast<int>(line), 1) << error->what();
    }
  }
}

/// Both would be in the label, and one of them would run.
TEST(ReadPlan, AParameterHasItsValuesInOnePlace) {
  const test::TempFolder folder;
  for (const char* key : {"noise_m", "\"slam_point.noise_m\""}) {
    const auto error = test::error_of([&] {
      read_plan(folder.write("plan.toml",
                             fmt::format("schema = \"hallway.batch/1\"\nscenarios = [\"office.toml\"]\n"
                                         "[set]\n{} = [0.3]\n[[plugin]]\nname = \"slam_point\"\n"
                                         "params = {{ noise_m = [0.01, 0.02] }}\n",
                                         key)));
    });
    ASSERT_TRUE(error) << key;
    EXPECT_NE(error->message().find("leave out one"), std::string::npos) << error->message();
  }
}

TEST(ReadPlan, NothingToRunIsRefused) {
  const test::TempFolder folder;
  const auto error =
      test::error_of([&] { read_plan(folder.write("plan.toml", "schema = \"hallway.batch/1\"\n")); });
  ASSERT_TRUE(error);
  EXPECT_NE(error->message().find("nothing to run"), std::string::npos);
}

}  // namespace
}  // namespace hallway::batch
