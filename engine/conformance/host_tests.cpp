// SPDX-License-Identifier: MIT
// Hosts that offer little.
#include <initializer_list>
#include <string>

#include "conformance/instance.hpp"
#include "conformance/walk.hpp"

namespace hallway::conformance {
namespace {

constexpr std::uint64_t kHostFrames = 4;

std::string answers_with(const LoadedLibrary& library, const Subject& subject, const HostShape& host) {
  Active plugin(library, subject, host);
  return plugin.walk(0, kHostFrames);
}

void needs_no_extensions(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  demand_same(answers_with(library, subject, {.extensions = false}), answers_with(library, subject, {}),
              "without extensions of the host, it answers otherwise");
}

void survives_refusals(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  for (const hw_status_t answer :
       std::initializer_list<hw_status_t>{HW_ERROR_MEMORY, HW_ERROR_DATA, HW_ERROR_ARGUMENT, 4711}) {
    Instance plugin(library, subject, {.answer = answer});
    plugin.activate();
    const Answer processed = plugin.step(0);
    processed.demand_reason();
    if (processed.good()) plugin.report(0).demand_reason();
    plugin.close();
  }
}

constexpr Test kHostTests[] = {
    {"host-no-extensions", "A host without extensions (no log) gets the same answers.", needs_no_extensions},
    {"host-refuses", "When put() fails, the plugin ends the call in good order, and a failure has a reason.",
     survives_refusals},
};

}  // namespace

std::span<const Test> host_tests() {
  return kHostTests;
}

}  // namespace hallway::conformance
