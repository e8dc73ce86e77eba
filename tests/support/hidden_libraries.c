// SPDX-License-Identifier: MIT
//
// Preloaded into a program, this hides libraries from it as if they were not installed: dlopen() of a file whose name contains a word of
// HIDDEN_LIBRARIES (separated by ':') fails as it does for a file that is not there.

#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int hidden(const char* file) {
  const char* words = getenv("HIDDEN_LIBRARIES");
  while (file != NULL && words != NULL && *words != '\0') {
    char word[64];
    const size_t length = strcspn(words, ":");
    snprintf(word, sizeof word, "%.*s", (int)length, words);
    if (word[0] != '\0' && strstr(file, word) != NULL) return 1;
    words += length + (words[length] == ':');
  }
  return 0;
}

void* dlopen(const char* file, int mode) {
  void* (*real)(const char*, int);
  void* address = dlsym(RTLD_NEXT, "dlopen");
  memcpy(&real, &address, sizeof address);
  if (!hidden(file)) return real(file, mode);
  char other[128];
  snprintf(other, sizeof other, "%s.hidden", file);
  return real(other, mode); /* which is not there, and leaves the words for dlerror() */
}
