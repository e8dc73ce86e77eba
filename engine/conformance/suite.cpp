// SPDX-License-Identifier: MIT
#include "conformance/suite.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "base/child.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/shared_memory.hpp"
#include "base/spawn.hpp"
#include "base/text.hpp"
#include "conformance/test_process.hpp"
#include "host/isolate/plugin_process.hpp"
#include "host/machine/elf.hpp"

namespace hallway::conformance {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMaxReasonBytes = 4000;
constexpr std::chrono::milliseconds kBacktraceTime{300};

/// How a test's process ended and what it left.
struct Outcome {
  bool hung = false;
  ProcessEnd end{};
  Word word = Word::kNone;
  std::string call{};
  std::string text{};
  std::string digest{};
  std::vector<std::string> backtrace{};
};

template <std::size_t N>
std::string text_in(const std::array<char, N>& bytes) {
  std::array<char, N> copy{};
  std::memcpy(copy.data(), bytes.data(), N);  // once: its writer may still be at work
  return printable({copy.data(), ::strnlen(copy.data(), N)}, kMaxReasonBytes);
}

/// Files without a name for what a test's process writes to its standard output and error.
class OutputFile {
 public:
  OutputFile() : fd_(::memfd_create("hallway-test-output", MFD_CLOEXEC)) {
    if (fd_ < 0 || !move_above_standard(fd_)) throw Error(ErrorCode::kIo, "no memory file can be made");
  }
  ~OutputFile() {
    if (fd_ >= 0) ::close(fd_);
  }
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  int descriptor() const { return fd_; }

 private:
  int fd_;
};

Outcome read_note(const Note& note) {
  Outcome outcome;
  outcome.word = note.word.load();
  for (const auto& letter : note.call) {
    if (letter.load() == '\0') break;
    outcome.call += letter.load();
  }
  outcome.call = printable(outcome.call);
  outcome.text = text_in(note.text);
  outcome.digest = text_in(note.digest);
  return outcome;
}

/// A backtrace without what stands between the test and main().
std::vector<std::string> plugin_part(std::vector<std::string> backtrace) {
  const auto ours = std::ranges::find_if(
      backtrace, [](const std::string& line) { return line.starts_with(std::string(kTestProgram) + "+"); });
  backtrace.erase(ours, backtrace.end());
  return backtrace;
}

/// Runs the test of that name, or kInspection, in a process.
Outcome run_process(const std::string& test, const SuiteSetup& setup) {
  const host::ScratchFolder scratch(setup.temporary);
  Subject subject = setup.subject;
  subject.scratch = scratch.path();
  const SharedMemory memory("hallway-test", sizeof(Note), SharedMemory::Writers::kBoth);
  const OutputFile out;
  const OutputFile err;
  ProcessGroup process(find_helper(kTestProgram),
                       {.arguments = to_arguments(test, subject),
                        .descriptors = {-1, out.descriptor(), err.descriptor(), memory.descriptor()},
                        .own_session = false,
                        .environment = {}});
  const bool hung = !process.ended_by(Clock::now() + setup.timeout);
  if (hung) {
    process.signal(host::backtrace_signal());
    process.ended_by(Clock::now() + kBacktraceTime);
  }
  const ProcessEnd end = process.kill();
  const auto& note = *static_cast<const Note*>(static_cast<const void*>(memory.bytes().data()));
  Outcome outcome = read_note(note);
  outcome.hung = hung;
  outcome.end = end;
  if (hung || end.signalled) outcome.backtrace = plugin_part(host::read_crash_record(note.crash));
  return outcome;
}

/// What is wrong with how a process ended: "crashed with signal 11 (Segmentation fault) in process()"; empty: nothing.
std::string ending(const Outcome& outcome, const SuiteSetup& setup) {
  const std::string in_call = outcome.call.empty() ? "" : " in " + outcome.call + "()";
  if (outcome.hung) {
    return fmt::format("did not end within {} s{}", static_cast<double>(setup.timeout.count()) / 1e3,
                       in_call);
  }
  if (outcome.end.signalled) return describe({ChildFate::kSignalled, outcome.end.number}, {}) + in_call;
  if (outcome.word != Word::kNone && outcome.end.number == 0) return "";
  return fmt::format("ended its process with status {}{}", outcome.end.number, in_call);
}

Result judge(const Test& test, const Outcome& outcome, const SuiteSetup& setup) {
  Result result{
      .test = &test, .verdict = Verdict::kFailed, .reason = outcome.text, .backtrace = outcome.backtrace};
  const std::string end = ending(outcome, setup);
  if (outcome.word == Word::kFailed || outcome.word == Word::kNotLoadable ||
      outcome.word == Word::kBadInput) {
    if (!end.empty()) result.reason += "; then it " + end;
  } else if (!end.empty()) {
    result.reason = end;
    if (outcome.end.signalled) result.verdict = Verdict::kCrashed;
    if (outcome.hung) result.verdict = Verdict::kTimedOut;
  } else {
    result.verdict = outcome.word == Word::kSkipped ? Verdict::kSkipped : Verdict::kPassed;
  }
  return result;
}

Result run_one(const Test& test, const SuiteSetup& setup) {
  const Outcome first = run_process(test.name, setup);
  Result result = judge(test, first, setup);
  if (test.digest == nullptr || result.verdict != Verdict::kPassed) return result;
  const Outcome second = run_process(test.name, setup);
  result = judge(test, second, setup);
  if (result.verdict == Verdict::kPassed && first.digest != second.digest) {
    result.verdict = Verdict::kFailed;
    result.reason = "in another process, it answers the same frames otherwise";
  }
  return result;
}

std::vector<const Test*> chosen_tests(const SuiteSetup& setup) {
  std::vector<std::string> names;
  for (const Test& test : all_tests()) names.emplace_back(test.name);
  for (const std::string& wanted : setup.only) {
    if (find_test(wanted) != nullptr) continue;
    throw Error(ErrorCode::kUsage, fmt::format("there is no test `{}`{}; --list shows all", printable(wanted),
                                               suggestion(wanted, names)));
  }
  std::vector<const Test*> chosen;
  for (const Test& test : all_tests()) {
    const bool wanted = setup.only.empty() || std::ranges::count(setup.only, test.name) != 0;
    if (wanted) chosen.push_back(&test);
  }
  return chosen;
}

/// A word of a command line, for a shell.
std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && std::ranges::all_of(word, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::strchr("_-./=:,+", c) != nullptr;
  });
  if (plain) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

