// SPDX-License-Identifier: MIT
// Completions: what the programs offer, and that bash, zsh and fish complete with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "base/file.hpp"
#include "support/data.hpp"
#include "support/process.hpp"
#include "support/temp_folder.hpp"
#include "support/terminal.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Strings = std::vector<std::string>;

/// The words that a program offers, with the lines that ask for files.
Strings offered(Strings words) {
  words.insert(words.begin(), {"completion", "--words"});
  const Ended ended = hallway(words);
  EXPECT_EQ(ended.status, 0) << ended.err;
  Strings found;
  std::istringstream lines(ended.out);
  for (std::string line; std::getline(lines, line);)
    found.push_back(line.starts_with(':') ? line : line.substr(0, line.find('\t')));
  return found;
}

bool has(const Strings& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

TEST(Completion, OffersCommands) {
  EXPECT_EQ(offered({"rep"}), (Strings{"replay"}));
  EXPECT_EQ(offered({"map", "le"}), (Strings{"leak"}));
  const Strings all = offered({""});
  for (const char* command : {"run", "replay", "map", "plugin", "help", "completion", "man"})
    EXPECT_TRUE(has(all, command)) << command;
}

TEST(Completion, OffersOptionsOnceUnlessTheyRepeat) {
  EXPECT_EQ(offered({"run", "--se"}), (Strings{"--seed", "--set"}));
  EXPECT_EQ(offered({"run", "--seed", "1", "--set", "a=1", "--se"}), (Strings{"--set"}));
  EXPECT_EQ(offered({"map", "check", "maps/office.map", "--str"}), (Strings{"--strict"}));
}

TEST(Completion, OffersValues) {
  EXPECT_EQ(offered({"run", "--on-failure", "r"}), (Strings{"restart"}));
  EXPECT_EQ(offered({"run", "--on-failure=r"}), (Strings{"--on-failure=restart"}));
  EXPECT_EQ(offered({"render", "x", "--view", ""}), (Strings{"top", "perspective", "panels", "camera"}));
  EXPECT_EQ(offered({"completion", "f"}), (Strings{"fish"}));
}

TEST(Completion, OffersPluginsByTheirFiles) {
  const TempFolder folder;
  folder.write("quick_slam.so", "not loaded for this");
  ASSERT_EQ(::setenv("HALLWAY_PLUGIN_PATH", folder.path().c_str(), 1), 0);
  EXPECT_EQ(offered({"run", "x.toml", "--plugin", "quick"}), (Strings{"quick_slam", ":files\tso"}));
  ::unsetenv("HALLWAY_PLUGIN_PATH");
}

TEST(Completion, OffersFilesByTheirKind) {
  EXPECT_EQ(offered({"map", "check", ""}), (Strings{":files\tmap"}));
  EXPECT_EQ(offered({"run", "--out", ""}), (Strings{":folders"}));
  EXPECT_EQ(offered({"replay", ""}), (Strings{":folders", ":files\tmcap csv"}));
}

TEST(Completion, OffersWhatAMapsEditorDoes) {
  const TempFolder folder;
  const std::string map = folder.path() / "new.map";
  EXPECT_EQ(offered({"edit", map, "ent"}), (Strings{"entity"}));
  EXPECT_TRUE(has(offered({"edit", map, "help", "un"}), "undo"));
}

// ---- shells ---------------------------------------------------------------------------------------------------------

std::string shell_file(const std::string& name) {
  for (const char* folder : {"/usr/bin/", "/bin/", "/usr/local/bin/"}) {
    if (fs::exists(folder + name)) return folder + name;
  }
  return "";
}

/// A folder with a map, and what a shell in it needs to find the programs.
struct Desk {
  Desk() {
    folder.write("room.map", "x"), folder.write("notes.txt", "x"), fs::create_directory(folder / "work");
  }
  Strings environment() const {
    return with_sanitizer_options({"PATH=" + (binary_folder() / "bin").string() + ":/usr/bin:/bin",
                                   "TERM=dumb", "HOME=" + folder.path().string(), "PS1=ready> ",
                                   "INPUTRC=/dev/null", "LC_ALL=C"});
  }
  TempFolder folder;
};

/// Types the beginning of a command and Tab, and waits until the line reads as it should.
void expect_completed(Terminal& shell, const std::string& typed, const std::string& line) {
  shell.type(typed + "\t");
  EXPECT_TRUE(shell.shows(line)) << shell.all();
  shell.type("\x15");  // Ctrl-U: an empty line again
}

void expect_completions(Terminal& shell) {
  expect_completed(shell, "hallway repl", "replay ");
  expect_completed(shell, "hallway map che", "check ");
  expect_completed(shell, "hallway run --on-failure rest", "restart ");
  expect_completed(shell, "hallway map check ro", "room.map ");
  expect_completed(shell, "hallway run --plugin slam_po", "slam_point ");
  expect_completed(shell, "hallway-robot prof", "profile ");
}

TEST(Completion, InBash) {
  const std::string bash = shell_file("bash");
  if (bash.empty()) GTEST_SKIP() << "no bash";
  const Desk desk;
  Terminal shell({bash, "--norc", "--noprofile", "-i"}, desk.environment(), desk.folder.path());
  shell.type("source <(hallway completion bash); source <(hallway-robot completion bash); echo go''ne\n");
  ASSERT_TRUE(shell.shows("gone")) << shell.all();
  expect_completions(shell);
}

TEST(Completion, InZsh) {
  const std::string zsh = shell_file("zsh");
  if (zsh.empty()) GTEST_SKIP() << "no zsh";
  const Desk desk;
  Terminal shell({zsh, "-f", "-i"}, desk.environment(), desk.folder.path());
  shell.type(
      "autoload -Uz compinit && compinit -u -D; source <(hallway completion zsh); source <(hallway-robot "
      "completion "
      "zsh); echo go''ne\n");
  ASSERT_TRUE(shell.shows("gone")) << shell.all();
  expect_completions(shell);
}

TEST(Completion, InFish) {
  const std::string fish = shell_file("fish");
  if (fish.empty()) GTEST_SKIP() << "no fish";
  const Desk desk;
  const auto completed = [&](const std::string& line) {
    Process shell({fish, "--no-config", "-c",
                   "hallway completion fish | source; hallway-robot completion fish | source; complete -C '" +
                       line + "'"},
                  desk.folder.path(), desk.environment());
    return shell.wait().out;
  };
  EXPECT_TRUE(completed("hallway repl").starts_with("replay\t")) << completed("hallway repl");
  EXPECT_TRUE(completed("hallway map che").starts_with("check\t"));
  EXPECT_EQ(completed("hallway run --on-failure rest"), "restart\n");
  EXPECT_EQ(completed("hallway map check ro").substr(0, 8), "room.map");
  EXPECT_TRUE(completed("hallway run --plugin slam_po").starts_with("slam_point\t"));
  EXPECT_TRUE(completed("hallway-robot prof").starts_with("profile\t"));
}

}  // namespace
}  // namespace hallway::test
