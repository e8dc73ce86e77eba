// SPDX-License-Identifier: MIT
#include "record/output_folder.hpp"

#include <gtest/gtest.h>

#include "base/file.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"

namespace hallway::record {
namespace {

namespace fs = std::filesystem;

TEST(OutputFolder, AppearsAtCommitAndNotBefore) {
  const test::TempFolder folder;
  {
    OutputFolder output(folder / "run", false);
    write_file_atomically(output.working_path() / "run.json", "{}");
    EXPECT_FALSE(fs::exists(folder / "run"));
    output.commit();
  }
  EXPECT_EQ(read_file(folder / "run/run.json"), "{}");
}

TEST(OutputFolder, LeavesNothingWithoutCommit) {
  const test::TempFolder folder;
  { const OutputFolder output(folder / "run", false); }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(OutputFolder, KeepsTheOldOneWithoutCommit) {
  const test::TempFolder folder;
  fs::create_directory(folder / "run");
  folder.write("run/run.json", "old");
  { const OutputFolder output(folder / "run", true); }
  EXPECT_EQ(read_file(folder / "run/run.json"), "old");
}

TEST(OutputFolder, CommitExchangesTheOldOneWhole) {
  const test::TempFolder folder;
  fs::create_directory(folder / "run");
  folder.write("run/run.json", "old");
  folder.write("run/more", "old");
  {
    OutputFolder output(folder / "run", true);
    write_file_atomically(output.working_path() / "run.json", "new");
    output.commit();
  }
  EXPECT_EQ(read_file(folder / "run/run.json"), "new");
  EXPECT_FALSE(fs::exists(folder / "run/more"));
}

TEST(OutputFolder, WhatAppearedMeanwhileIsNotReplaced) {
  const test::TempFolder folder;
  OutputFolder output(folder / "run", false);
  fs::create_directory(folder / "run");
  folder.write("run/other", "somebody else's");
  const auto error = test::error_of([&] { output.commit(); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kIo);
  EXPECT_EQ(read_file(folder / "run/other"), "somebody else's");
}

TEST(OutputFolder, SlashAtTheEndMeansTheSameFolder) {
  const test::TempFolder folder;
  OutputFolder output((folder / "run").string() + "/", false);
  output.commit();
  EXPECT_TRUE(fs::is_directory(folder / "run"));
}

TEST(OutputFolder, MakesMissingParents) {
  const test::TempFolder folder;
  OutputFolder output(folder / "a/b/run", false);
  output.commit();
  EXPECT_TRUE(fs::is_directory(folder / "a/b/run"));
}

TEST(OutputFolder, RefusesNamesThatAreNone) {
  const test::TempFolder folder;
  for (const fs::path& path : {fs::path("."), fs::path(".."), fs::path("/"), fs::path("")}) {
    const auto error = test::error_of([&] { const OutputFolder output(path, true); });
    ASSERT_TRUE(error) << path;
    EXPECT_EQ(error->code(), ErrorCode::kIo);
  }
}

}  // namespace
}  // namespace hallway::record
