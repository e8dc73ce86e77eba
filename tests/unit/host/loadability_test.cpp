// SPDX-License-Identifier: MIT
#include "host/machine/loadability.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "support/errors.hpp"
#include "support/process.hpp"

namespace hallway::host {
namespace {

namespace fs = std::filesystem;

MachineProfile robot() {
  return {.name = "robot",
          .machine = "AArch64",
          .glibc = "2.31",
          .glibcxx = "3.4.28",
          .cxxabi = "1.3.12",
          .abi_major = 1,
          .abi_minor = 0,
          .libraries = {"libc.so.6", "libm.so.6", "libstdc++.so.6"}};
}

LibraryFacts plugin() {
  LibraryFacts facts;
  facts.file = "my.so";
  facts.whole = facts.shared_object = facts.symbols_known = true;
  facts.machine = "AArch64";
  facts.needed = {"libstdc++.so.6", "libc.so.6"};
  facts.needed_versions = {
      {"libc.so.6", "GLIBC_2.17"}, {"libstdc++.so.6", "GLIBCXX_3.4.9"}, {"libstdc++.so.6", "CXXABI_1.3"}};
  facts.exports = {"hw_entry"};
  facts.abi = hw_version_t{1, 0};
  return facts;
}

/// The one problem that a change of the good plugin makes.
template <typename Change>
std::string problem_after(Change&& change) {
  LibraryFacts facts = plugin();
  change(facts);
  const Loadability result = judge(facts, robot());
  EXPECT_EQ(result.problems.size(), 1u);
  return result.problems.empty() ? std::string() : result.problems.front();
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Loadability, OfAGoodPluginHasNothingToSay) {
  EXPECT_EQ(judge(plugin(), robot()).problems, std::vector<std::string>());
  EXPECT_EQ(judge(plugin(), robot()).remarks, std::vector<std::string>());
}

TEST(Loadability, EachReasonIsNamed) {
  EXPECT_TRUE(says(problem_after([](auto& f) { f.machine = "x86-64"; }), "x86-64, there it is AArch64"));
  EXPECT_TRUE(says(problem_after([](auto& f) { f.shared_object = false; }), "not a shared object"));
  EXPECT_TRUE(says(problem_after([](auto& f) { f.problem = "is cut off"; }), "is cut off"));
  EXPECT_TRUE(says(problem_after([](auto& f) { f.abi.reset(); }), "hw_entry"));
  EXPECT_TRUE(
      says(problem_after([](auto& f) { f.abi->abi_major = 7; }), "7.0 of the plugin ABI, there it is 1.0"));
  EXPECT_TRUE(says(problem_after([](auto& f) { f.needed.push_back("libpcl_common.so.1.13"); }),
                   "libpcl_common.so.1.13, which is not there"));
  // The newest version alone is named, and numbers are compared as numbers: 2.4 is older than 2.31.
  EXPECT_TRUE(says(problem_after([](auto& f) {
                     f.needed_versions.push_back({"libc.so.6", "GLIBC_2.34"});
                     f.needed_versions.push_back({"libc.so.6", "GLIBC_2.32"});
                     f.needed_versions.push_back({"libc.so.6", "GLIBC_2.4"});
                   }),
                   "needs glibc 2.34, there is 2.31"));
  EXPECT_TRUE(says(problem_after([](auto& f) {
                     f.needed_versions.push_back({"libstdc++.so.6", "GLIBCXX_3.4.30"});
                   }),
                   "GLIBCXX 3.4.30, there is 3.4.28"));
  EXPECT_TRUE(says(problem_after([](auto& f) {
                     f.needed_versions.push_back({"libstdc++.so.6", "CXXABI_1.3.13"});
                   }),
                   "CXXABI 1.3.13, there is 1.3.12"));
}

TEST(Loadability, WhatIsNotKnownIsARemark) {
  MachineProfile blank = robot();
  blank.libraries.clear();
  blank.glibcxx.clear();
  const Loadability result = judge(plugin(), blank);
  EXPECT_EQ(result.problems, std::vector<std::string>());
  EXPECT_EQ(result.remarks.size(), 3u);  // two libraries, one version
}

TEST(Loadability, OfWhatRunsHereIsGood) {
  for (const fs::path& file : {fs::path(EXAMPLE), fs::path(PLUGINS) / "slam_point.so"}) {
    EXPECT_EQ(judge(read_library_facts(file), this_machine()).problems, std::vector<std::string>()) << file;
  }
}

TEST(CompareVersions, ComparesNumbers) {
  const std::vector<std::string> rising{"2", "2.2.5", "2.4", "2.31", "2.36", "3.4.9", "3.4.30", "10"};
  for (std::size_t i = 0; i < rising.size(); ++i) {
    for (std::size_t j = 0; j < rising.size(); ++j) {
      const int expected = i < j ? -1 : i > j ? 1 : 0;
      EXPECT_EQ(compare_versions(rising[i], rising[j]), expected) << rising[i] << " " << rising[j];
    }
  }
  EXPECT_EQ(compare_versions("2.0", "2"), 0);
}

/// `ldconfig -p` reads the same cache.
TEST(MachineProfile, LibrariesAreThoseOfLdconfig) {
  const fs::path ldconfig = "/sbin/ldconfig";
  if (!fs::exists(ldconfig) || !fs::exists("/etc/ld.so.cache")) GTEST_SKIP() << "there is no ldconfig here";
  const auto libraries = libraries_in_cache(read_file("/etc/ld.so.cache"));
  ASSERT_TRUE(libraries);
  const test::Ended ended = test::Process({ldconfig, "-p"}).wait();
  std::vector<std::string> expected;
  for (const std::string_view line : split(ended.out, '\n')) {
    // "	libz.so.1 (libc6,x86-64) => /lib/..."
    const std::size_t kind = line.find(" (libc6,x86-64"), arm = line.find(" (libc6,AArch64");
    const std::size_t end = std::min(kind, arm);
    if (end != std::string_view::npos) expected.emplace_back(line.substr(1, end - 1));
  }
  std::sort(expected.begin(), expected.end());
  expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
  EXPECT_EQ(*libraries, expected);
  EXPECT_GT(expected.size(), 5u);
}

TEST(MachineProfile, CachesThatAreNoneOrCutHaveNoLibrariesOrFewer) {
  EXPECT_FALSE(libraries_in_cache(""));
  EXPECT_FALSE(libraries_in_cache("something else"));
  if (!fs::exists("/etc/ld.so.cache")) return;
  const std::string whole = read_file("/etc/ld.so.cache");
  const std::size_t all = libraries_in_cache(whole)->size();
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 8) {
    if (const auto some = libraries_in_cache(whole.substr(0, size))) {
      EXPECT_LE(some->size(), all);
    }
  }
}

TEST(MachineProfile, OfThisMachineIsFilledIn) {
  const MachineProfile here = this_machine();
  EXPECT_FALSE(here.machine.empty());
  EXPECT_GE(compare_versions(here.glibc, "2.30"), 0);
  EXPECT_GE(compare_versions(here.glibcxx, "3.4.20"), 0);
}

TEST(MachineProfile, IsReadAsItWasPrinted) {
  for (const MachineProfile& profile : {robot(), this_machine()}) {
    const MachineProfile read = parse_profile(print_profile(profile), "robot.toml");
    EXPECT_EQ(print_profile(read), print_profile(profile));
    EXPECT_EQ(read.libraries, profile.libraries);
    EXPECT_EQ(read.glibcxx, profile.glibcxx);
  }
}

TEST(MachineProfile, RefusesWhatIsNone) {
  const std::string good = print_profile(robot());
  const auto refusal = [&](const std::string& what, const std::string& by) {
    std::string text = good;
    text.replace(text.find(what), what.size(), by);
    const auto error = test::error_of([&] { parse_profile(text, "robot.toml"); });
    EXPECT_TRUE(error) << by;
    if (!error) return std::string();
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
    EXPECT_EQ(error->where().file, "robot.toml");
    return error->message();
  };
  EXPECT_TRUE(says(refusal("glibc =", "glibbc ="), "did you mean \"glibc\""));
  EXPECT_TRUE(says(refusal("machine = \"AArch64\"\n", ""), "`machine` is missing"));
  EXPECT_TRUE(says(refusal("\"2.31\"", "2.31"), "`glibc` is a number"));
  EXPECT_TRUE(says(refusal("abi_major = 1", "abi_major = -1"), "abi_major"));
  EXPECT_TRUE(says(refusal("hallway.machine/1", "hallway.scenario/1"), "schema"));
  EXPECT_FALSE(refusal("[\n", "[[[\n").empty());
}

}  // namespace
}  // namespace hallway::host
