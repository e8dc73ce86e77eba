// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>

#include "base/file.hpp"
#include "editor/help.hpp"
#include "support/data.hpp"

namespace hallway {
namespace {

/// `hallway edit --reference` prints what stands there.
TEST(Reference, ThePageHasEveryCommandAsTheTableHasIt) {
  const std::filesystem::path page = test::source_folder() / "docs" / "edit.md";
  const std::string text = read_file(page);
  const std::string begin = "\n## Commands\n";
  const std::size_t at = text.find(begin);
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(text.substr(at + begin.size()), editor::reference_markdown())
      << "write the page's last part again: hallway edit --reference";
}

}  // namespace
}  // namespace hallway
