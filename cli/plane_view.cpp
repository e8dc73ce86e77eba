// SPDX-License-Identifier: MIT
#include "plane_view.hpp"

namespace hallway::cli {

render::View plane_view(const std::string& name) {
  return {.kind = name == "top" ? render::ViewKind::kTop : render::ViewKind::kPerspective};
}

}  // namespace hallway::cli
