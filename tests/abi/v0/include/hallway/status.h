// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "growth.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What became of a call: HW_OK, or one of the HW_ERROR_ codes. Codes that a reader does not know are
/// failures.
typedef int32_t hw_status_t;

enum {
  HW_OK = 0,                 ///< done
  HW_ERROR_ARGUMENT = 1,     ///< an argument is null, unknown or malformed
  HW_ERROR_STATE = 2,        ///< the call is not allowed at this point of the life cycle
  HW_ERROR_NOT_FOUND = 3,    ///< nothing has that id, name or index
  HW_ERROR_RANGE = 4,        ///< a value is outside of its range
  HW_ERROR_UNSUPPORTED = 5,  ///< a request that this plugin or host does not serve
  HW_ERROR_MEMORY = 6,       ///< out of memory
  HW_ERROR_IO = 7,           ///< a file or device failed
  HW_ERROR_DATA = 8,         ///< data are not what they must be (not finite, counts that do not match)
  HW_ERROR_INTERNAL = 9      ///< a bug in the callee
};

/// The name of a status code, e.g. "HW_ERROR_RANGE"; "HW_ERROR_?" for a code that these headers do not know.
/// [any]
static inline const char* hw_status_name(hw_status_t status) {
  switch (status) {
    case HW_OK:
      return "HW_OK";
    case HW_ERROR_ARGUMENT:
      return "HW_ERROR_ARGUMENT";
    case HW_ERROR_STATE:
      return "HW_ERROR_STATE";
    case HW_ERROR_NOT_FOUND:
      return "HW_ERROR_NOT_FOUND";
    case HW_ERROR_RANGE:
      return "HW_ERROR_RANGE";
    case HW_ERROR_UNSUPPORTED:
      return "HW_ERROR_UNSUPPORTED";
    case HW_ERROR_MEMORY:
      return "HW_ERROR_MEMORY";
    case HW_ERROR_IO:
      return "HW_ERROR_IO";
    case HW_ERROR_DATA:
      return "HW_ERROR_DATA";
    case HW_ERROR_INTERNAL:
      return "HW_ERROR_INTERNAL";
    default:
      return "HW_ERROR_?";
  }
}

/// Bytes of hw_error_t.message, with its terminating 0.
#define HW_ERROR_MESSAGE_BYTES 1000

/// Why a call failed. Owned by the caller, who sets `size` and clears the rest; filled by the callee when it
/// returns anything but HW_OK. A failure without a message is a bug. Callers may pass null where the reason
/// does not matter.
typedef struct hw_error_t {
  uint32_t size;                         ///< sizeof(hw_error_t) of the caller
  hw_status_t status;                    ///< the same that the call returns
  char message[HW_ERROR_MESSAGE_BYTES];  ///< UTF-8, ends with 0; the cause alone, without a trailing newline
} hw_error_t;

/// Fills `error` (which may be null) and returns `status`; a message that is too long is cut. [any]
static inline hw_status_t hw_error_set(hw_error_t* error, hw_status_t status, const char* message) {
  if (error && HW_HAS(error, hw_error_t, message)) {
    size_t i = 0;
    error->status = status;
    for (; message && message[i] && i + 1 < HW_ERROR_MESSAGE_BYTES; ++i) error->message[i] = message[i];
    error->message[i] = 0;
  }
  return status;
}

#ifdef __cplusplus
}
#endif