const char* verdict_name(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::kPassed:
      return "passed";
    case Verdict::kFailed:
      return "failed";
    case Verdict::kSkipped:
      return "skipped";
    case Verdict::kCrashed:
      return "crashed";
    case Verdict::kTimedOut:
      break;
  }
  return "timed_out";
}

std::string inspect_plugin(const SuiteSetup& setup) {
  chosen_tests(setup);
  host::check_library_file(setup.subject.file);
  const Outcome outcome = run_process(kInspection, setup);
  const Where where{.file = printable(setup.subject.file.string(), 4096)};
  if (outcome.word == Word::kNotLoadable) throw Error(ErrorCode::kPluginLoad, outcome.text, where);
  if (outcome.word == Word::kBadInput) throw Error(ErrorCode::kBadInput, outcome.text, where);
  if (outcome.word == Word::kUsage) throw Error(ErrorCode::kUsage, outcome.text, where);
  if (outcome.word == Word::kFailed) throw Error(ErrorCode::kPluginFault, outcome.text, where);
  if (outcome.word != Word::kPassed) throw Error(ErrorCode::kPluginFault, ending(outcome, setup), where);
  return outcome.text;
}

std::vector<Result> run_suite(const SuiteSetup& setup) {
  const std::vector<const Test*> tests = chosen_tests(setup);
  std::vector<Result> results(tests.size());
  parallel_for(tests.size(), 1, setup.jobs, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      results[i] = run_one(*tests[i], setup);
      if (setup.progress) setup.progress();
    }
  });
  return results;
}

std::string command_to_repeat(const SuiteSetup& setup, const Test& test) {
  std::string text =
      "hallway plugin validate " +
      quoted(setup.subject.file.string() + (setup.subject.plugin.empty() ? "" : ":" + setup.subject.plugin));
  for (const auto& [name, value] : setup.subject.settings) text += " --set " + quoted(name + "=" + value);
  return printable(text + fmt::format(" --test {} --seed {}", test.name, setup.subject.seed),
                   2 * kMaxReasonBytes);
}

}  // namespace hallway::conformance
