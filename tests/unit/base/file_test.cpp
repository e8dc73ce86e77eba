// SPDX-License-Identifier: MIT
#include "base/file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"

namespace hallway {
namespace {

namespace fs = std::filesystem;

/// Reading `path` must fail, and the message must name the path and hold `cause`.
void expect_unreadable(const fs::path& path, const std::string& cause,
                       std::uint64_t max_bytes = kMaxFileBytes) {
  const auto error = test::error_of([&] { read_file(path, max_bytes); });
  ASSERT_TRUE(error.has_value()) << path;
  EXPECT_EQ(error->code(), ErrorCode::kIo);
  EXPECT_EQ(error->where().file, path.string());
  EXPECT_NE(error->message().find(cause), std::string::npos) << error->what();
}

std::size_t entries_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// While it lives, this process can write no file beyond `bytes`: a disk that is full, also for root.
class WriteLimit {
 public:
  explicit WriteLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~WriteLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  WriteLimit(const WriteLimit&) = delete;
  WriteLimit& operator=(const WriteLimit&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST(ReadFile, GivesEveryByte) {
  const test::TempFolder folder;
  std::string content;
  for (int i = 0; i < 100'000; ++i) content += static_cast<char>(i * 7);
  EXPECT_EQ(read_file(folder.write("a", content)), content);
}

TEST(ReadFile, AnEmptyFileIsEmpty) {
  const test::TempFolder folder;
  EXPECT_EQ(read_file(folder.write("a", "")), "");
}

TEST(ReadFile, RefusesAMissingFile) {
  const test::TempFolder folder;
  expect_unreadable(folder / "none", "No such file");
}

TEST(ReadFile, RefusesAFolder) {
  const test::TempFolder folder;
  expect_unreadable(folder.path(), "is a folder");
}

TEST(ReadFile, RefusesAPipeWithoutWaitingForAWriter) {
  const test::TempFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  expect_unreadable(folder / "pipe", "not a regular file");
}

TEST(ReadFile, RefusesADevice) {
  expect_unreadable("/dev/zero", "not a regular file");
}

TEST(ReadFile, RefusesALinkThatLeadsToItself) {
  const test::TempFolder folder;
  fs::create_symlink("loop", folder / "loop");
  expect_unreadable(folder / "loop", "symbolic links");
}

TEST(ReadFile, RefusesAPathThroughAFile) {
  const test::TempFolder folder;
  expect_unreadable(folder.write("file", "x") / "below", "Not a directory");
}

TEST(ReadFile, RefusesWhatIsTooLargeWithoutReadingIt) {
  const test::TempFolder folder;
  const fs::path file = folder.write("large", "");
  fs::resize_file(file, std::uintmax_t{1} << 40);  // a hole: takes no space
  expect_unreadable(file, "at most");
}

TEST(ReadFile, TakesExactlyTheLimit) {
  const test::TempFolder folder;
  const fs::path file = folder.write("a", "12345");
  EXPECT_EQ(read_file(file, 5), "12345");
  expect_unreadable(file, "5 bytes; at most 4", 4);
}

TEST(ReadFile, ShowsAStrangePathSafely) {
  const test::TempFolder folder;
  const auto error = test::error_of([&] { read_file(folder / "a\x1b[31m"); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(std::string(error->what()).find('\x1b'), std::string::npos);
}

TEST(WriteFileAtomically, ReplacesTheOldContentAndLeavesNothingBeside) {
  const test::TempFolder folder;
  const fs::path file = folder / "a";
  write_file_atomically(file, "a longer old text");
  write_file_atomically(file, "new");
  EXPECT_EQ(read_file(file), "new");
  EXPECT_EQ(entries_in(folder.path()), 1u);
}

TEST(WriteFileAtomically, KeepsTheOldContentWhereTheDiskIsFull) {
  const test::TempFolder folder;
  const fs::path file = folder.write("a", "old");
  {
    const WriteLimit limit(4096);
    const auto error = test::error_of([&] { write_file_atomically(file, std::string(1 << 20, 'x')); });
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->code(), ErrorCode::kIo);
  }
  EXPECT_EQ(read_file(file), "old");
  EXPECT_EQ(entries_in(folder.path()), 1u);
}

TEST(WriteFileAtomically, NamesTheFileWhereTheFolderIsMissing) {
  const test::TempFolder folder;
  const fs::path file = folder / "none" / "a";
  const auto error = test::error_of([&] { write_file_atomically(file, "x"); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->where().file, file.string());
}

TEST(WriteFileAtomically, RefusesAFolder) {
  const test::TempFolder folder;
  fs::create_directory(folder / "sub");
  EXPECT_TRUE(test::error_of([&] { write_file_atomically(folder / "sub", "x"); }).has_value());
  EXPECT_TRUE(fs::is_directory(folder / "sub"));
}

TEST(WriteFileAtomically, PutsNoFileInThePlaceOfAPipe) {
  const test::TempFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_TRUE(test::error_of([&] { write_file_atomically(folder / "pipe", "x"); }).has_value());
  EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
}

TEST(UnfinishedFile, IsKnownByItsName) {
  EXPECT_EQ(unfinished_file_of("top.png.tmp-13790"), "top.png");
  EXPECT_EQ(unfinished_file_of("a.tmp-1.tmp-2"), "a.tmp-1");
  for (const char* name : {"", "top.png", "top.png.tmp-", "top.png.tmp-1a", "top.png.tmp1"})
    EXPECT_EQ(unfinished_file_of(name), "") << name;
}

TEST(UnfinishedFile, IsWhatAWriterLeavesThatWasKilled) {
  const test::TempFolder folder;
  const auto write = [&] {
    const rlimit limit{0, 0};
    ::setrlimit(RLIMIT_FSIZE, &limit);  // the first byte ends it
    write_file_atomically(folder / "top.png", "x");
  };
  EXPECT_EXIT(write(), testing::KilledBySignal(SIGXFSZ), "");
  std::vector<std::string> left;
  for (const auto& entry : fs::directory_iterator(folder.path())) left.push_back(entry.path().filename());
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(unfinished_file_of(left[0]), "top.png");
}

TEST(MakeFolder, MakesParentsAndTakesWhatIsThere) {
  const test::TempFolder folder;
  make_folder(folder / "a/b/c");
  make_folder(folder / "a/b/c");
  EXPECT_TRUE(fs::is_directory(folder / "a/b/c"));
}

TEST(MakeFolder, RefusesAFileInThePlace) {
  const test::TempFolder folder;
  const fs::path file = folder.write("a", "x");
  EXPECT_TRUE(test::error_of([&] { make_folder(file); }).has_value());
  EXPECT_TRUE(test::error_of([&] { make_folder(file / "b"); }).has_value());
  EXPECT_EQ(read_file(file), "x");
}

}  // namespace
}  // namespace hallway
