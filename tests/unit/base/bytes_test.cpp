// SPDX-License-Identifier: MIT
#include "base/bytes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace hallway {
namespace {

using Bytes = std::vector<std::byte>;

Bytes bytes_of(std::initializer_list<int> numbers) {
  Bytes bytes;
  for (const int number : numbers) bytes.push_back(static_cast<std::byte>(number));
  return bytes;
}

/// What a reader says of bytes that are too few for what is read; empty if they are enough.
template <typename Read>
std::string fault(Read&& read) {
  try {
    read();
    return {};
  } catch (const BadBytes& bad) {
    return bad.what;
  }
}

TEST(Bytes, ValuesStandLowByteFirst) {
  Bytes bytes;
  BasicByteWriter<Bytes&> writer(bytes);
  writer.put(std::uint8_t{7});
  writer.put(std::uint32_t{0x01020304});
  writer.put(std::int16_t{-2});
  EXPECT_EQ(bytes, bytes_of({7, 4, 3, 2, 1, 0xfe, 0xff}));
  EXPECT_EQ(writer.size(), bytes.size());
}

TEST(Bytes, EveryFormIsReadAsItWasPut) {
  std::string text = "before";
  ByteAppender writer(text);
  writer.put(3.5);
  writer.put_list(std::vector<std::uint16_t>{1, 2, 3});
  writer.put_text("a name");
  writer.put_raw("MARK");
  writer.put(std::array<float, 2>{1, 2});
  ByteReader reader(std::string_view(text).substr(6));
  EXPECT_EQ(reader.get<double>(), 3.5);
  EXPECT_EQ(reader.copy_list<std::uint16_t>(), (std::vector<std::uint16_t>{1, 2, 3}));
  EXPECT_EQ(reader.get_text(), "a name");
  EXPECT_FALSE(reader.accept("MARKED"));
  EXPECT_FALSE(reader.accept("mark"));
  EXPECT_TRUE(reader.accept("MARK"));
  EXPECT_EQ((reader.get<std::array<float, 2>>()), (std::array<float, 2>{1, 2}));
  EXPECT_TRUE(reader.at_end());
  reader.expect_end();
  EXPECT_EQ(reader.take_rest(), "");
}

TEST(Bytes, AlignedValuesBeginAtMultiplesWithZerosBetween) {
  std::string text;
  BasicByteWriter<std::string&, 8> writer(text);
  writer.put(std::uint8_t{1});
  writer.put_text("nine byte");
  writer.put_list(std::vector<double>{});
  EXPECT_EQ(text,
            std::string("\1\0\0\0\0\0\0\0\11\0\0\0\0\0\0\0nine byte\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 40));
  AlignedByteReader reader{std::string_view(text)};
  EXPECT_EQ(reader.get<std::uint8_t>(), 1);
  const auto list = reader.get_list<char>();
  EXPECT_EQ(std::string_view(static_cast<const char*>(list.first), list.count), "nine byte");
  EXPECT_EQ(reader.get_count(), 0u);
  reader.expect_end();
}

TEST(Bytes, NothingIsWrittenBeyondTheRoom) {
  for (std::size_t size = 0; size <= 40; ++size) {
    Bytes room(48, std::byte{0xee});
    AlignedByteWriter writer({room.data(), size});
    writer.put_text("four");
    writer.put(std::uint64_t{1});
    writer.put(std::uint64_t{2});
    writer.put_at(16, std::uint64_t{3});
    EXPECT_EQ(writer.size(), 32u);
    EXPECT_EQ(writer.fits(), size >= 32) << size;
    for (std::size_t i = size; i < room.size(); ++i) EXPECT_EQ(room[i], std::byte{0xee}) << size;
  }
}

TEST(Bytes, WithoutRoomItMeasures) {
  AlignedByteWriter measure({});
  measure.put_text("a text of some length");
  measure.put(std::uint32_t{1});
  EXPECT_EQ(measure.size(), 8u + 24 + 8);
}

TEST(Bytes, WhatWasPutIsWrittenOver) {
  std::string text = "before";
  ByteAppender writer(text);
  writer.put(std::uint16_t{1});
  const std::size_t at = writer.size();
  writer.put(std::uint16_t{0});
  writer.put_raw("after");
  writer.put_at(at, std::uint16_t{0x4142});
  EXPECT_EQ(text, std::string("before\1\0BAafter", 15));
}

TEST(Bytes, EveryLengthTooShortIsRefused) {
  std::string text;
  BasicByteWriter<std::string&, 8> writer(text);
  writer.put(1.0);
  writer.put_text("nine byte");
  writer.put_list(std::vector<std::uint32_t>{1, 2, 3});
  const auto read = [](std::string_view bytes) {
    AlignedByteReader reader(bytes);
    reader.get<double>();
    reader.get_text();
    reader.copy_list<std::uint32_t>();
    reader.expect_end();
  };
  for (std::size_t size = 0; size < text.size(); ++size) {
    EXPECT_EQ(fault([&] { read(std::string_view(text).substr(0, size)); }), "less than it says") << size;
  }
  EXPECT_EQ(fault([&] { read(text); }), "");
  text += '\0';
  EXPECT_EQ(fault([&] { read(text); }), "more bytes than belong to it");
}

TEST(Bytes, ShortBytesSayWhere) {
  ByteReader reader(std::string_view("\5\0\0\0abc", 7));
  try {
    reader.take_raw(reader.get<std::uint32_t>());
    FAIL();
  } catch (const BadBytes& bad) {
    EXPECT_EQ(bad.wanted, 5u);
    EXPECT_EQ(bad.at, 4u);
    EXPECT_EQ(bad.total, 7u);
  }
}

TEST(Bytes, WildCountsTakeNoMemory) {
  for (const std::uint64_t count : {std::uint64_t{3}, std::uint64_t{1} << 32, std::uint64_t{1} << 61,
                                    std::numeric_limits<std::uint64_t>::max()}) {
    std::string text;
    ByteAppender writer(text);
    writer.put(count);
    writer.put(std::uint64_t{0});
    EXPECT_NE(fault([&] { ByteReader(text).copy_list<double>(); }), "") << count;
    EXPECT_NE(fault([&] { AlignedByteReader(text).copy_list<char>(); }) == "", count > 8) << count;
    EXPECT_EQ(fault([&] { AlignedByteReader(text).get_count(); }), "a count of more than there is") << count;
    EXPECT_EQ(fault([&] { ByteReader(text).get_count(16); }), "a count of more than there is") << count;
  }
}

TEST(Bytes, ValuesAreLoadedAndStoredAtAnyAddress) {
  std::array<std::byte, 9> bytes{};
  store(bytes.data() + 1, -1.5);
  EXPECT_EQ(load<double>(bytes.data() + 1), -1.5);
  EXPECT_EQ(bytes[0], std::byte{0});
}

TEST(Bytes, RangesDoNotWrap) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  EXPECT_TRUE(lies_within(0, 0, 0));
  EXPECT_TRUE(lies_within(4, 0, 4));
  EXPECT_TRUE(lies_within(1, 3, 4));
  EXPECT_FALSE(lies_within(1, 4, 4));
  EXPECT_FALSE(lies_within(5, 0, 4));
  EXPECT_FALSE(lies_within(1, kMost, 4));
  EXPECT_FALSE(lies_within(kMost, 1, 4));
}

}  // namespace
}  // namespace hallway
