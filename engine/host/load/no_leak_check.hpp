// SPDX-License-Identifier: MIT
#pragma once

// For the main file of a program that holds a plugin, under the address sanitizer: defines a function.

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HALLWAY_ADDRESS_SANITIZER
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define HALLWAY_ADDRESS_SANITIZER
#endif

#ifdef HALLWAY_ADDRESS_SANITIZER
/// Looking for leaks takes what a confined process may not do: one that a plugin ends would end with another status than its own.
extern "C" const char* __asan_default_options() {
  return "detect_leaks=0";
}
#endif
