// SPDX-License-Identifier: MIT
// The bytes as a journal, and as its records without their checksums, which hardly any bytes fit. Whatever they are, the outcome is an Error
// or a map that can be read.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/error.hpp"
#include "base/text.hpp"
#include "editor/session.hpp"
#include "map/reader.hpp"

using hallway::Error;
namespace editor = hallway::editor;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

void replay(const editor::Journal::Reading& reading) {
  try {
    hallway::map::parse(editor::last_text(reading, "fuzz.map"), "again.map");
  } catch (const Error&) {
    return;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    replay(editor::Journal::read_text(text, "fuzz.journal"));
  } catch (const Error&) {  // no journal
  }
  // The base up to an empty line, then a record a line.
  editor::Journal::Reading reading;
  const std::size_t end = text.find("\n\n");
  if (end == std::string::npos) return 0;
  reading.base = text.substr(0, end);
  for (const std::string_view line : hallway::split(std::string_view(text).substr(end + 2), '\n')) {
    auto record = nlohmann::ordered_json::parse(line, nullptr, false);
    if (record.is_object()) reading.records.push_back(std::move(record));
  }
  replay(reading);
  return 0;
}
