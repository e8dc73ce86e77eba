// SPDX-License-Identifier: MIT
#include "host/isolate/crash_record.hpp"

#include <cxxabi.h>
#include <dlfcn.h>
#include <execinfo.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>

#include "base/text.hpp"

namespace hallway::host {
namespace {

constexpr int kFatal[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGSYS, SIGTRAP};
constexpr int kMaxFrames = 48;

CrashRecord* the_record = nullptr;
alignas(
    16) std::array<char, std::size_t{256} << 10> the_stack;  ///< arm64 saves up to 64 KiB of registers on it

/// Text of a fixed size, made without the heap: this runs in signal handlers.
class Line {
 public:
  explicit Line(std::array<char, 320>& text) : text_(text) {}
  ~Line() { text_[used_] = '\0'; }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  void add(const char* words) {
    for (; *words != '\0' && used_ + 1 < text_.size(); ++words) text_[used_++] = *words;
  }
  void add_hex(std::uintptr_t number) {
    char digits[2 * sizeof number + 1];
    std::size_t at = sizeof digits;
    digits[--at] = '\0';
    do {
      digits[--at] = "0123456789abcdef"[number % 16];
      number /= 16;
    } while (number != 0);
    add("0x");
    add(digits + at);
  }

 private:
  std::array<char, 320>& text_;
  std::size_t used_ = 0;
};

/// "libfoo.so+0x12ab _ZN3fooEv": the place in the file, which is the same in every run, and the function, where the file names it.
void describe(void* address, Line& line) {
  Dl_info info{};
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  if (::dladdr(address, &info) == 0 || info.dli_fname == nullptr) {
    line.add_hex(at);
    return;
  }
  const char* slash = std::strrchr(info.dli_fname, '/');
  line.add(slash != nullptr ? slash + 1 : info.dli_fname);
  line.add("+");
  line.add_hex(at - reinterpret_cast<std::uintptr_t>(info.dli_fbase));
  if (info.dli_sname == nullptr) return;
  line.add(" ");
  line.add(info.dli_sname);
}

[[gnu::noinline]] void record_backtrace(int skip) {
  void* frames[kMaxFrames];
  const int n = ::backtrace(frames, kMaxFrames);
  CrashRecord& record = *the_record;
  record.lines = 0;
  record.complete = 0;
  for (int i = skip; i < n; ++i) {
    const std::uint32_t at = record.lines;
    {
      Line line(record.text[at]);
      describe(frames[i], line);
    }
    record.lines = at + 1;
  }
  record.complete = 1;
}

void on_fatal(int signal) {
  // Once more, or on another thread meanwhile: as if there were no handler.
  static std::atomic_flag entered = ATOMIC_FLAG_INIT;
  ::signal(signal, SIG_DFL);
  if (!entered.test_and_set()) record_backtrace(3);
  ::raise(signal);
}

void on_question(int) {
  const int kept = errno;
  record_backtrace(3);
  errno = kept;
}

[[noreturn]] void on_no_memory() {
  the_record->out_of_memory = 1;
  throw std::bad_alloc();
}

void handle(int signal, void (*handler)(int), int flags) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  ::sigaction(signal, &action, nullptr);
}

std::string demangled(const std::string& line) {
  const std::size_t space = line.find(' ');
  if (space == std::string::npos) return line;
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> name(
      abi::__cxa_demangle(line.c_str() + space + 1, nullptr, nullptr, &status), std::free);
  return status == 0 ? line.substr(0, space + 1) + name.get() : line;
}

}  // namespace

int backtrace_signal() {
  return SIGRTMAX - 1;
}

void keep_crash_record(CrashRecord& record) {
  the_record = &record;
  void* frame = nullptr;
  ::backtrace(&frame, 1);  // the first call loads a library, which no signal handler could
  stack_t stack{};
  stack.ss_sp = the_stack.data();
  stack.ss_size = the_stack.size();
  ::sigaltstack(&stack, nullptr);
  for (const int signal : kFatal) handle(signal, on_fatal, SA_ONSTACK | SA_NODEFER);
  handle(backtrace_signal(), on_question, SA_ONSTACK | SA_RESTART);
  std::set_new_handler(on_no_memory);
}

std::vector<std::string> read_crash_record(const CrashRecord& record) {
  std::vector<std::string> lines;
  const std::size_t n = std::min<std::size_t>(record.lines, record.text.size());
  for (std::size_t i = 0; i < n; ++i) {
    const std::array<char, 320> copy = record.text[i];
    const std::string line(copy.data(), strnlen(copy.data(), copy.size()));
    lines.push_back(printable(demangled(line), 1000));
  }
  return lines;
}

}  // namespace hallway::host
