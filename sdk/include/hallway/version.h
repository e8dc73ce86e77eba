// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#if UINTPTR_MAX != UINT64_MAX
#error "the Hallway plugin ABI is defined for 64-bit targets"
#endif

/// Version of the ABI that these headers describe. A host loads a plugin if and only if their major numbers
/// are equal; within one major number everything grows by the rules of growth.h, so that any minor number
/// works with any other.
#define HW_ABI_MAJOR 1u
#define HW_ABI_MINOR 6u

/// Version of the ABI that something was compiled against. Frozen.
typedef struct hw_version_t {
  uint32_t abi_major;  ///< HW_ABI_MAJOR
  uint32_t abi_minor;  ///< HW_ABI_MINOR
} hw_version_t;
