// SPDX-License-Identifier: MIT
// The same frames give the same answers, to the last bit, wherever a plugin runs.
#include <stdlib.h>
#include <unistd.h>

#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "base/hash.hpp"
#include "conformance/instance.hpp"
#include "conformance/surroundings.hpp"
#include "conformance/walk.hpp"

namespace hallway::conformance {
namespace {

constexpr std::uint64_t kResultFrames = 8;
constexpr std::size_t kThreads = 4;

std::string answers_of(const LoadedLibrary& library, const Subject& subject, const HostShape& host = {}) {
  Active plugin(library, subject, host);
  return plugin.walk(0, kResultFrames);
}

/// Runs `work` on another thread, and throws here what it throws there.
void on_another_thread(const std::function<void()>& work) {
  std::exception_ptr problem;
  std::thread([&] {
    try {
      work();
    } catch (...) {
      problem = std::current_exception();
    }
  }).join();
  if (problem) std::rethrow_exception(problem);
}

void new_ones_answer_the_same(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  const std::string first = answers_of(library, subject);
  for (int i = 0; i < 2; ++i) {
    demand_same(answers_of(library, subject), first, "another new plugin answers the same frames otherwise");
  }
}

std::string digest_of_answers(const Subject& subject) {
  return content_hash(answers_of(LoadedLibrary(subject.file), subject));
}

void threads_in_turn_answer_the_same(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  const std::string expected = answers_of(library, subject);
  Active plugin(library, subject);
  std::string bytes;
  for (std::uint64_t step = 0; step < kResultFrames; ++step) {
    on_another_thread([&] { bytes += plugin.step(step).bytes(); });
  }
  on_another_thread([&] { bytes += plugin.report(0).put.bytes; });
  demand_same(bytes, expected, "called on several threads in turn, it answers otherwise");
}

void threads_at_once_answer_the_same(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  std::vector<Subject> subjects(kThreads, subject);
  std::vector<std::string> expected;
  std::vector<std::unique_ptr<Instance>> plugins;
  for (std::size_t i = 0; i < kThreads; ++i) {
    subjects[i].seed += i / 2;
    expected.push_back(answers_of(library, subjects[i]));
  }
  for (std::size_t i = 0; i < kThreads; ++i) {
    plugins.push_back(std::make_unique<Instance>(library, subjects[i]));
    plugins.back()->activate();
  }
  std::vector<std::string> bytes(kThreads);
  std::vector<std::exception_ptr> problems(kThreads);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < kThreads; ++i) {
    threads.emplace_back([&, i] {
      try {
        bytes[i] = plugins[i]->walk(0, kResultFrames);
      } catch (...) {
        problems[i] = std::current_exception();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < kThreads; ++i) {
    if (problems[i]) std::rethrow_exception(problems[i]);
    demand_same(bytes[i], expected[i], "while others of its kind run on other threads, it answers otherwise");
  }
}

void locale_does_not_matter(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  const std::string expected = answers_of(library, subject);
  if (!set_comma_locale(subject.scratch)) throw Skipped("no locale with a decimal comma could be made");
  demand_same(answers_of(library, subject), expected,
              "where the decimal point is a comma, it answers otherwise");
}

void folder_does_not_matter(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  const std::string expected = answers_of(library, subject);
  if (::chdir("/") != 0) throw Skipped("the working folder cannot be changed");
  demand_same(answers_of(library, subject), expected, "in another working folder, it answers otherwise");
}

void environment_does_not_matter(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  ::setenv("HOME", "/root", 1);
  const std::string expected = answers_of(library, subject);
  ::clearenv();
  ::setenv("OMP_NUM_THREADS", "3", 1);
  ::setenv("TZ", "Asia/Tokyo", 1);
  demand_same(answers_of(library, subject), expected, "with another environment, it answers otherwise");
}

void host_name_does_not_matter(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  demand_same(answers_of(library, subject, {.name = "another_host", .version = "99.1.2"}),
              answers_of(library, subject), "with a host of another name, it answers otherwise");
}

constexpr Test kResultTests[] = {
    {"same-again", "New plugins answer the same frames the same, one after the other.",
     new_ones_answer_the_same},
    {"same-processes",
     "Two processes answer the same frames the same: no clock, no chance, no order of addresses.", nullptr,
     Way::kConfined, digest_of_answers},
    {"same-threads", "Called on another thread for each frame, a plugin answers the same.",
     threads_in_turn_answer_the_same},
    {"same-at-once", "Four plugins that run at once on four threads answer as each does alone.",
     threads_at_once_answer_the_same},
    {"same-locale", "Where the decimal point is a comma (de_DE), a plugin answers the same.",
     locale_does_not_matter},
    {"same-folder", "In another working folder a plugin answers the same.", folder_does_not_matter},
    {"same-environment", "With other environment variables a plugin answers the same.",
     environment_does_not_matter},
    {"same-host-name", "With a host of another name and version a plugin answers the same.",
     host_name_does_not_matter},
};

}  // namespace

std::span<const Test> result_tests() {
  return kResultTests;
}

}  // namespace hallway::conformance
