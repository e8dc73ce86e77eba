// SPDX-License-Identifier: MIT
#include "base/spill_list.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "support/temp_folder.hpp"

namespace hallway {
namespace {

struct Record {
  std::uint64_t number = 0;
  double values[3]{};
};

Record numbered(std::uint64_t i) {
  return {i, {0.5 * static_cast<double>(i), -1.0, 3.0}};
}

/// Of many windows and a part of one.
constexpr std::uint64_t kMany = 25'001;

class Spilling : public testing::TestWithParam<bool> {
 protected:
  SpillList<Record> empty_list() const { return SpillList<Record>(GetParam() ? folder_.path() : ""); }
  const test::TempFolder folder_;
};

TEST_P(Spilling, GivesBackWhatWasAdded) {
  SpillList<Record> list = empty_list();
  EXPECT_TRUE(list.empty());
  EXPECT_EQ(SpillList<Record>::Reader(list).next(), nullptr);
  for (std::uint64_t i = 0; i < kMany; ++i) {
    list.push_back(numbered(i));
    ASSERT_EQ(list.size(), i + 1);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path())) << "the file is in no listing";
  SpillList<Record>::Reader first(list), second(list);
  for (std::uint64_t i = 0; i < kMany; ++i) {
    const Record* record = first.next();
    ASSERT_NE(record, nullptr);
    ASSERT_EQ(record->number, i);
    ASSERT_EQ(record->values[0], 0.5 * static_cast<double>(i));
    if (i % 2 == 0) {
      ASSERT_EQ(second.next()->number, i / 2) << "readers go on by themselves";
    }
    ASSERT_EQ(list[kMany - 1 - i].number, kMany - 1 - i);
  }
  EXPECT_EQ(first.next(), nullptr);
}

TEST_P(Spilling, ReplacesRecords) {
  SpillList<Record> list = empty_list();
  for (std::uint64_t i = 0; i < kMany; ++i) list.push_back(numbered(i));
  for (std::uint64_t i = 0; i < kMany; i += 100) list.set(i, numbered(i + 7));
  SpillList<Record> moved = std::move(list);
  SpillList<Record>::Reader reader(moved);
  for (std::uint64_t i = 0; i < kMany; ++i) ASSERT_EQ(reader.next()->number, i % 100 == 0 ? i + 7 : i);
  moved.clear();
  EXPECT_EQ(moved.size(), 0u);
  moved.push_back(numbered(5));
  EXPECT_EQ(moved[0].number, 5u);
}

INSTANTIATE_TEST_SUITE_P(SpillList, Spilling, testing::Bool(),
                         [](const auto& kind) { return kind.param ? "OnDisk" : "InMemory"; });

TEST(SpillList, NamesTheFolderWhereThereIsNone) {
  const test::TempFolder folder;
  SpillList<Record> list(folder.path() / "gone");
  try {
    for (std::uint64_t i = 0; i < kMany; ++i) list.push_back(numbered(i));
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kIo);
    EXPECT_NE(std::string(error.what()).find("gone"), std::string::npos) << error.what();
  }
}

TEST(SpillList, AFileThatMayNotGrowIsAnError) {
  const test::TempFolder folder;
  struct rlimit before {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  struct rlimit small = before;
  small.rlim_cur = 1u << 17;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  SpillList<Record> list(folder.path());
  EXPECT_THROW(
      {
        for (std::uint64_t i = 0; i < kMany; ++i) list.push_back(numbered(i));
      },
      Error);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
}

}  // namespace
}  // namespace hallway
