// SPDX-License-Identifier: MIT
// The bytes as a script for the editor. Whatever they are, the outcome is an Error, or calls whose lines mean the same when read again.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/error.hpp"
#include "editor/command.hpp"
#include "editor/session.hpp"

using hallway::Error;
namespace editor = hallway::editor;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (text.find("source") != std::string::npos) return 0;  // would read files
  for (const editor::ScriptLine& line : editor::script_lines(text, "fuzz.hwe")) {
    editor::Call call;
    try {
      call = editor::parse_script_line(line.text, {0.01});
    } catch (const Error& error) {
      if (error.code() != hallway::ErrorCode::kUsage) std::abort();
      continue;
    }
    if (call.command == nullptr) continue;
    const editor::Call again = editor::parse_line(call.line, {0.01});
    if (again.command != call.command || again.line != call.line) std::abort();
  }
  return 0;
}
