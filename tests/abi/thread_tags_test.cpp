// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "support/data.hpp"

namespace {

constexpr std::array kTags = {"[main]", "[loop]", "[background]", "[any]"};

/// The name of the function or function pointer that a line begins to declare, empty if it declares none.
std::string declared_function(const std::string& line) {
  static const std::regex kPointer(R"(^\s*[\w\s*]+\(\*(\w+)\)\(.*)");
  static const std::regex kFunction(
      R"(^(?:static inline|HW_EXPORT|extern)?\s*[A-Za-z_][\w\s*]*[\s*](\w+)\(.*)");
  std::smatch match;
  if (std::regex_match(line, match, kPointer)) return match[1];
  const bool outermost = !line.empty() && line[0] != ' ' && line[0] != '#' && line[0] != '/';
  if (outermost && std::regex_match(line, match, kFunction)) return match[1];
  return "";
}

bool ends_with_one_tag(const std::string& comment) {
  const auto count = std::count(comment.begin(), comment.end(), '[');
  return count == 1 && std::any_of(kTags.begin(), kTags.end(),
                                   [&](const char* tag) { return std::string_view(comment).ends_with(tag); });
}

/// The functions of a header whose comment does not end with exactly one tag.
std::vector<std::string> untagged(const std::string& header, std::size_t* functions = nullptr) {
  std::vector<std::string> names;
  std::istringstream lines(header);
  std::string comment;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t slashes = line.find_first_not_of(' ');
    if (slashes != std::string::npos && line.compare(slashes, 3, "///") == 0) {
      comment += line;
      continue;
    }
    const std::string name = declared_function(line);
    if (!name.empty() && functions) ++*functions;
    if (!name.empty() && !ends_with_one_tag(comment)) names.push_back(name);
    comment.clear();
  }
  return names;
}

TEST(ThreadTags, EveryFunctionOfTheHeadersHasOne) {
  std::size_t functions = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(hallway::test::source_folder() / "sdk/include")) {
    if (entry.path().extension() != ".h") continue;
    const auto names = untagged(hallway::read_file(entry.path()), &functions);
    EXPECT_TRUE(names.empty()) << entry.path() << ": " << names.front() << " and " << names.size() - 1
                               << " others";
  }
  // 7 of the plugin, 2 of the host, 3 each of factory and entry, 7 of the parameters, 1 of the log, 32 inline functions,
  // 8 of the driver and 3 of its factory.
  EXPECT_EQ(functions, 67u);
}

TEST(ThreadTags, ATaggedFunctionPasses) {
  EXPECT_TRUE(untagged("struct t {\n  /// Does it.\n  /// Well. [loop]\n  int (*f)(void);\n};\n").empty());
  EXPECT_TRUE(untagged("/// Does it. [any]\nstatic inline int f(int a) {\n  return a;\n}\n").empty());
}

TEST(ThreadTags, AFunctionPointerWithoutATagIsFound) {
  EXPECT_EQ(untagged("struct t {\n  /// Does it. [main]\n  int (*f)(void);\n  const int* (*g)(void);\n};\n"),
            std::vector<std::string>{"g"});
}

TEST(ThreadTags, AnInlineFunctionWithoutATagIsFound) {
  EXPECT_EQ(untagged("/// Does it.\nstatic inline const char* f(int a) {\n"), std::vector<std::string>{"f"});
}

TEST(ThreadTags, ATagThatIsNoneOfTheFourIsFound) {
  EXPECT_EQ(untagged("/// Does it. [render]\nstatic inline int f(int a) {\n"), std::vector<std::string>{"f"});
}

TEST(ThreadTags, ATagWithAConditionIsFound) {
  EXPECT_EQ(untagged("/// Does it. [main] if inactive\nstatic inline int f(int a) {\n"),
            std::vector<std::string>{"f"});
  EXPECT_EQ(untagged("/// Does it. [main] [loop]\nstatic inline int f(int a) {\n"),
            std::vector<std::string>{"f"});
}

}  // namespace
