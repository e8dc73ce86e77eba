// SPDX-License-Identifier: MIT
#include "log/row_writer.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "support/errors.hpp"

namespace hallway::log {
namespace {

TEST(RowWriter, SeparatesFieldsAndEndsRows) {
  RowWriter out(';');
  out.word("a").whole(18446744073709551615u).number(0.1).end_row();
  out.numbers(std::array{1.0, -0.0, 1e300}).end_row();
  EXPECT_EQ(out.take(), "a;18446744073709551615;0.1\n1;-0;1e+300\n");
}

TEST(RowWriter, KeepsEmptyFields) {
  RowWriter out(',');
  out.word("").word("").end_row();
  EXPECT_EQ(out.take(), ",\n");
}

TEST(RowWriter, RefusesNumbersThatCannotBeReadBack) {
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    const auto error = test::error_of([&] { RowWriter(',').number(value); });
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code(), ErrorCode::kInternal);
  }
}

}  // namespace
}  // namespace hallway::log
