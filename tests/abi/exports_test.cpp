// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace {

/// What a library shows to the loader, by binutils' nm.
std::vector<std::string> exported_symbols(const std::filesystem::path& file) {
  const std::string command = "nm -D --defined-only --format=just-symbols '" + file.string() + "'";
  const auto close = [](std::FILE* stream) { ::pclose(stream); };
  const std::unique_ptr<std::FILE, decltype(close)> stream(::popen(command.c_str(), "r"), close);
  std::vector<std::string> symbols;
  char line[4096];
  while (stream && std::fgets(line, sizeof line, stream.get())) {
    symbols.emplace_back(line);
    while (!symbols.back().empty() && symbols.back().back() == '\n') symbols.back().pop_back();
  }
  return symbols;
}

class Exports : public testing::TestWithParam<const char*> {};

TEST_P(Exports, EveryPluginShowsItsEntryAlone) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(GetParam())) {
    if (entry.path().extension() != ".so" || entry.path().stem() == "no_entry") continue;
    EXPECT_EQ(exported_symbols(entry.path()), std::vector<std::string>{"hw_entry"}) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 0u);
}

INSTANTIATE_TEST_SUITE_P(Folders, Exports, testing::Values(PLUGINS, EXAMPLES, FIXTURES));

}  // namespace
