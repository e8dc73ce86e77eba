// SPDX-License-Identifier: MIT
#include "link/address.hpp"

#include <gtest/gtest.h>

#include "support/errors.hpp"

namespace hallway::link {
namespace {

TEST(Address, IsReadAndPrintedBack) {
  for (const char* text : {"127.0.0.1:7000", "0.0.0.0:0", "255.1.2.3:65535", "[::1]:7000", "[::]:0",
                           "[fe80::1]:9", "[2001:db8::5:6]:80"}) {
    EXPECT_EQ(print_address(parse_address(text)), text);
  }
  EXPECT_EQ(print_address(parse_address("[0:0:0:0:0:0:0:1]:1")), "[::1]:1");
  EXPECT_EQ(print_address(parse_address("[fe80::1%7]:9")), "[fe80::1%7]:9");
}

TEST(Address, EqualOnlyInAllItsParts) {
  EXPECT_EQ(parse_address("127.0.0.1:7000"), parse_address("127.0.0.1:7000"));
  EXPECT_NE(parse_address("127.0.0.1:7000"), parse_address("127.0.0.1:7001"));
  EXPECT_NE(parse_address("127.0.0.1:7000"), parse_address("127.0.0.2:7000"));
  EXPECT_NE(parse_address("[::]:7000"), parse_address("0.0.0.0:7000"));
}

TEST(Address, WhatIsNoneIsToldWithItsFault) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "IP:PORT"},
      {"127.0.0.1", "IP:PORT"},
      {"localhost:7000", "names are not looked up"},
      {"127.0.0.1:", "port"},
      {"127.0.0.1:65536", "port"},
      {"127.0.0.1:-1", "port"},
      {"127.0.0.1:7000x", "port"},
      {":7000", "IPv4"},
      {"127.0.0:7000", "IPv4"},
      {"::1:7000", "brackets"},
      {"[::1]", "after an IPv6 address"},
      {"[::1:7000", "after an IPv6 address"},
      {"[127.0.0.1]:7000", "IPv6"},
      {"[fe80::1%nothing]:7", "interface"},
      {std::string("127.0.0.1\0:7", 12), "NUL"},
  };
  for (const auto& [text, part] : cases) {
    const auto error = test::error_of([&text = text] { parse_address(text); });
    ASSERT_TRUE(error) << text;
    EXPECT_EQ(error->code(), ErrorCode::kUsage) << text;
    EXPECT_NE(error->message().find(part), std::string::npos) << error->message();
  }
}

}  // namespace
}  // namespace hallway::link
