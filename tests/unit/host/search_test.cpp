// SPDX-License-Identifier: MIT
#include "host/load/search.hpp"

#include <gtest/gtest.h>

#include "base/file.hpp"
#include "fixtures.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"

namespace hallway::host {
namespace {

namespace fs = std::filesystem;

/// A folder with example_c under its own name, and nothing else.
class Search : public testing::Test {
 protected:
  Search() { fs::copy_file(EXAMPLE, folder_ / "example_c.so"); }

  std::string problem_of(std::string_view wanted, const std::vector<fs::path>& folders) {
    const auto error = test::error_of([&] { find_plugin(wanted, folders); });
    if (!error) return "";
    EXPECT_EQ(error->code(), ErrorCode::kPluginLoad);
    return error->what();
  }
  static testing::AssertionResult says(const std::string& message, const std::string& part) {
    if (message.find(part) != std::string::npos) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "\"" << message << "\" does not say \"" << part << "\"";
  }

  test::TempFolder folder_;
  test::TempFolder other_folder_;
};

TEST_F(Search, AnIdIsFoundUnderItsName) {
  const std::vector<fs::path> folders = {folder_.path()};
  const Found found = find_plugin("example_c", folders);
  EXPECT_EQ(found.info->id, "example_c");
  EXPECT_EQ(found.library->file(), folder_ / "example_c.so");
}

TEST_F(Search, AnEarlierFolderComesFirst) {
  fs::copy_file(EXAMPLE, other_folder_ / "example_c.so");
  const std::vector<fs::path> folders = {other_folder_.path(), folder_.path()};
  EXPECT_EQ(find_plugin("example_c", folders).library->file(), other_folder_ / "example_c.so");
}

TEST_F(Search, AnIdIsFoundInAFileOfAnotherName) {
  fs::rename(folder_ / "example_c.so", folder_ / "renamed.so");
  const std::vector<fs::path> folders = {folder_.path()};
  EXPECT_EQ(find_plugin("example_c", folders).library->file(), folder_ / "renamed.so");
}

TEST_F(Search, AFileIsTakenAsItIs) {
  EXPECT_EQ(find_plugin(EXAMPLE, {}).info->id, "example_c");
}

TEST_F(Search, OneOfSeveralPluginsOfAFile) {
  EXPECT_EQ(test_fixtures::find_fixture("misbehaves.so:needs_depth").info->id, "needs_depth");
}

TEST_F(Search, AFileWithSeveralPluginsNeedsAnId) {
  const std::string problem = problem_of(std::string(FIXTURES) + "/misbehaves.so", {});
  EXPECT_TRUE(says(problem, "several plugins"));
  EXPECT_TRUE(says(problem, "ids found: throws_in_create, needs_depth, misbehaves"));
}

TEST_F(Search, AnUnknownIdInAFileIsNamedWithASuggestion) {
  const std::string problem = problem_of(std::string(FIXTURES) + "/misbehaves.so:need_depth", {});
  EXPECT_TRUE(says(problem, "no plugin `need_depth`"));
  EXPECT_TRUE(says(problem, "did you mean \"needs_depth\""));
}

TEST_F(Search, AFailureListsFoldersIdsAndASuggestion) {
  const std::string problem = problem_of("exampel_c", {folder_.path(), "/nowhere/at/all"});
  EXPECT_TRUE(says(problem, "there is no plugin `exampel_c` (did you mean \"example_c\"?)"));
  EXPECT_TRUE(says(problem, "folders searched: " + folder_.path().string() +
                                ", /nowhere/at/all (there is no such folder)"));
  EXPECT_TRUE(says(problem, "ids found: example_c"));
}

TEST_F(Search, AFailureListsFilesThatCannotBeLoaded) {
  folder_.write("broken.so", "text");
  const std::string problem = problem_of("absent", {folder_.path()});
  EXPECT_TRUE(says(problem, "not loadable: " + (folder_ / "broken.so").string() + ": is not an ELF file"));
}

TEST_F(Search, AFailureWithoutFoldersSaysSo) {
  EXPECT_TRUE(says(problem_of("absent", {}), "folders searched: none; ids found: none"));
}

TEST_F(Search, ABrokenFileUnderTheWantedNameIsTheReason) {
  folder_.write("slam.so", "text");
  EXPECT_TRUE(
      says(problem_of("slam", {folder_.path()}), (folder_ / "slam.so").string() + ": is not an ELF file"));
}

TEST_F(Search, AnIdWithASlashIsAFile) {
  EXPECT_TRUE(says(problem_of("../example_c", {folder_.path()}), "does not exist"));
}

TEST_F(Search, AnIdIsNotEchoedRaw) {
  EXPECT_EQ(problem_of("\033[31m", {folder_.path()}).find('\033'), std::string::npos);
}

TEST_F(Search, AListHasPluginsAndProblemsInOrderOfNames) {
  folder_.write("a_text.so", "text");
  folder_.write("z_text.txt", "no library");
  const std::vector<fs::path> folders = {folder_.path(), "/nowhere/at/all"};
  const auto listed = list_libraries(folders);
  ASSERT_EQ(listed.size(), 2u);
  EXPECT_EQ(listed[0].file, folder_ / "a_text.so");
  EXPECT_TRUE(says(listed[0].problem, "is not an ELF file"));
  ASSERT_EQ(listed[1].plugins.size(), 1u);
  EXPECT_EQ(listed[1].plugins[0].id, "example_c");
  EXPECT_EQ(listed[1].problem, "");
}

TEST_F(Search, TheDefaultFolderStandsBesideTheExecutablesFolder) {
  const fs::path folder = default_plugin_folder();
  EXPECT_TRUE(folder.is_absolute());
  EXPECT_EQ(folder, fs::canonical("/proc/self/exe").parent_path().parent_path() / "lib/hallway/plugins");
}

}  // namespace
}  // namespace hallway::host
