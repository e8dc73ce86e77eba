// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "conformance/test.hpp"

namespace hallway::conformance {

/// Tells whoever started this process which of the plugin's functions is being called, in case it never returns. `name` is a literal; null:
/// none.
void mark_call(const char* name) noexcept;

/// Calls a function of the plugin under its name. Throws Failed where it lets an exception escape.
template <typename Call>
auto marked(const char* name, Call&& call) {
  struct Mark {
    explicit Mark(const char* text) { mark_call(text); }
    ~Mark() { mark_call(nullptr); }
  } const mark(name);
  try {
    return std::forward<Call>(call)();
  } catch (const std::exception& exception) {
    throw Failed(std::string(name) + "() let a C++ exception escape: " + printable(exception.what()));
  } catch (...) {
    throw Failed(std::string(name) + "() let an exception escape that is no std::exception");
  }
}

}  // namespace hallway::conformance
