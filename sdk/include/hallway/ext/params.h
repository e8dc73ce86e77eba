// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "../status.h"

/// Id of the plugin's extension hw_params_t.
#define HW_EXT_PARAMS "hw.params/1"

/// Id of the plugin's extension hw_params_2_t; since 1.4.
#define HW_EXT_PARAMS_2 "hw.params/2"

/// Types of parameters. A host leaves a parameter of a type that it does not know at its default. The values of the last
/// three are texts and pass through hw_params_2_t alone: their hw_param_value_t has the type and as.integer 0, and
/// hw_params_t.set() refuses them with HW_ERROR_ARGUMENT.
enum {
  HW_PARAM_BOOL = 1,    ///< as.integer is 0 or 1
  HW_PARAM_INT = 2,     ///< as.integer
  HW_PARAM_DOUBLE = 3,  ///< as.real, finite
  HW_PARAM_CHOICE = 4,  ///< as.integer is an index into hw_param_info_t.choices
  HW_PARAM_TEXT = 5,    ///< a text; since 1.4
  HW_PARAM_FILE = 6,    ///< the absolute path of a file, or empty: none; since 1.4
  HW_PARAM_FOLDER = 7   ///< the absolute path of a folder, or empty: none; since 1.4
};

/// hw_param_info_t.flags.
enum {
  HW_PARAM_WRITABLE =
      1  ///< of HW_PARAM_FILE and HW_PARAM_FOLDER: the plugin writes there; else it only reads
};

/// Where the value of a parameter comes from.
enum {
  HW_PARAM_FROM_DEFAULT = 0,  ///< hw_param_info_t has it
  HW_PARAM_FROM_HOST = 1,     ///< the host has set it
  HW_PARAM_FROM_SENSOR = 2    ///< the plugin has taken it from a sensor's description, at activation
};

/// Bytes of a text parameter's value, with its terminating 0.
#define HW_PARAM_TEXT_BYTES 4096

/// The value of a parameter. Frozen.
typedef struct hw_param_value_t {
  uint32_t type;      ///< HW_PARAM_…
  uint32_t reserved;  ///< 0
  union {
    int64_t integer;  ///< of all types but HW_PARAM_DOUBLE
    double real;      ///< of HW_PARAM_DOUBLE
  } as;               ///< the value, by type
} hw_param_value_t;

/// What a parameter is; lives as long as the plugin. Texts are UTF-8 and never null.
typedef struct hw_param_info_t {
  uint32_t size;                   ///< sizeof(hw_param_info_t) of the plugin
  uint32_t type;                   ///< HW_PARAM_…
  const char* name;                ///< snake_case, distinct, ends with the unit where it has one (`noise_m`)
  const char* unit;                ///< e.g. "m"; empty where it has none
  const char* help;                ///< one sentence: what it does and how to choose it
  hw_param_value_t default_value;  ///< within the range
  hw_param_value_t minimum;        ///< smallest value allowed, of the same type; not read for bool and choice
  hw_param_value_t maximum;        ///< largest value allowed, of the same type; not read for bool and choice
  const char* const* choices;      ///< names of the choices, for HW_PARAM_CHOICE; else null
  uint32_t n_choices;              ///< number of choices
  uint32_t reserved;               ///< 0
  const char* default_text;        ///< of a text type: its default, UTF-8; else null. Since 1.4
  uint32_t flags;                  ///< HW_PARAM_WRITABLE. Since 1.4
  uint32_t reserved_2;             ///< 0. Since 1.4
} hw_param_info_t;

/// The parameters of a plugin. Frozen. `self` is the plugin's.
///
/// A parameter that describes a sensor (`noise_m`) and that the host has not set may be taken from hw_activation_t. Then
/// get() gives the value in effect while the plugin is active, and the default again afterwards.
typedef struct hw_params_t {
  /// Number of parameters; does not change. [main]
  uint32_t (*count)(void* self);
  /// What parameter `index` is; null if there is none. [main]
  const hw_param_info_t* (*describe)(void* self, uint32_t index);
  /// The value of parameter `index`. [main]
  hw_status_t (*get)(void* self, uint32_t index, hw_param_value_t* value, hw_error_t* error);
  /// Sets parameter `index`; only while the plugin is inactive (else HW_ERROR_STATE). HW_ERROR_RANGE: outside
  /// of the range, HW_ERROR_ARGUMENT: another type; the old value then stays. [main]
  hw_status_t (*set)(void* self, uint32_t index, const hw_param_value_t* value, hw_error_t* error);
} hw_params_t;

/// What hw_params_t has no functions for; with the same indices. A plugin that has it has hw_params_t too. Frozen.
typedef struct hw_params_2_t {
  /// The value of parameter `index`, of a text type: UTF-8, owned by the plugin, valid until the next call of set_text().
  /// HW_ERROR_ARGUMENT: not of a text type. [main]
  hw_status_t (*get_text)(void* self, uint32_t index, const char** text, hw_error_t* error);
  /// Sets parameter `index`, of a text type; only while the plugin is inactive (else HW_ERROR_STATE). The plugin copies
  /// `text`, at most HW_PARAM_TEXT_BYTES bytes of UTF-8. The host has seen to it that a file or folder exists. HW_ERROR_ARGUMENT: not
  /// of a text type; the old value then stays. [main]
  hw_status_t (*set_text)(void* self, uint32_t index, const char* text, hw_error_t* error);
  /// Where the value of parameter `index` comes from, HW_PARAM_FROM_…; HW_PARAM_FROM_DEFAULT if there is no such
  /// parameter. What the host has set stays HW_PARAM_FROM_HOST for good, also while active. [main]
  uint32_t (*origin)(void* self, uint32_t index);
} hw_params_2_t;
