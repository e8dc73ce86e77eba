// SPDX-License-Identifier: MIT
#include "host/load/error_text.hpp"

#include <fmt/format.h>

#include <cstring>

#include "base/text.hpp"

namespace hallway::host {

hw_error_t empty_error() {
  hw_error_t error;
  error.size = sizeof error;
  error.status = HW_OK;
  error.message[0] = '\0';
  return error;
}

std::string error_text(const hw_error_t& error, hw_status_t status) {
  const std::size_t length = strnlen(error.message, sizeof error.message);
  if (length == 0) return fmt::format("it gives no reason but {} ({})", hw_status_name(status), status);
  return fmt::format("{} ({})", printable({error.message, length}, sizeof error.message),
                     hw_status_name(status));
}

}  // namespace hallway::host
