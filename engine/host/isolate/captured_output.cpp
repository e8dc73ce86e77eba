// SPDX-License-Identifier: MIT
#include "host/isolate/captured_output.hpp"

#include <fmt/format.h>
#include <hallway/ext/log.h>

#include <algorithm>
#include <utility>

#include "base/text.hpp"

namespace hallway::host {

void CapturedOutput::add(std::string_view text, const LogSink& sink, const std::string& plugin) {
  bytes_ += text.size();
  while (!text.empty()) {
    if (lines_ == kMaxLines) {
      dropped_bytes_ += text.size();
      return;
    }
    const std::size_t end = text.find('\n');
    const std::size_t length = std::min(end, text.size());
    const std::size_t kept = std::min(length, kMaxLineBytes - line_.size());
    line_.append(text.substr(0, kept));
    dropped_bytes_ += length - kept;
    text.remove_prefix(length);
    if (end == std::string_view::npos) return;
    text.remove_prefix(1);
    add_line(sink, plugin);
  }
}

void CapturedOutput::add_line(const LogSink& sink, const std::string& plugin) {
  ++lines_;
  const std::string line = std::exchange(line_, {});
  if (sink) sink(plugin, HW_LOG_WARNING, "wrote: " + printable(line, 2 * kMaxLineBytes));
}

void CapturedOutput::finish(const LogSink& sink, const std::string& plugin) {
  if (!line_.empty()) add_line(sink, plugin);
  if (dropped_bytes_ != 0 && sink) {
    sink(plugin, HW_LOG_WARNING,
         fmt::format("wrote {} bytes more, which are not shown", std::exchange(dropped_bytes_, 0u)));
  }
}

}  // namespace hallway::host
