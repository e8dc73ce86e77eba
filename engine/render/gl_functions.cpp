// SPDX-License-Identifier: MIT
#include "render/gl_functions.hpp"

#include <string>

#include "base/error.hpp"

namespace hallway::render {

EntryPoint GlFunctions::find(const char* name) const {
  const GlContext::Function found = context_.function(name);
  if (found == nullptr)
    throw Error(ErrorCode::kIo, std::string("no picture can be drawn: OpenGL has no ") + name);
  return {reinterpret_cast<void*>(found)};
}

}  // namespace hallway::render
