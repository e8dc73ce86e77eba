// SPDX-License-Identifier: MIT
// The one place where stb_truetype is compiled.
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_truetype.h>
