// SPDX-License-Identifier: MIT
// What a plugin leaves alone, and takes away with it.
#include <locale.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "conformance/instance.hpp"
#include "conformance/surroundings.hpp"
#include "conformance/walk.hpp"

namespace hallway::conformance {
namespace {

constexpr std::uint64_t kMannersFrames = 4;

/// A whole life of a plugin, from loading to unloading.
void live(const Subject& subject) {
  LoadedLibrary library(subject.file);
  Instance plugin(library, subject);
  plugin.parameters();
  plugin.activate();
  plugin.walk(0, kMannersFrames);
  plugin.report(HW_REPORT_REFINE).demand_good();
  plugin.must_reset();
  plugin.walk(kMannersFrames, kMannersFrames + 1);
  plugin.close();
  library.unload();
}

/// Throws Failed unless `look()` gives the same before and after a life, and in between.
template <typename Look>
void demand_unchanged(const Subject& subject, const char* what, Look&& look) {
  const auto before = look();
  {
    const LoadedLibrary library(subject.file);
    Instance plugin(library, subject);
    plugin.activate();
    plugin.walk(0, kMannersFrames);
    demand(look() == before, std::string(what) + " changed while the plugin was active");
  }
  demand(look() == before, std::string(what) + " changed by the end of the plugin");
}

off_t bytes_written_to(int fd) {
  struct stat facts {};
  return ::fstat(fd, &facts) == 0 ? facts.st_size : 0;
}

void is_silent(const Subject& subject) {
  live(subject);
  std::fflush(nullptr);
  for (const int fd : {STDOUT_FILENO, STDERR_FILENO}) {
    const off_t bytes = bytes_written_to(fd);
    demand(bytes == 0, "it wrote " + std::to_string(bytes) + " bytes to " +
                           (fd == STDOUT_FILENO ? "standard output" : "standard error"));
  }
}

void closes_what_it_opens(const Subject& subject) {
  const std::vector<std::string> before = open_descriptors();
  live(subject);
  const std::vector<std::string> after = open_descriptors();
  for (const std::string& descriptor : after) {
    demand(std::ranges::find(before, descriptor) != before.end(),
           "descriptor " + descriptor + " is left open");
  }
  demand(after.size() == before.size(), "it closed descriptors that are not its own");
}

void ends_its_threads(const Subject& subject) {
  const std::size_t before = count_threads();
  live(subject);
  const std::size_t after = count_threads_down_to(before);
  demand(after <= before, std::to_string(after - before) + " threads are left");
}

void starts_no_processes(const Subject& subject) {
  live(subject);
  if (!has_children()) return;
  end_children();
  throw Failed("a process is left that it started");
}

void keeps_signals(const Subject& subject) {
  demand_unchanged(subject, "signal handlers or blocked signals", signal_settings);
}

void keeps_locale(const Subject& subject) {
  demand_unchanged(subject, "the locale", [] { return std::string(::setlocale(LC_ALL, nullptr)); });
}

void keeps_float_settings(const Subject& subject) {
  demand_unchanged(subject, "rounding mode or other settings of floating-point arithmetic", float_settings);
}

void keeps_folder(const Subject& subject) {
  demand_unchanged(subject, "the working folder", [] { return std::filesystem::current_path().string(); });
}

void keeps_environment(const Subject& subject) {
  demand_unchanged(subject, "environment variables", environment_now);
}

void keeps_file_mask(const Subject& subject) {
  demand_unchanged(subject, "the file mode mask", file_mask);
}

constexpr Test kMannersTests[] = {
    {"silent", "Nothing is written to standard output or standard error.", is_silent},
    {"descriptors", "Every descriptor that is opened is closed by the end, and no other one.",
     closes_what_it_opens},
    {"threads", "Every thread that is started has ended by the end.", ends_its_threads},
    {"processes", "No process is left that the plugin started.", starts_no_processes, Way::kUnconfined},
    {"keeps-signals", "Signal handlers and blocked signals are left alone.", keeps_signals},
    {"keeps-locale", "The locale is left alone.", keeps_locale},
    {"keeps-rounding", "Rounding mode and treatment of the smallest numbers are left alone.",
     keeps_float_settings},
    {"keeps-folder", "The working folder is left alone.", keeps_folder},
    {"keeps-environment", "Environment variables are left alone.", keeps_environment},
    {"keeps-umask", "The file mode mask is left alone.", keeps_file_mask},
};

}  // namespace

std::span<const Test> manners_tests() {
  return kMannersTests;
}

}  // namespace hallway::conformance
