// SPDX-License-Identifier: MIT
// The manual pages: one for each command, which the formatters read without a warning.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "support/process.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Strings = std::vector<std::string>;

/// The pages of both programs, in one folder.
class Pages {
 public:
  Pages() {
    EXPECT_EQ(hallway({"man", "--out", folder_.path()}).status, 0);
    EXPECT_EQ(hallway_robot({"man", "--out", folder_.path()}).status, 0);
  }
  fs::path folder() const { return folder_.path(); }
  Strings files() const {
    Strings files;
    for (const auto& entry : fs::directory_iterator(folder())) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
  }

 private:
  TempFolder folder_;
};

/// What a formatter of the system says of the pages. Empty: nothing, as it should.
std::string complaints(const Strings& formatter, const Pages& pages) {
  Strings command = formatter;
  for (const std::string& file : pages.files()) command.push_back(file);
  const Ended ended = Process(command).wait();
  return ended.out + ended.err;
}

TEST(ManPages, OneForEachCommand) {
  const Pages pages;
  std::size_t commands = 0;
  for (const Ended& tree : {hallway({"help", "--json"}), hallway_robot({"help", "--json"})}) {
    const auto parsed = nlohmann::json::parse(tree.out);
    for (const auto& command : parsed.at("commands")) {
      std::string name = command.at("command").get<std::string>();
      if (name == "hallway robot") name += " file";  // beside the page of the program hallway-robot
      std::replace(name.begin(), name.end(), ' ', '-');
      EXPECT_TRUE(fs::exists(pages.folder() / (name + ".1"))) << name;
      ++commands;
    }
  }
  EXPECT_EQ(pages.files().size(), commands);
}

TEST(ManPages, HaveEachOption) {
  const std::string page = hallway({"man", "run"}).out;
  for (const char* part :
       {".TH HALLWAY\\-RUN 1", "\\fB\\-\\-plugin\\fR", "SCENARIO", ".SH EXAMPLES", ".SH EXIT STATUS"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(hallway({"man", "rum"}).status, 2);
}

TEST(ManPages, MandocHasNoWarnings) {
  if (!fs::exists("/usr/bin/mandoc")) GTEST_SKIP() << "no mandoc";
  EXPECT_EQ(complaints({"/usr/bin/mandoc", "-Tlint", "-Wwarning"}, Pages()), "");
}

TEST(ManPages, GroffHasNoWarnings) {
  if (!fs::exists("/usr/bin/groff")) GTEST_SKIP() << "no groff";
  EXPECT_EQ(complaints({"/usr/bin/groff", "-ww", "-man", "-Tutf8", "-z"}, Pages()), "");
}

}  // namespace
}  // namespace hallway::test
