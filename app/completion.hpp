// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "command_line.hpp"

namespace hallway::cli {

/// What a word on a command line may become.
struct Completion {
  struct Candidate {
    std::string word{};
    std::string about{};  ///< one line, perhaps empty
    friend bool operator==(const Candidate&, const Candidate&) = default;
  };
  std::vector<Candidate> words{};
  bool files = false;                  ///< also names of files, with one of `endings`
  std::vector<std::string> endings{};  ///< without their points; none: every file
  bool folders = false;                ///< also names of folders
};

/// What the last of the words may become. Plugins are offered by the names of the files in `plugin_folders`: none is loaded for it.
/// @param words  those behind the program's name; the last is the one that is being typed, perhaps empty
Completion complete(const Command& program, std::span<const std::string> words,
                    std::span<const std::filesystem::path> plugin_folders);

/// The same as the scripts of completion_script() read it: a line for each word, with its description behind a tab, and the lines
/// ":files<tab>toml map" and ":folders".
std::string print_completion(const Completion& completion);

/// The script that makes a shell complete the arguments of `program`: "bash", "zsh" or "fish". It asks the program at each key.
std::string completion_script(const std::string& program, std::string_view shell);

/// What the scripts call: `PROGRAM completion --words WORD...`.
inline constexpr const char* kCompletionCommand = "completion";
inline constexpr const char* kCompletionWords = "--words";

}  // namespace hallway::cli
