// SPDX-License-Identifier: MIT
#pragma once

#include "status.h"
#include "version.h"

#ifdef __cplusplus
#define HW_EXTERN_C extern "C"
#else
#define HW_EXTERN_C extern
#endif

/// Marks the one symbol that a plugin library shows.
#define HW_EXPORT __attribute__((visibility("default")))

/// Name of the exported symbol.
#define HW_ENTRY_SYMBOL "hw_entry"

/// The door of a plugin library. Frozen; `abi` stands first in every version, past and to come, and is a
/// constant in the file, so that a host can read it before it runs any code of the library.
typedef struct hw_entry_t {
  hw_version_t abi;  ///< {HW_ABI_MAJOR, HW_ABI_MINOR}
  /// Called once after loading, before anything else. `library_path` is the path of the file that was loaded.
  /// [main]
  hw_status_t (*init)(const char* library_path, hw_error_t* error);
  /// Called once before unloading, after every plugin of the library was destroyed, if init() gave HW_OK.
  /// [main]
  void (*deinit)(void);
  /// The factory of that id (e.g. HW_PLUGIN_FACTORY_ID), or null; lives until deinit(). [main]
  const void* (*get_factory)(const char* id);
} hw_entry_t;

/// What every plugin library defines and exports.
HW_EXTERN_C HW_EXPORT const hw_entry_t hw_entry;
