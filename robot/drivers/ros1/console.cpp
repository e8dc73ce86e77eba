// SPDX-License-Identifier: MIT
#include "ros1/console.hpp"

#include <ros/console.h>
#include <ros/console_backend.h>

#include <mutex>
#include <optional>

#include "base/text.hpp"

namespace hallway::ros1 {
namespace {

// roscpp's console is one for the process, so this is too.
std::mutex console_mutex;
std::optional<sdk::Host> console_host;

std::uint32_t level_of(ros::console::Level level) {
  switch (level) {
    case ros::console::levels::Debug:
      return HW_LOG_DEBUG;
    case ros::console::levels::Info:
      return HW_LOG_INFO;
    case ros::console::levels::Warn:
      return HW_LOG_WARNING;
    default:
      return HW_LOG_ERROR;
  }
}

void print(void*, ros::console::Level level, const char* text, const char*, const char*, int) {
  say(level_of(level), "roscpp: " + printable(text, 500));
}

}  // namespace

void open_console(const sdk::Host& host) {
  // Whatever would be printed passes through this pointer; rosconsole has set it once, when it was loaded.
  ros::console::backend::function_print = &print;
  const std::lock_guard lock(console_mutex);
  console_host = host;
}

void close_console() {
  const std::lock_guard lock(console_mutex);
  console_host.reset();
}

void say(std::uint32_t level, const std::string& message) {
  const std::lock_guard lock(console_mutex);
  if (console_host) console_host->log(level, message);
}

}  // namespace hallway::ros1
