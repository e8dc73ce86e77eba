// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace hallway::cli {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// What a failed command prints: one line on standard error, or with `json` one document on standard output.
/// @return the exit status that belongs to the failure
int report_failure(const std::exception& failure, bool json);

/// Prints a result on standard output. Throws Error{kIo} if it cannot be written; a reader that went away is no failure.
void print_result(const std::string& text);
template <typename First, typename... Rest>
void print_result(fmt::format_string<First, Rest...> format, First&& first, Rest&&... rest) {
  print_result(fmt::format(format, std::forward<First>(first), std::forward<Rest>(rest)...));
}

/// Prints a JSON document and a line end on standard output, as print_result() does.
void print_json(const nlohmann::ordered_json& document);

/// What commands with a result share.
struct OutputOptions {
  bool force = false;
  bool json = false;
  bool quiet = false;

  /// With --json the document, else the text; with --quiet nothing.
  void print(const Json& document, const std::string& text) const;
};

/// Prints "hallway: …" on standard error.
void print_notice(const std::string& text);

/// Prints "hallway: warning: …" on standard error.
void print_warning(const std::string& text);
template <typename First, typename... Rest>
void print_warning(fmt::format_string<First, Rest...> format, First&& first, Rest&&... rest) {
  print_warning(fmt::format(format, std::forward<First>(first), std::forward<Rest>(rest)...));
}
/// The same, and keeps the warning for a JSON document.
void print_warning(std::vector<std::string>& warnings, std::string text);

/// A path, safe to print.
std::string path_text(const std::filesystem::path& path);
/// The same of several, as JSON documents have them.
std::vector<std::string> path_texts(const std::vector<std::filesystem::path>& paths);

/// Adds lines to a text: a label, filled up to `width`, and a value.
struct Rows {
  std::string& text;  ///< not owned
  int width = 12;

  void operator()(const std::string& label, const std::string& value) const {
    text += fmt::format("  {:<{}} {}\n", label, width, value);
  }
};

/// Makes sure that descriptors 0, 1 and 2 are open, so that no file of ours takes their place, and that a reader that goes
/// away, and a file that becomes larger than it may, are errors of write() and not the end of the program.
void prepare_standard_streams();

/// From now on Ctrl-C and SIGTERM set a flag instead of ending the program at once; the second one ends it.
/// @param wake  an eventfd that is counted up when one comes; -1 for none
void catch_interrupts(int wake = -1);
/// Whether one came.
bool interrupted();
/// 130 after Ctrl-C, 143 after SIGTERM.
int interrupt_status();

/// A bar with rate and time left on standard error; shown only when that is a terminal.
class Progress {
 public:
  /// @param total  number of steps
  /// @param quiet  show nothing
  Progress(std::string what, std::uint64_t total, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Called after each step; draws ten times a second at most.
  void update(std::uint64_t done);

 private:
  void draw(std::uint64_t done, std::int64_t now_ns);

  std::string what_;
  std::uint64_t total_;
  bool shown_;
  std::int64_t start_ns_;
  std::int64_t drawn_ns_ = 0;
};

}  // namespace hallway::cli
