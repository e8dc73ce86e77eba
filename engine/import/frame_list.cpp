// SPDX-License-Identifier: MIT
#include "import/frame_list.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/file.hpp"
#include "base/text.hpp"
#include "import/word_lines.hpp"
#include "import/words.hpp"
#include "log/observations.hpp"

namespace hallway::import {
namespace {

namespace fs = std::filesystem;

/// A list may come from anywhere: it names no files outside of its recording.
fs::path inside(const fs::path& folder, std::string_view name, const WordLines& lines) {
  const fs::path relative(name);
  const bool leaves =
      relative.is_absolute() ||
      std::any_of(relative.begin(), relative.end(), [](const fs::path& part) { return part == ".."; });
  if (leaves) throw lines.error(fmt::format("\"{}\" leads out of the folder", printable(name)));
  return folder / relative;
}

/// Where in the words the pair of time and file begins that is meant.
std::size_t pair_of(const WordLines& lines) {
  const auto& words = lines.words();
  if (words.size() == 2) return 0;
  if (words.size() != 4) {
    throw lines.error("SECONDS FILE is needed, or two of these");
  }
  const bool first = words[1].find("depth") != std::string_view::npos;
  const bool second = words[3].find("depth") != std::string_view::npos;
  if (first == second) throw lines.error("of two files exactly one needs \"depth\" in its name");
  return first ? 0 : 2;
}

}  // namespace

std::vector<FrameFile> parse_frame_list(std::string_view text, const std::string& file,
                                        const fs::path& folder) {
  WordLines lines(text, file);
  std::vector<FrameFile> frames;
  while (lines.next()) {
    if (lines.line().starts_with('#')) continue;
    const auto& words = lines.words();
    const std::size_t pair = pair_of(lines);
    const auto t_ns = parse_seconds(words[pair]);
    if (!t_ns) {
      throw lines.error(
          fmt::format("a time in seconds below 9e9 is needed, \"{}\" found", printable(words[pair], 40)));
    }
    if (!frames.empty() && *t_ns < frames.back().t_ns) {
      throw lines.error(fmt::format("the time {} lies before the one above it", words[pair]));
    }
    if (frames.size() > log::kMaxIteration) throw lines.error("more frames than a log may have");
    frames.push_back({*t_ns, inside(folder, words[pair + 1], lines)});
  }
  if (frames.empty()) throw lines.error("names no frames");
  return frames;
}

std::vector<FrameFile> read_frame_list(const fs::path& list, const fs::path& folder) {
  return parse_frame_list(read_file(list), list.string(), folder);
}

}  // namespace hallway::import
