// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "support/data.hpp"
#include "support/temp_folder.hpp"

namespace {

namespace fs = std::filesystem;

struct Compiler {
  const char* test_name;
  const char* command;
  bool is_cpp;
};

fs::path include_folder() {
  return hallway::test::source_folder() / "sdk/include";
}

/// The headers as they are included, e.g. "hallway/ext/log.h".
std::vector<std::string> headers(bool with_cpp) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(include_folder())) {
    const auto extension = entry.path().extension();
    if (extension == ".h" || (with_cpp && extension == ".hpp")) {
      names.push_back(fs::relative(entry.path(), include_folder()).string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

bool runs(const std::string& command) {
  return std::system(command.c_str()) == 0;
}

class Headers : public testing::TestWithParam<Compiler> {
 protected:
  static std::string program() {
    const std::string command = GetParam().command;
    return command.substr(0, command.find(' '));
  }
  /// Compiles the files of `folder` with every warning an error.
  static bool compiles(const std::string& files) {
    return runs(std::string(GetParam().command) +
                " -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion" +
                " -Werror -fsyntax-only -I'" + include_folder().string() + "'" + files);
  }
};

TEST_P(Headers, EachAloneCompilesWithoutAWarning) {
  if (!runs("command -v " + program() + " >/dev/null"))
    GTEST_SKIP() << "there is no " << program() << " here";
  const auto names = headers(GetParam().is_cpp);
  ASSERT_GE(names.size(), 14u);
  const hallway::test::TempFolder folder;
  std::string files;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string extension = GetParam().is_cpp ? ".cpp" : ".c";
    files +=
        " '" + folder.write(std::to_string(i) + extension, "#include <" + names[i] + ">\n").string() + "'";
  }
  EXPECT_TRUE(compiles(files));
}

TEST_P(Headers, AWarningWouldBeNoticed) {
  if (!runs("command -v " + program() + " >/dev/null"))
    GTEST_SKIP() << "there is no " << program() << " here";
  const hallway::test::TempFolder folder;
  const std::string file =
      folder.write(GetParam().is_cpp ? "a.cpp" : "a.c", "int f(long a);\nint f(long a) { return a; }\n")
          .string();
  EXPECT_FALSE(compiles(" '" + file + "' 2>/dev/null"));
}

INSTANTIATE_TEST_SUITE_P(Compilers, Headers,
                         testing::Values(Compiler{"GccC11", "gcc -std=c11", false},
                                         Compiler{"GccC17", "gcc -std=c17", false},
                                         Compiler{"GccCpp17", "g++ -std=c++17", true},
                                         Compiler{"GccCpp20", "g++ -std=c++20", true},
                                         Compiler{"ClangC11", "clang -std=c11", false},
                                         Compiler{"ClangC17", "clang -std=c17", false},
                                         Compiler{"ClangCpp17", "clang++ -std=c++17", true},
                                         Compiler{"ClangCpp20", "clang++ -std=c++20", true}),
                         [](const auto& instance) { return instance.param.test_name; });

}  // namespace
