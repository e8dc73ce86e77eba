// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "../status.h"

/// Id of the plugin's extension hw_params_t.
#define HW_EXT_PARAMS "hw.params/1"

/// Types of parameters. A host leaves a parameter of a type that it does not know at its default.
enum {
  HW_PARAM_BOOL = 1,    ///< as.integer is 0 or 1
  HW_PARAM_INT = 2,     ///< as.integer
  HW_PARAM_DOUBLE = 3,  ///< as.real, finite
  HW_PARAM_CHOICE = 4   ///< as.integer is an index into hw_param_info_t.choices
};

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
} hw_param_info_t;

/// The parameters of a plugin. Frozen. `self` is the plugin's.
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
