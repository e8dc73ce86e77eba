// SPDX-License-Identifier: MIT
#include "conformance/test_process.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <exception>

#include "base/error.hpp"
#include "base/helper.hpp"
#include "base/sandbox.hpp"
#include "base/shared_memory.hpp"
#include "base/text.hpp"
#include "conformance/call_mark.hpp"
#include "conformance/instance.hpp"

namespace hallway::conformance {
namespace {

constexpr std::uint64_t kDataBytes = std::uint64_t{4} << 30;
constexpr std::uint64_t kFileBytes = std::uint64_t{1} << 20;
constexpr std::size_t kFixedArguments = 6;

Note* note = nullptr;

/// A text, cut where it must be, with its end.
template <std::size_t N>
void copy_text(std::array<char, N>& to, const std::string& text) {
  const std::size_t length = std::min(text.size(), N - 1);
  std::memcpy(to.data(), text.data(), length);
  to[length] = '\0';
}

void leave(Word word, const std::string& text) {
  copy_text(note->text, text);
  note->word.store(word);
}

/// The ids of the first few plugins, between commas.
std::string ids_of(const LoadedLibrary& library, std::uint32_t count) {
  constexpr std::uint32_t kShown = 20;
  std::string ids;
  for (std::uint32_t i = 0; i < std::min(count, kShown); ++i) {
    const hw_plugin_info_t* info = marked("describe", [&] { return library.factory().describe(i); });
    ids += (i == 0 ? "" : ", ") + std::string(info != nullptr && info->id != nullptr ? info->id : "?");
  }
  return count > kShown ? ids + ", ..." : ids;
}

/// Throws Error, Failed or NotLoadable.
void inspect(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  const std::uint32_t count = marked("count", [&] { return library.factory().count(); });
  const hw_plugin_info_t& info = library.info(subject.plugin);
  if (subject.plugin.empty() && count > 1) {
    throw Error(ErrorCode::kUsage,
                "holds several plugins, say which with --plugin: " + ids_of(library, count));
  }
  if (!subject.settings.empty()) const Instance plugin(library, subject);
  leave(Word::kPassed, info.id);
}

void run_test(const Test& test, const Subject& subject) {
  if (test.digest != nullptr) {
    copy_text(note->digest, test.digest(subject));
  } else {
    test.run(subject);
  }
  leave(Word::kPassed, "");
}

Word word_of(const Error& error) {
  switch (error.code()) {
    case ErrorCode::kPluginLoad:
      return Word::kNotLoadable;
    case ErrorCode::kUsage:
      return Word::kUsage;
    case ErrorCode::kBadInput:
      return Word::kBadInput;
    default:
      return Word::kFailed;
  }
}

/// Runs what `name` says and leaves how it ended.
void judge(const std::string& name, const Subject& subject) {
  try {
    const Test* test = find_test(name);
    if (test == nullptr) {
      inspect(subject);
    } else {
      run_test(*test, subject);
    }
  } catch (const Skipped& skipped) {
    leave(Word::kSkipped, skipped.what());
  } catch (const Failed& failed) {
    leave(Word::kFailed, failed.what());
  } catch (const NotLoadable& problem) {
    leave(Word::kNotLoadable, problem.what());
  } catch (const Error& error) {
    leave(word_of(error), error.message());
  } catch (const std::exception& problem) {
    leave(Word::kFailed, std::string("the test ended with: ") + problem.what());
  }
}

}  // namespace

void mark_call(const char* name) noexcept {
  if (note == nullptr) return;
  const std::string_view text = name != nullptr ? name : "";
  for (std::size_t i = 0; i < note->call.size(); ++i) {
    note->call[i].store(i < text.size() ? text[i] : '\0', std::memory_order_relaxed);
  }
}

std::vector<std::string> to_arguments(const std::string& test, const Subject& subject) {
  std::vector<std::string> arguments{std::to_string(::getpid()),   test,
                                     subject.file.string(),        subject.plugin,
                                     std::to_string(subject.seed), subject.scratch.string()};
  for (const auto& [name, value] : subject.settings) {
    arguments.push_back(name);
    arguments.push_back(value);
  }
  return arguments;
}

void run_test_process(const std::vector<std::string>& arguments) {
  if (arguments.size() < kFixedArguments) ::_exit(2);
  if (!end_with_parent(parse_int(arguments[0]).value_or(0))) ::_exit(1);
  Subject subject{.file = arguments[2],
                  .plugin = arguments[3],
                  .seed = parse_uint(arguments[4]).value_or(1),
                  .scratch = arguments[5]};
  for (std::size_t i = kFixedArguments; i + 1 < arguments.size(); i += 2) {
    subject.settings.emplace_back(arguments[i], arguments[i + 1]);
  }
  const Test* test = find_test(arguments[1]);
  SharedMemory memory(kNoteDescriptor, true);
  note = static_cast<Note*>(static_cast<void*>(memory.bytes().data()));
  host::keep_crash_record(note->crash);
  ::signal(SIGXFSZ, SIG_IGN);  // a file that is too large is an error of write()
  if (test != nullptr && test->way == Way::kUnconfined) {
    ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  } else {
    confine(
        {.data_bytes = kDataBytes, .file_bytes = kFileBytes, .open_files = 256, .scratch = subject.scratch});
  }
  judge(arguments[1], subject);
  ::_exit(0);
}

}  // namespace hallway::conformance
