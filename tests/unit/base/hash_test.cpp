// SPDX-License-Identifier: MIT
#include "base/hash.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace hallway {
namespace {

// The published answer of XXH3_128bits for no input and seed 0.
TEST(ContentHash, OfNothingIsThePublishedValue) {
  EXPECT_EQ(content_hash(""), "99aa06d3014798d86001c324468d497f");
}

TEST(ContentHash, IsThirtyTwoHexadecimalDigits) {
  const std::string hash = content_hash("hallway");
  EXPECT_EQ(hash.size(), 32u);
  EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos);
}

TEST(ContentHash, ChangesWithEveryBit) {
  const std::string text = "the same text but for one bit, at any place of it";
  std::set<std::string> hashes{content_hash(text)};
  for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
    std::string changed = text;
    changed[bit / 8] = static_cast<char>(static_cast<unsigned char>(changed[bit / 8]) ^ (1u << (bit % 8)));
    hashes.insert(content_hash(changed));
  }
  EXPECT_EQ(hashes.size(), 8 * text.size() + 1);
}

TEST(ContentHash, CountsZeroBytes) {
  EXPECT_NE(content_hash(std::string(1, '\0')), content_hash(std::string(2, '\0')));
}

}  // namespace
}  // namespace hallway
