// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>

#include "base/error.hpp"

namespace hallway::test {

/// The hallway::Error that `work` throws, empty where it throws none.
inline std::optional<Error> error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error;
  }
  return std::nullopt;
}

}  // namespace hallway::test
