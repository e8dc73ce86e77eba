// SPDX-License-Identifier: MIT
//
// What binutils say of the same files is the oracle.
#include "host/machine/library_facts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "host/machine/machine_profile.hpp"
#include "support/errors.hpp"
#include "support/process.hpp"
#include "support/temp_folder.hpp"

namespace hallway::host {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const std::vector<std::string>& command) {
  const test::Ended ended = test::Process(command).wait();
  EXPECT_EQ(ended.status, 0) << ended.err;
  std::vector<std::string> lines;
  for (const std::string_view line : split(ended.out, '\n')) lines.emplace_back(line);
  return lines;
}

/// What stands between two marks in each line that has both.
std::vector<std::string> between(const std::vector<std::string>& lines, const std::string& before,
                                 const std::string& open, const std::string& close) {
  std::vector<std::string> found;
  for (const std::string& line : lines) {
    const std::size_t mark = line.find(before);
    if (mark == std::string::npos) continue;
    const std::size_t begin = line.find(open, mark) + open.size();
    found.push_back(line.substr(begin, line.find(close, begin) - begin));
  }
  return found;
}

/// Libraries of every kind there is here: ours, C and C++, with versions of their own and without.
std::vector<fs::path> libraries() {
  std::vector<fs::path> files{EXAMPLE, fs::path(PLUGINS) / "slam_point.so"};
  for (const char* folder : {"/usr/lib/x86_64-linux-gnu", "/usr/lib/aarch64-linux-gnu"}) {
    for (const char* name : {"libstdc++.so.6", "libm.so.6", "libc.so.6", "libz.so.1", "libpng16.so.16"}) {
      if (fs::exists(fs::path(folder) / name)) files.push_back(fs::path(folder) / name);
    }
  }
  return files;
}

TEST(LibraryFacts, AgreeWithReadelfAndNm) {
  for (const fs::path& file : libraries()) {
    SCOPED_TRACE(file);
    const LibraryFacts facts = read_library_facts(file);
    EXPECT_EQ(facts.problem, "");
    EXPECT_TRUE(facts.whole && facts.shared_object && facts.symbols_known);
    EXPECT_EQ(facts.needed, between(lines_of({"/usr/bin/readelf", "-dW", file}), "(NEEDED)", "[", "]"));
    // readelf -V lists needed versions as "Name: GLIBC_2.34", defined ones as "Rev: 1 ... Name: GLIBCXX_3.4".
    std::multiset<std::string> wanted, needed, offered, defined;
    for (const std::string& line : lines_of({"/usr/bin/readelf", "-VW", file})) {
      const auto name = between({line}, "Name: ", "Name: ", " ");
      if (name.empty()) continue;
      const bool definition = line.find("Rev: ") != std::string::npos;
      if (definition) defined.insert(name[0]);
      if (!definition && line.find("Version: ") != std::string::npos) needed.insert(name[0]);
    }
    for (const NeededVersion& version : facts.needed_versions) wanted.insert(version.version);
    for (const std::string& version : facts.defined_versions) offered.insert(version);
    EXPECT_EQ(wanted, needed);
    EXPECT_EQ(offered, defined);
    std::set<std::string> symbols;
    for (const std::string& line : lines_of({"/usr/bin/nm", "-D", "--defined-only", file})) {
      const std::size_t blank = line.rfind(' ');
      if (blank == std::string::npos || line.find(" A ") != std::string::npos) continue;
      symbols.insert(line.substr(blank + 1, line.find('@') - blank - 1));
    }
    std::set<std::string> exported(facts.exports.begin(), facts.exports.end());
    // nm also lists names of kinds that no program is linked against by, such as indirect functions.
    for (const std::string& name : exported) EXPECT_TRUE(symbols.contains(name)) << name;
    if (file.string().find("/usr/lib") == std::string::npos) {
      EXPECT_EQ(exported, symbols);
    }
  }
}

TEST(LibraryFacts, OfAPluginAreItsEntryAndItsAbi) {
  const LibraryFacts facts = read_library_facts(EXAMPLE);
  ASSERT_TRUE(facts.abi);
  EXPECT_EQ(facts.abi->abi_major, HW_ABI_MAJOR);
  EXPECT_EQ(facts.exports, std::vector<std::string>{"hw_entry"});
  EXPECT_FALSE(read_library_facts(libraries().back()).abi);
}

/// Whatever is wrong in a file is told, and nothing is read that is not there.
TEST(LibraryFacts, DamagedFilesHaveAProblemOrOtherFacts) {
  const test::TempFolder folder;
  const std::string whole = read_file(EXAMPLE);
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 16) {
    const LibraryFacts facts = read_library_facts(folder.write("cut.so", whole.substr(0, size)));
    EXPECT_NE(facts.problem, "") << size << " bytes";
    EXPECT_FALSE(facts.whole);
  }
  for (std::size_t at = 0; at < whole.size(); at += at < 512 ? 1 : 41) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(~damaged[at]);
    EXPECT_EQ(test::error_of([&] { read_library_facts(folder.write("bad.so", damaged)); }), std::nullopt)
        << "byte " << at;
  }
}

TEST(LibraryFacts, NameTheMachineOfForeignFiles) {
  const test::TempFolder folder;
  std::string header(64, '\0');
  header.replace(0, 4, "\177ELF");
  const auto machine = [&](char word_size, char order, char low, char high) {
    header[4] = word_size, header[5] = order, header[18] = low, header[19] = high;
    const LibraryFacts facts = read_library_facts(folder.write("a.so", header));
    EXPECT_NE(facts.problem, "");
    return facts.machine;
  };
  EXPECT_EQ(machine(1, 1, 40, 0), "32-bit ARM");
  EXPECT_EQ(machine(1, 1, 3, 0), "i386, 32-bit");
  EXPECT_EQ(machine(2, 2, 0, 21), "ELF machine 21, big-endian");
}

TEST(LibraryFacts, OfWhatIsNoFileAreAnError) {
  const test::TempFolder folder;
  const auto missing = test::error_of([&] { read_library_facts(folder / "nothing.so"); });
  ASSERT_TRUE(missing);
  EXPECT_EQ(missing->code(), ErrorCode::kPluginLoad);
  EXPECT_TRUE(test::error_of([&] { read_library_facts(folder.path()); }));
}

}  // namespace
}  // namespace hallway::host
