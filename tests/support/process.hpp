// SPDX-License-Identifier: MIT
#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {

/// How a program ended and what it printed.
struct Ended {
  int status = 0;  ///< exit status, or 128 + signal
  std::string out;
  std::string err;
};

/// A program that runs beside the test.
class Process {
 public:
  /// @param arguments    the program's path and what follows it
  /// @param folder       its working folder; empty for the test's own
  /// @param environment  "NAME=value" entries that replace the test's environment; empty to keep it
  /// @param out_file     where its standard output goes; empty: captured
  explicit Process(const std::vector<std::string>& arguments, const std::filesystem::path& folder = {},
                   const std::vector<std::string>& environment = {},
                   const std::filesystem::path& out_file = {})
      : out_file_(out_file.empty() ? captured_.path() / "out" : out_file), capture_(out_file.empty()) {
    std::vector<std::string> texts = arguments;
    std::vector<char*> argv;
    for (std::string& text : texts) argv.push_back(text.data());
    argv.push_back(nullptr);
    std::vector<std::string> variables = environment;
    std::vector<char*> envp;
    for (std::string& variable : variables) envp.push_back(variable.data());
    envp.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    if (!folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, std::filesystem::absolute(out_file_).c_str(),
                                     capture_ ? O_WRONLY | O_CREAT | O_TRUNC : O_WRONLY, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, (captured_.path() / "err").c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int failed = ::posix_spawn(&pid_, argv[0], &actions, nullptr, argv.data(),
                                     environment.empty() ? ::environ : envp.data());
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) throw std::runtime_error("cannot start " + arguments.at(0));
  }

  pid_t pid() const { return pid_; }

  /// What it has printed on standard error so far.
  std::string err_so_far() const { return read_file(captured_.path() / "err"); }

  /// Waits for its end.
  Ended wait() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    Ended ended;
    ended.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (capture_) ended.out = read_file(out_file_);
    ended.err = read_file(captured_.path() / "err");
    return ended;
  }

 private:
  TempFolder captured_;
  std::filesystem::path out_file_;
  bool capture_;
  pid_t pid_ = 0;
};

/// `variables` and those of the test's own environment that instruct the sanitizers, so that a program that is started with an
/// environment of its own still knows the suppressions.
inline std::vector<std::string> with_sanitizer_options(std::vector<std::string> variables) {
  for (const char* name : {"ASAN_OPTIONS", "LSAN_OPTIONS", "UBSAN_OPTIONS", "TSAN_OPTIONS"}) {
    if (const char* value = std::getenv(name)) variables.push_back(std::string(name) + "=" + value);
  }
  return variables;
}

/// The folder of what was built: the environment variable HALLWAY_BINARY_DIR, which ctest sets.
inline std::filesystem::path binary_folder() {
  const char* folder = std::getenv("HALLWAY_BINARY_DIR");
  if (folder == nullptr || *folder == '\0')
    throw std::runtime_error("HALLWAY_BINARY_DIR is not set; run the tests by ctest");
  return folder;
}

/// The `hallway` program.
inline std::string hallway_program() {
  return binary_folder() / "bin" / "hallway";
}

/// Runs `hallway` with these arguments to its end.
inline Ended hallway(std::vector<std::string> arguments, const std::filesystem::path& folder = {},
                     const std::vector<std::string>& environment = {}) {
  arguments.insert(arguments.begin(), hallway_program());
  return Process(arguments, folder, environment).wait();
}

/// The `hallway-robot` program.
inline std::string robot_program() {
  return binary_folder() / "bin" / "hallway-robot";
}

/// Runs `hallway-robot` with these arguments to its end.
inline Ended hallway_robot(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), robot_program());
  return Process(arguments).wait();
}

}  // namespace hallway::test
