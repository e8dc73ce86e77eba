// SPDX-License-Identifier: MIT
#pragma once

// toml++ 3.3 or 3.4, for one source file: header-only, without exceptions, and defined for every ASCII text (toml_ascii.hpp says why no other).

#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#define TOML_MAX_NESTED_VALUES 32  // a scenario needs three, a batch four

// Texts such as `[[[a]]]` break a function's precondition: with assertions the program ends, without them (NDEBUG) clang takes the precondition as given.
// Where it is not checked, the function reports the malformed text as it should.
#define TOML_ASSERT(condition) static_assert(true)
#pragma push_macro("NDEBUG")
#undef NDEBUG
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")
