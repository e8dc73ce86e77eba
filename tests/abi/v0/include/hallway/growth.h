// SPDX-License-Identifier: MIT
#pragma once

#include <stddef.h>
#include <stdint.h>

// How the ABI grows without breaking a plugin or a host that was compiled before:
//
// 1. Vtables are frozen for ever. A new function is a new extension ("hw.name/2"), asked for with get_extension().
// 2. A data struct whose first member is `size` grows only at its end, in steps of whole 8 bytes, without padding that
//    the compiler would choose. Its writer sets `size` to sizeof the struct as compiled; its reader asks HW_HAS() before
//    it reads a member that did not exist in version 1.0. Such a struct is reached by pointer, also within lists
//    (`const hw_sample_t *const *`), never by index arithmetic: the reader's sizeof is not the writer's.
// 3. A struct without `size` is frozen for ever. Lists of such structs (points, landmarks) carry their `stride`, the
//    distance in bytes from one element to the next, which may be larger than the struct.
// 4. Numbers (kinds, flags, status codes) are never given a second meaning. A reader skips kinds that it does not know
//    and ignores flags that it does not know; members called `reserved` are written as 0 and not read.
// 5. A minor version never asks more of a caller than the one before.

/// Whether the struct at `p` (of type `type`, whose first member is `size`) was written with the member
/// `member`. `p` must not be null.
#define HW_HAS(p, type, member) ((p)->size >= offsetof(type, member) + sizeof((p)->member))

/// A conversion that both C and C++ accept without a warning.
#ifdef __cplusplus
#define HW_CAST(type, expression) static_cast<type>(expression)
#else
#define HW_CAST(type, expression) ((type)(expression))
#endif
