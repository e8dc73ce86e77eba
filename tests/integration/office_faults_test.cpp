// SPDX-License-Identifier: MIT
// An office of the first robot is written whole or not at all, whichever write to the disk fails.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "support/process.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;

using Content = std::map<std::string, std::string>;  // of files, by their names

constexpr long kOfficeFiles = 4;

Content content_of(const fs::path& folder) {
  Content content;
  for (const auto& entry : fs::directory_iterator(folder))
    content[entry.path().filename().string()] = read_file(entry.path());
  return content;
}

fs::path shim() {
  return binary_folder() / "tests" / "libfailing_io.so";
}

/// @param at     the write that fails; 0: none
/// @param count  where the number of writes goes
Ended make_office(const fs::path& folder, const std::string& seed, long at, const fs::path& count) {
  return hallway({"study", "first-robot", "--make-office", seed, "--out", folder / "office.map", "--force"},
                 {},
                 {"LD_PRELOAD=" + shim().string(), "FAILING_IO_AT=" + std::to_string(at),
                  "FAILING_IO_HOW=error", "FAILING_IO_COUNT=" + count.string(), "PATH=/usr/bin:/bin"});
}

TEST(OfficeFaults, AWriteThatFailsLeavesTheOfficeThatWasThere) {
  if (!fs::exists(shim()))
    GTEST_SKIP() << "needs a build without sanitizers: the library that makes writes fail is not there";
  const TempFolder beside, folder;
  const fs::path count = beside / "count";
  ASSERT_EQ(make_office(folder.path(), "2", 0, count).status, 0);
  const long writes = std::strtol(read_file(count).c_str(), nullptr, 10);
  const Content made = content_of(folder.path());
  ASSERT_EQ(made.size(), static_cast<std::size_t>(kOfficeFiles));
  ASSERT_GT(writes, 3 * kOfficeFiles);
  for (long at = 1; at <= writes; ++at) {
    SCOPED_TRACE(at);
    ASSERT_EQ(make_office(folder.path(), "1", 0, beside / "other_count").status, 0);
    const Content before = content_of(folder.path());
    ASSERT_NE(before, made);
    const Ended ended = make_office(folder.path(), "2", at, count);
    const Content after = content_of(folder.path());
    if (ended.status == 0) {  // a folder that cannot be synced is no error
      EXPECT_TRUE(after == made);
      continue;
    }
    EXPECT_EQ(ended.status, 3) << ended.err;
    EXPECT_NE(ended.err.find("office"), std::string::npos) << ended.err;
    EXPECT_EQ(after.size(), before.size()) << "parts are left";
    if (at <= writes - kOfficeFiles) {  // the last ones only rename what is on the disk
      EXPECT_TRUE(after == before);
    }
  }
}

}  // namespace
}  // namespace hallway::test
