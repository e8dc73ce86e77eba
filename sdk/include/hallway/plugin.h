// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "robot.h"
#include "sample.h"
#include "status.h"

/// Asks for the map as it would be after all that the plugin can still do about it, e.g. a solution of the
/// whole; may take long. A plugin that has nothing of the kind gives the map as it stands.
#define HW_REPORT_REFINE 1u

/// What report() is asked for.
typedef struct hw_report_request_t {
  uint32_t size;   ///< sizeof(hw_report_request_t) of the host
  uint32_t flags;  ///< HW_REPORT_REFINE
} hw_report_request_t;

/// The functions of a plugin. Frozen; more is reached through get_extension(). No exception, exit, signal or
/// write to stdout or stderr may cross. The host makes these calls one after the other, in this life cycle:
///
///     create → (parameters) → activate → { process | report | reset }* → deactivate → … activate … → destroy
typedef struct hw_plugin_vtable_t {
  /// Makes ready for frames; parameters stand from here on. On failure the plugin stays inactive. [main]
  hw_status_t (*activate)(void* self, const hw_activation_t* activation, hw_error_t* error);
  /// Ends what activate() began and forgets the map. Only called while active. [main]
  void (*deactivate)(void* self);
  /// Forgets the map: what follows is as after activate(), to the last bit. Only called while active. [loop]
  hw_status_t (*reset)(void* self, hw_error_t* error);
  /// Takes one frame and puts the answers to it (pose, associations, counters) through the host. Only called
  /// while active. After a failure the host makes no call but deactivate() and destroy(). [loop]
  hw_status_t (*process)(void* self, const hw_frame_t* frame, hw_error_t* error);
  /// Puts the map (landmarks, mapped planes, submaps, topology) through the host. Only called while active. [loop]
  hw_status_t (*report)(void* self, const hw_report_request_t* request, hw_error_t* error);
  /// The plugin's extension of that id (e.g. HW_EXT_PARAMS), or null; lives as long as the plugin. [main]
  const void* (*get_extension)(void* self, const char* id);
  /// Frees the plugin; deactivate() has been called if it was active. [main]
  void (*destroy)(void* self);
} hw_plugin_vtable_t;

/// A plugin instance. Frozen.
typedef struct hw_plugin_t {
  const hw_plugin_vtable_t* vtable;  ///< never null, no function in it is null
  void* self;                        ///< first argument of every function of the vtable
} hw_plugin_t;

/// What a plugin is; lives as long as its library is loaded. Texts are UTF-8 and never null, but may be empty
/// except `id`.
typedef struct hw_plugin_info_t {
  uint32_t size;            ///< sizeof(hw_plugin_info_t) of the plugin
  uint32_t n_inputs;        ///< number of entries in `inputs`
  const char* id;           ///< unique and stable; letters, digits and _ - . only
  const char* name;         ///< for people
  const char* version;      ///< of the plugin, e.g. "1.2.0"
  const char* vendor;       ///< who made it
  const char* description;  ///< one sentence
  const uint32_t* inputs;   ///< HW_SAMPLE_… that it needs; each must have a producer
  const uint32_t* outputs;  ///< HW_OUTPUT_… that it may put
  uint32_t n_outputs;       ///< number of entries in `outputs`
  uint32_t reserved;        ///< 0
  /// HW_SAMPLE_… that it takes where there are any, besides `inputs`; none of them needs a producer. Since 1.4.
  const uint32_t* optional_inputs;
  uint32_t n_optional_inputs;  ///< number of entries in `optional_inputs`
  uint32_t reserved_1_4;       ///< 0
} hw_plugin_info_t;
