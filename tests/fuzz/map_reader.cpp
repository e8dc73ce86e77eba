// SPDX-License-Identifier: MIT
// The bytes as a map file. Whatever they are, the outcome is an Error or a document that survives being written and read.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/error.hpp"
#include "map/check.hpp"
#include "map/occupants.hpp"
#include "map/reader.hpp"
#include "map/world.hpp"
#include "map/writer.hpp"

using hallway::Error;
namespace map = hallway::map;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  map::Document document;
  try {
    document = map::parse(text, "fuzz.map");
  } catch (const Error&) {
    return 0;
  }
  const std::string printed = map::print(document);
  if (map::print(map::parse(printed, "again.map")) != printed) std::abort();
  for (const map::Finding& finding : map::check(document)) {
    if (finding.message.empty()) std::abort();
  }
  try {
    map::occupants(document);
    for (const map::Solid& solid : map::build_world(document).solids) {
      if (solid.faces.size() < 4) std::abort();
    }
  } catch (const Error&) {  // a bad key
    return 0;
  }
  return 0;
}
