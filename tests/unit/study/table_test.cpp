// SPDX-License-Identifier: MIT
#include "study/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.hpp"

namespace hallway::study {
namespace {

Table small_table() {
  Table table{.file = "t", .columns = {"plugin", "value", "why"}};
  table.add({"a, \"b\"", 0.1, Field()});
  table.add({"c", std::nan(""), "x"});
  return table;
}

TEST(Table, IsWrittenAsCsv) {
  EXPECT_EQ(print_csv(small_table()), "plugin,value,why\n\"a, \"\"b\"\"\",0.1,\nc,,x\n");
}

TEST(Table, IsWrittenAsJson) {
  EXPECT_EQ(to_json(small_table()).dump(),
            "[{\"plugin\":\"a, \\\"b\\\"\",\"value\":0.1,\"why\":null},{\"plugin\":\"c\",\"value\":null,"
            "\"why\":\"x\"}]");
}

TEST(Table, IsShownInColumns) {
  EXPECT_EQ(print_text(small_table()), "plugin  value  why\na, \"b\"    0.1  -  \nc           -  x  \n");
}

TEST(Table, RefusesARowOfAnotherWidth) {
  Table table{.columns = {"a"}};
  EXPECT_THROW(table.add({}), Error);
}

}  // namespace
}  // namespace hallway::study
