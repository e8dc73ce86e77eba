// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "output.h"
#include "status.h"
#include "version.h"

/// What a host does for a plugin. Frozen; more is reached through get_extension().
typedef struct hw_host_vtable_t {
  /// Hands over one answer; valid only while the host is inside process() or report() of this plugin. The
  /// host copies what it knows of the output and skips kinds that it does not know (which is HW_OK).
  /// HW_ERROR_DATA or HW_ERROR_ARGUMENT: the output is malformed, and the host takes the plugin to be at
  /// fault. [loop]
  hw_status_t (*put)(void* self, const hw_output_t* output);
  /// The host's extension of that id (e.g. HW_EXT_LOG), or null; lives as long as the plugin. [any]
  const void* (*get_extension)(void* self, const char* id);
} hw_host_vtable_t;

/// The host of one plugin instance; lives longer than the instance.
typedef struct hw_host_t {
  uint32_t size;                   ///< sizeof(hw_host_t) of the host
  uint32_t reserved;               ///< 0
  hw_version_t abi;                ///< what the host was compiled against
  const hw_host_vtable_t* vtable;  ///< never null, no function in it is null
  void* self;                      ///< first argument of every function of the vtable
  const char* name;                ///< e.g. "hallway", for messages only: nothing may depend on it
  const char* version;             ///< e.g. "0.1.0", for messages only
} hw_host_t;
