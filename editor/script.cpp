// SPDX-License-Identifier: MIT
#include <filesystem>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/session.hpp"

namespace hallway::editor {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostBytes = 64u << 20;
constexpr int kDeepest = 16;  ///< scripts that call scripts
constexpr std::size_t kMostLines = 1000000;

/// The file that a line sources, if it does nothing else.
std::optional<fs::path> sourced(const std::string& line) {
  const std::string_view text = trim(line);
  if (!text.starts_with("source")) return std::nullopt;
  const auto words = words_of(text);
  if (words.empty() || words[0] != "source") return std::nullopt;
  constexpr std::string_view kKey = "file=";
  if (words.size() == 3 && words[1] == "file") return words[2];
  if (words.size() == 2) return words[1].starts_with(kKey) ? words[1].substr(kKey.size()) : words[1];
  refuse("source: one file is wanted");
}

void add_lines(const std::string& text, const fs::path& file, int depth, std::vector<ScriptLine>& out) {
  int number = 0;
  for (const std::string_view part : split(text, '\n')) {
    ScriptLine line{std::string(part), file.string(), ++number};
    if (line.text.ends_with('\r')) line.text.pop_back();
    std::optional<fs::path> other;
    try {
      other = sourced(line.text);
    } catch (const Error& error) {
      throw Error(error.code(), error.message(), {line.file, line.line, {}});
    }
    if (!other) {
      if (!trim(line.text).empty()) out.push_back(std::move(line));
      if (out.size() > kMostLines)
        throw Error(ErrorCode::kUsage, "the scripts have more than a million lines",
                    {file.string(), number, {}});
      continue;
    }
    if (depth == kDeepest) {
      throw Error(ErrorCode::kUsage, "scripts call scripts more than 16 deep; do they call each other?",
                  {line.file, line.line, {}});
    }
    const fs::path path = file.parent_path() / *other;
    add_lines(read_file(path, kMostBytes), path, depth + 1, out);
  }
}

}  // namespace

std::vector<ScriptLine> script_lines(const std::string& text, const fs::path& file) {
  std::vector<ScriptLine> lines;
  add_lines(text, file, 0, lines);
  return lines;
}

std::vector<ScriptLine> read_script(const fs::path& file) {
  return script_lines(read_file(file, kMostBytes), file);
}

}  // namespace hallway::editor
