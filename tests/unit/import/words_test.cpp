// SPDX-License-Identifier: MIT
#include "import/words.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "import/recording.hpp"
#include "import/scalar.hpp"
#include "unit/import/cloud_bytes.hpp"

namespace hallway::import {
namespace {

TEST(Words, BlanksPartThem) {
  std::vector<std::string_view> words;
  split_words("  a\tbc  d \r", words);
  EXPECT_EQ(words, (std::vector<std::string_view>{"a", "bc", "d"}));
  split_words(" ", words);
  EXPECT_TRUE(words.empty());
}

TEST(Words, SecondsAreExactToTheNanosecond) {
  // A double of that size is 2.4e-7 s apart from the next.
  EXPECT_EQ(parse_seconds("1305031102.175304"), 1305031102175304000);
  EXPECT_EQ(parse_seconds("1305031102.123456789"), 1305031102123456789);
  EXPECT_EQ(parse_seconds("0"), 0);
  EXPECT_EQ(parse_seconds("21.819"), 21819000000);
  EXPECT_EQ(parse_seconds("1."), 1000000000);
  EXPECT_EQ(parse_seconds("0.0000000005"), 1);
  EXPECT_EQ(parse_seconds("0.00000000049"), 0);
  EXPECT_EQ(parse_seconds("8999999999.999999999"), 8999999999999999999);
  EXPECT_EQ(parse_seconds("1.5e3"), 1500000000000);
}

TEST(Words, WhatIsNoTimeInSecondsIsRefused) {
  for (const char* word : {"", ".", "-1", "9000000000", "1305031102175304000", "1e300", "nan", "inf", "1,5",
                           "0x10", "1.2.3", "1.5s", "99999999999999999999999"}) {
    EXPECT_EQ(parse_seconds(word), std::nullopt) << word;
  }
  EXPECT_EQ(seconds_to_ns(std::nan("")), std::nullopt);
}

TEST(Words, CoordinatesMayBeNoNumbers) {
  EXPECT_EQ(parse_coordinate("-1.5e-3"), -0.0015);
  EXPECT_EQ(parse_coordinate("+2"), 2.0);
  for (const char* word : {"nan", "NaN", "-nan", "inf", "-Inf", "+infinity", "-nan(ind)"}) {
    ASSERT_TRUE(parse_coordinate(word)) << word;
    EXPECT_FALSE(std::isfinite(*parse_coordinate(word))) << word;
  }
  for (const char* word : {"", "+", "-", "+-1", "1e999", "0x1", "nano", "1,5"}) {
    EXPECT_EQ(parse_coordinate(word), std::nullopt) << word;
  }
}

TEST(Scalar, ReadsEveryTypeInBothOrders) {
  const auto check = [](auto value, Scalar type) {
    EXPECT_EQ(size_of(type), sizeof value);
    for (const bool big : {false, true}) {
      const std::string bytes = test::bytes_of(value, big);
      EXPECT_EQ(read_scalar(bytes.data(), type, big ? ByteOrder::kBig : ByteOrder::kLittle),
                static_cast<double>(value));
    }
  };
  check(std::int8_t{-100}, Scalar::kInt8);
  check(std::uint8_t{200}, Scalar::kUint8);
  check(std::int16_t{-30000}, Scalar::kInt16);
  check(std::uint16_t{60000}, Scalar::kUint16);
  check(std::int32_t{-2000000000}, Scalar::kInt32);
  check(std::uint32_t{4000000000}, Scalar::kUint32);
  check(std::int64_t{-(1ll << 50)}, Scalar::kInt64);
  check(std::uint64_t{1ull << 60}, Scalar::kUint64);
  check(-0.1f, Scalar::kFloat32);
  check(-0.1, Scalar::kFloat64);
}

TEST(Recording, MeanPeriod) {
  EXPECT_EQ(mean_period_ns(10, 40, 4, 7), 10);
  EXPECT_EQ(mean_period_ns(0, 5, 3, 7), 3) << "rounded";
  EXPECT_EQ(mean_period_ns(10, 10, 4, 7), 7);
  EXPECT_EQ(mean_period_ns(10, 10, 1, 7), 7);
}

}  // namespace
}  // namespace hallway::import
