// SPDX-License-Identifier: MIT
#include "link/datagram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "base/random.hpp"
#include "link/assembly.hpp"
#include "support/errors.hpp"
#include "unit/link/datagrams.hpp"

namespace hallway::link {
namespace {

Datagram read_whole(const Bytes& bytes) {
  const auto read = read_datagram(bytes);
  if (std::holds_alternative<Refusal>(read)) throw std::runtime_error("refused");
  return std::get<Datagram>(read);
}

Refusal refusal_of(const Bytes& bytes) {
  return std::get<Refusal>(read_datagram(bytes));
}

const Header kHeader{.type = Type::kFrame,
                     .flags = kReplyWanted,
                     .session = 0xdeadbeef,
                     .sequence = 0x0123456789abcdef,
                     .fragment = 2,
                     .fragments = 3};

TEST(Datagram, IsReadBack) {
  const Bytes payload = some_bytes(77);
  const Bytes bytes = datagram_of(kHeader, payload);
  const Datagram read = read_whole(bytes);
  EXPECT_EQ(read.header.type, kHeader.type);
  EXPECT_EQ(read.header.flags, kHeader.flags);
  EXPECT_EQ(read.header.session, kHeader.session);
  EXPECT_EQ(read.header.sequence, kHeader.sequence);
  EXPECT_EQ(read.header.fragment, kHeader.fragment);
  EXPECT_EQ(read.header.fragments, kHeader.fragments);
  EXPECT_TRUE(std::equal(read.payload.begin(), read.payload.end(), payload.begin(), payload.end()));
}

TEST(Datagram, HasTheBytesOfTheSpecification) {
  const Bytes bytes = datagram_of({.type = Type::kHello, .flags = 2, .session = 0x04030201, .sequence = 5});
  const unsigned char expected[] = {'H', 'W', 'U', 'D', 1, 1, 2, 0, 1, 2, 3, 4};
  EXPECT_EQ(std::memcmp(bytes.data(), expected, sizeof expected), 0);
  // The checksum, as any program of CRC-32 gives it for the 32 bytes with four zeros in its place.
  std::uint32_t crc = 0xffffffff;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    crc ^= i >= 12 && i < 16 ? 0u : static_cast<std::uint32_t>(bytes[i]);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320u : 0u);
  }
  std::uint32_t stored = 0;
  std::memcpy(&stored, bytes.data() + 12, 4);
  EXPECT_EQ(stored, ~crc);
}

TEST(Datagram, EveryTruncationIsRefused) {
  const Bytes bytes = datagram_of(kHeader, some_bytes(40));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_EQ(refusal_of(cut), Refusal::kSize) << size;
  }
  Bytes longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_EQ(refusal_of(longer), Refusal::kSize);
  EXPECT_EQ(refusal_of(Bytes(kMaxDatagramBytes + 1)), Refusal::kSize);
}

TEST(Datagram, EveryFlippedBitIsRefused) {
  const Bytes bytes = datagram_of(kHeader, some_bytes(40));
  for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    Bytes flipped = bytes;
    flipped[bit / 8] ^= std::byte{1} << (bit % 8);
    EXPECT_TRUE(std::holds_alternative<Refusal>(read_datagram(flipped))) << bit;
  }
  Bytes other = bytes;
  other[4] = std::byte{3};
  EXPECT_EQ(refusal_of(other), Refusal::kVersion);
  other[0] = std::byte{0};
  EXPECT_EQ(refusal_of(other), Refusal::kMagic);
  other = bytes;
  other[50] ^= std::byte{1};
  EXPECT_EQ(refusal_of(other), Refusal::kChecksum);
}

TEST(Datagram, WhatMakesNoSenseIsRefusedThoughItIsWhole) {
  const auto refused = [](const Header& header, std::size_t payload) {
    const auto read = read_datagram(datagram_of(header, some_bytes(payload)));
    return std::holds_alternative<Refusal>(read) && std::get<Refusal>(read) == Refusal::kContent;
  };
  EXPECT_TRUE(refused({.type = Type{0}}, 0));
  EXPECT_TRUE(refused({.type = Type{7}}, 0));
  EXPECT_TRUE(refused({.type = Type::kFrame, .fragment = 3, .fragments = 3}, 8));
  EXPECT_TRUE(refused({.type = Type::kFrame, .fragment = 0, .fragments = 0}, 8));
  EXPECT_TRUE(refused({.type = Type::kFrame, .fragments = kMaxFrameFragments + 1}, kFragmentBytes));
  EXPECT_TRUE(
      refused({.type = Type::kDescription, .fragments = kMaxDescriptionFragments + 1}, kFragmentBytes));
  EXPECT_TRUE(refused({.type = Type::kHello, .fragments = 2}, kFragmentBytes));
  EXPECT_TRUE(refused({.type = Type::kFrame, .fragment = 0, .fragments = 2}, 8)) << "only the last is short";
  EXPECT_TRUE(refused({.type = Type::kFrame, .fragment = 1, .fragments = 2}, 0));
  EXPECT_FALSE(std::holds_alternative<Refusal>(read_datagram(
      datagram_of({.type = Type::kFrame, .fragments = kMaxFrameFragments}, some_bytes(kFragmentBytes)))));
  Bytes out;
  EXPECT_TRUE(hallway::test::error_of([&] { write_datagram({}, Bytes(kFragmentBytes + 1), out); }));
}

/// 0 … n - 1 in an order that follows from `seed`.
std::vector<std::size_t> shuffled(std::size_t n, std::uint64_t seed) {
  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = i;
  const Random random(seed, 1);
  for (std::size_t i = n; i > 1; --i) {
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.uniform(0, i) * static_cast<double>(i))]);
  }
  return order;
}

TEST(Assembly, PutsFragmentsTogetherInAnyOrderWithDuplicates) {
  for (const std::size_t size : {std::size_t{1}, kFragmentBytes - 1, kFragmentBytes, kFragmentBytes + 1,
                                 3 * kFragmentBytes, std::size_t{480'000}}) {
    const Bytes message = some_bytes(size, size);
    const auto datagrams = datagrams_of({.type = Type::kFrame, .session = 1, .sequence = 9}, message);
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      Assembly assembly;
      std::size_t added = 0;
      for (const std::size_t i : shuffled(datagrams.size(), seed)) {
        const Datagram fragment = read_whole(datagrams[i]);
        if (!assembly.begun()) assembly.begin(fragment.header);
        EXPECT_EQ(assembly.complete(), added == datagrams.size());
        EXPECT_EQ(assembly.add(fragment), Assembly::Added::kNew);
        EXPECT_EQ(assembly.add(fragment), Assembly::Added::kDuplicate);
        ++added;
      }
      ASSERT_TRUE(assembly.complete());
      EXPECT_EQ(assembly.sequence(), 9u);
      Bytes back;
      assembly.take(back);
      EXPECT_TRUE(back == message) << size;
      EXPECT_FALSE(assembly.begun());
    }
  }
}

TEST(Assembly, RefusesAFragmentOfAnotherSize) {
  Assembly assembly;
  const Bytes a = datagram_of({.type = Type::kFrame, .fragments = 3}, some_bytes(kFragmentBytes));
  const Bytes b = datagram_of({.type = Type::kFrame, .fragment = 1, .fragments = 2}, some_bytes(8));
  assembly.begin(read_whole(a).header);
  EXPECT_EQ(assembly.add(read_whole(a)), Assembly::Added::kNew);
  EXPECT_EQ(assembly.add(read_whole(b)), Assembly::Added::kMisfit);
}

}  // namespace
}  // namespace hallway::link
