// SPDX-License-Identifier: MIT
#include "batch/table.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace hallway::batch {
namespace {

using Json = nlohmann::ordered_json;

std::vector<Result> three_results() {
  std::vector<Result> results(3);
  results[0] = {.name = "a",
                .labels = {{"seed", "1"}},
                .status = 0,
                .metrics = {{"lost", 0}, {"rmse", {{"aligned", 0.25}}}}};
  results[1] = {.name = "b",
                .labels = {{"seed", "2"}, {"p.x", "a,\"b\""}},
                .status = 5,
                .problem = "crashed",
                .verdict = {{"what", "crash"}}};
  results[2] = {.name = "c",
                .labels = {{"seed", "3"}},
                .status = 0,
                .metrics = {{"lost", 3}, {"rmse", {{"aligned", nullptr}}}, {"more", 1e-7}}};
  return results;
}

TEST(Table, NumbersHaveNamesWithPoints) {
  const auto numbers = numbers_of(three_results()[0].metrics);
  EXPECT_EQ(numbers, (std::vector<std::pair<std::string, double>>{{"lost", 0.0}, {"rmse.aligned", 0.25}}));
  EXPECT_EQ(number_of(three_results()[2].metrics, "rmse.aligned"), std::nullopt);
}

TEST(Table, CsvHasALineForEachAndQuotesWhatNeedsIt) {
  EXPECT_EQ(print_csv(three_results()),
            "name,seed,p.x,status,verdict,problem,wall_s,lost,rmse.aligned,more\r\n"
            "a,1,,0,,,0,0,0.25,\r\n"
            "b,2,\"a,\"\"b\"\"\",5,crash,crashed,0,,,\r\n"
            "c,3,,0,,,0,3,,1e-07\r\n");
}

TEST(Table, ThresholdsNameEachThatMissesThem) {
  const std::vector<Threshold> thresholds{{"rmse.aligned", {}, 0.2}, {"lost", {}, 2.0}, {"lost", -1.0, {}}};
  EXPECT_EQ(violations(three_results(), thresholds),
            (std::vector<std::string>{"a: rmse.aligned is 0.25, more than 0.2", "b: rmse.aligned is missing",
                                      "b: lost is missing", "b: lost is missing",
                                      "c: rmse.aligned is missing", "c: lost is 3, more than 2"}));
  EXPECT_EQ(violations({three_results()[0]}, {{"lost", 1.0, {}}}),
            std::vector<std::string>{"a: lost is 0, less than 1"});
}

}  // namespace
}  // namespace hallway::batch
