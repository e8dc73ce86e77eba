// SPDX-License-Identifier: MIT
//
// Preloaded into a program, this makes one of its writes to the disk go wrong. FAILING_IO_AT says which one (1 is the first of all
// write, pwrite, fsync, rename and ftruncate on regular files and folders), FAILING_IO_HOW what happens:
// error    nothing is written, the call fails with EIO
// kill     half of it is written, the program is killed
// after    all of it is written, the program is killed
// FAILING_IO_COUNT names a file that gets the number of such calls when the program ends by itself.

#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum how { kNone, kError, kKill, kAfter };

static long calls = 0;
static long chosen = 0;
static enum how what = kNone;

/* Puts the address of the real function into a function pointer, the way POSIX has it: the two have one representation. */
static void find(void* function, const char* name) {
  void* address = dlsym(RTLD_NEXT, name);
  memcpy(function, &address, sizeof address);
}

__attribute__((constructor)) static void begin(void) {
  const char* at = getenv("FAILING_IO_AT");
  const char* how = getenv("FAILING_IO_HOW");
  if (at != NULL) chosen = strtol(at, NULL, 10);
  if (how != NULL) what = strcmp(how, "error") == 0 ? kError : strcmp(how, "kill") == 0 ? kKill : kAfter;
}

__attribute__((destructor)) static void end(void) {
  const char* file = getenv("FAILING_IO_COUNT");
  if (file == NULL) return;
  FILE* out = fopen(file, "w");
  if (out == NULL) return;
  fprintf(out, "%ld\n", calls);
  fclose(out);
}

static int counts(int fd) {
  struct stat info;
  return fd > 2 && fstat(fd, &info) == 0 && (S_ISREG(info.st_mode) || S_ISDIR(info.st_mode));
}

/* What is to happen to this call. */
static enum how now(void) {
  return ++calls == chosen ? what : kNone;
}

static void die(void) {
  raise(SIGKILL);
}

ssize_t write(int fd, const void* data, size_t size) {
  ssize_t (*real)(int, const void*, size_t);
  find(&real, "write");
  const enum how how = counts(fd) ? now() : kNone;
  if (how == kError) return errno = EIO, -1;
  const ssize_t done = real(fd, data, how == kKill ? size / 2 : size);
  if (how != kNone) die();
  return done;
}

ssize_t pwrite(int fd, const void* data, size_t size, off_t at) {
  ssize_t (*real)(int, const void*, size_t, off_t);
  find(&real, "pwrite");
  const enum how how = counts(fd) ? now() : kNone;
  if (how == kError) return errno = EIO, -1;
  const ssize_t done = real(fd, data, how == kKill ? size / 2 : size, at);
  if (how != kNone) die();
  return done;
}

ssize_t pwrite64(int fd, const void* data, size_t size, off64_t at) {
  return pwrite(fd, data, size, at);
}

int fsync(int fd) {
  int (*real)(int);
  find(&real, "fsync");
  const enum how how = counts(fd) ? now() : kNone;
  if (how == kError) return errno = EIO, -1;
  if (how == kKill) die();
  const int result = real(fd);
  if (how == kAfter) die();
  return result;
}

int ftruncate(int fd, off_t size) {
  int (*real)(int, off_t);
  find(&real, "ftruncate");
  const enum how how = counts(fd) ? now() : kNone;
  if (how == kError) return errno = EIO, -1;
  if (how == kKill) die();
  const int result = real(fd, size);
  if (how == kAfter) die();
  return result;
}

int rename(const char* from, const char* to) {
  int (*real)(const char*, const char*);
  find(&real, "rename");
  const enum how how = now();
  if (how == kError) return errno = EIO, -1;
  if (how == kKill) die();
  const int result = real(from, to);
  if (how == kAfter) die();
  return result;
}
