// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "host.h"
#include "plugin.h"

/// Id under which hw_entry_t.get_factory() gives a hw_plugin_factory_t.
#define HW_PLUGIN_FACTORY_ID "hw.plugin-factory/1"

/// Counts, describes and makes the plugins of a library. Frozen.
typedef struct hw_plugin_factory_t {
  /// Number of plugins in this library. [main]
  uint32_t (*count)(void);
  /// What plugin `index` is; null if there is none. [main]
  const hw_plugin_info_t* (*describe)(uint32_t index);
  /// Makes the plugin of that id, inactive and with default parameters, and fills `plugin`, which the caller
  /// owns. `host` outlives it. HW_ERROR_NOT_FOUND: no such id. [main]
  hw_status_t (*create)(const hw_host_t* host, const char* id, hw_plugin_t* plugin, hw_error_t* error);
} hw_plugin_factory_t;
