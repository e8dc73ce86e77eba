// SPDX-License-Identifier: MIT
#include "plane_plugin.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::cli {

host::StageSpec parse_plane_plugin(const std::string& text) {
  host::StageSpec spec;
  for (const std::string_view part : split(text, ':')) {
    const std::size_t equals = part.find('=');
    if (equals != std::string_view::npos && equals > 0 && !spec.plugin.empty()) {
      spec.parameters.push_back(
          {std::string(part.substr(0, equals)), std::string(part.substr(equals + 1)), {.file = "--plugin"}});
    } else if (equals == std::string_view::npos && !part.empty() && spec.parameters.empty()) {
      spec.plugin += (spec.plugin.empty() ? "" : ":") + std::string(part);
    } else {
      throw Error(ErrorCode::kUsage,
                  fmt::format("--plugin takes NAME[:parameter=value]..., not \"{}\"", printable(text)));
    }
  }
  return spec;
}

render::View plane_view(const std::string& name) {
  return {.kind = name == "top" ? render::ViewKind::kTop : render::ViewKind::kPerspective};
}

}  // namespace hallway::cli
