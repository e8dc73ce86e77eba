// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

/// Id of the host's extension hw_log_t.
#define HW_EXT_LOG "hw.log/1"

/// How much a message matters.
enum {
  HW_LOG_DEBUG = 0,    ///< for the plugin's author
  HW_LOG_INFO = 1,     ///< worth knowing
  HW_LOG_WARNING = 2,  ///< the run goes on, but somebody should look
  HW_LOG_ERROR = 3     ///< something failed
};

/// Where a plugin writes what a person should read: never to stdout or stderr. Frozen.
typedef struct hw_log_t {
  /// Writes one message of UTF-8 text without a trailing newline. `host_self` is hw_host_t.self. [any]
  void (*write)(void* host_self, uint32_t level, const char* message);
} hw_log_t;
