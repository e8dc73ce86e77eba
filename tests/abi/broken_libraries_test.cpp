// SPDX-License-Identifier: MIT
#include <elf.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <string>

#include "base/file.hpp"
#include "host/plugin.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"

namespace hallway::host {
namespace {

namespace fs = std::filesystem;

fs::path fixture(const std::string& name) {
  return fs::path(FIXTURES) / (name + ".so");
}

/// Why a file cannot be loaded; empty if it can.
std::string load_problem(const fs::path& file) {
  const auto error = test::error_of([&] { Library::load(file); });
  if (!error) return "";
  EXPECT_EQ(error->code(), ErrorCode::kPluginLoad);
  EXPECT_EQ(error->where().file, file.string()) << "the message must name the file";
  return error->message();
}

testing::AssertionResult says(const std::string& message, const std::string& part) {
  if (message.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\"" << message << "\" does not say \"" << part << "\"";
}

/// The bytes of a good plugin, to be damaged.
std::string good_bytes() {
  return read_file(fixture("minimal"));
}

TEST(BrokenLibraries, AWholeOneLoads) {
  const auto library = Library::load(fixture("minimal"));
  ASSERT_EQ(library->plugins().size(), 1u);
  EXPECT_EQ(library->plugins()[0].id, "minimal");
}

TEST(BrokenLibraries, AnotherMinorVersionLoads) {
  EXPECT_EQ(load_problem(fixture("other_abi_minor")), "");
}

TEST(BrokenLibraries, DoesNotExist) {
  EXPECT_TRUE(says(load_problem("/nowhere/at/all.so"), "does not exist"));
}

TEST(BrokenLibraries, AFolder) {
  const test::TempFolder folder;
  EXPECT_TRUE(says(load_problem(folder.path()), "is not a regular file"));
}

TEST(BrokenLibraries, AnEmptyFile) {
  const test::TempFolder folder;
  EXPECT_TRUE(says(load_problem(folder.write("a.so", "")), "is not an ELF file"));
}

TEST(BrokenLibraries, ATextFile) {
  const test::TempFolder folder;
  EXPECT_TRUE(says(load_problem(folder.write("a.so", "#!/bin/sh\nexit 0\n")), "is not an ELF file"));
}

TEST(BrokenLibraries, AnElfFileOfAnotherMachine) {
  const test::TempFolder folder;
  std::string bytes = good_bytes();
  const Elf64_Half machine = EM_RISCV;
  std::memcpy(&bytes[offsetof(Elf64_Ehdr, e_machine)], &machine, sizeof machine);
  EXPECT_TRUE(says(load_problem(folder.write("a.so", bytes)), "is for another architecture: RISC-V"));
}

TEST(BrokenLibraries, AnElfFileOf32Bits) {
  const test::TempFolder folder;
  std::string bytes = good_bytes();
  bytes[EI_CLASS] = ELFCLASS32;
  EXPECT_TRUE(says(load_problem(folder.write("a.so", bytes)), "is for another architecture"));
}

TEST(BrokenLibraries, AnElfFileThatIsNoSharedObject) {
  const test::TempFolder folder;
  std::string bytes = good_bytes();
  const Elf64_Half type = ET_REL;
  std::memcpy(&bytes[offsetof(Elf64_Ehdr, e_type)], &type, sizeof type);
  EXPECT_TRUE(says(load_problem(folder.write("a.so", bytes)), "not a shared object"));
}

TEST(BrokenLibraries, AnElfFileCutAnywhere) {
  const test::TempFolder folder;
  const std::string bytes = good_bytes();
  // The section headers end the file, so that every cut takes something away that a header announces.
  for (std::size_t size = 4; size < bytes.size(); size += 331) {
    const std::string problem = load_problem(folder.write("a.so", std::string_view(bytes).substr(0, size)));
    EXPECT_TRUE(says(problem, size < sizeof(Elf64_Ehdr) ? "is " : "is cut off")) << "at byte " << size;
  }
}

TEST(BrokenLibraries, AnElfFileWithAFlippedHeaderByteNeverEndsTheProcess) {
  const test::TempFolder folder;
  const std::string bytes = good_bytes();
  for (std::size_t at = 0; at < sizeof(Elf64_Ehdr); ++at) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(~damaged[at]);
    const std::string problem = load_problem(folder.write("a" + std::to_string(at) + ".so", damaged));
    // Some bytes matter to nobody: of those, all that is asked for is an answer.
    if (at < SELFMAG) {
      EXPECT_TRUE(says(problem, "ELF")) << "byte " << at;
    }
  }
}

TEST(BrokenLibraries, NoEntrySymbolIsSeenBeforeItsCodeRuns) {
  EXPECT_TRUE(says(load_problem(fixture("no_entry")), "has no entry symbol hw_entry"));
}

TEST(BrokenLibraries, AnotherMajorVersionIsSeenBeforeItsCodeRuns) {
  EXPECT_TRUE(says(load_problem(fixture("other_abi_major")), "was built for version 7.3 of the plugin ABI"));
}

TEST(BrokenLibraries, NeedsALibraryThatIsMissing) {
  const std::string problem = load_problem(fixture("needs_missing_library"));
  EXPECT_TRUE(says(problem, "needs a library that is missing"));
  EXPECT_TRUE(says(problem, "libmissing_library.so"));
}

/// Of a library whose code would end the process: its file, with a symbol version that no C library has.
TEST(BrokenLibraries, NeedsANewerCLibraryIsSeenBeforeItsCodeRuns) {
  const test::TempFolder folder;
  std::string bytes = read_file(fixture("crashes_in_static_constructor"));
  const std::string version("GLIBC_2.2.5", 12);
  ASSERT_NE(bytes.find(version), std::string::npos);
  for (std::size_t at = 0; (at = bytes.find(version, at)) != std::string::npos;)
    bytes.replace(at, 11, "GLIBC_9.9.9");
  const std::string problem = load_problem(folder.write("a.so", bytes));
  EXPECT_TRUE(says(problem, "cannot be loaded"));
  EXPECT_TRUE(says(problem, "version `GLIBC_9.9.9' not found"));
}

TEST(BrokenLibraries, NullFunctionsInTheEntry) {
  EXPECT_TRUE(says(load_problem(fixture("null_entry_functions")), "null functions in its entry"));
}

TEST(BrokenLibraries, NoFactory) {
  EXPECT_TRUE(says(load_problem(fixture("no_factory")), "has no factory hw.plugin-factory/1"));
}

TEST(BrokenLibraries, NullFunctionsInTheFactory) {
  EXPECT_TRUE(says(load_problem(fixture("null_factory_functions")), "null functions in its factory"));
}

TEST(BrokenLibraries, NullFunctionsInTheVtable) {
  const auto error =
      test::error_of([] { Plugin plugin(find_plugin(fixture("null_vtable_functions").string(), {})); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kPluginLoad);
  EXPECT_TRUE(says(error->message(), "null functions in its vtable"));
}

TEST(BrokenLibraries, InitFailsWithAReason) {
  EXPECT_TRUE(says(load_problem(fixture("init_fails")), "the licence dongle is not there (HW_ERROR_IO)"));
}

TEST(BrokenLibraries, InitFailsWithoutAReason) {
  EXPECT_TRUE(says(load_problem(fixture("init_fails_silently")), "no reason but HW_ERROR_IO"));
}

TEST(BrokenLibraries, TwoPluginsOfOneId) {
  EXPECT_TRUE(says(load_problem(fixture("duplicate_ids")), "two plugins of the id `minimal`"));
}

TEST(BrokenLibraries, ANameThatIsNull) {
  EXPECT_TRUE(says(load_problem(fixture("null_name")), "its name is null"));
}

TEST(BrokenLibraries, AnIdThatIsNoIdIsNotEchoedRaw) {
  const std::string problem = load_problem(fixture("bad_id"));
  EXPECT_TRUE(says(problem, "its id"));
  EXPECT_EQ(problem.find('\033'), std::string::npos);
}

TEST(BrokenLibraries, AFailedLoadLeavesNothingBehind) {
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(load_problem(fixture("init_fails")).empty());
  for (int i = 0; i < 50; ++i) EXPECT_EQ(load_problem(fixture("minimal")), "");
}

}  // namespace
}  // namespace hallway::host
