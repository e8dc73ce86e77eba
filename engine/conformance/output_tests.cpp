// SPDX-License-Identifier: MIT
// What process() puts.
#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "conformance/instance.hpp"
#include "conformance/walk.hpp"
#include "host/load/plugin_info.hpp"
#include "host/output/output_kind.hpp"

namespace hallway::conformance {
namespace {

/// More than any other test feeds, so that what comes late is seen.
constexpr std::uint64_t kLongWalk = 25;

/// The long walk; `check` looks at each answer.
template <typename Check>
void check_walk(const Subject& subject, Check&& check) {
  const LoadedLibrary library(subject.file);
  Active plugin(library, subject);
  for (std::uint64_t step = 0; step < kLongWalk; ++step) {
    check(library, plugin.step(step));
  }
  check(library, plugin.report(0));
  check(library, plugin.report(HW_REPORT_REFINE));
}

void puts_valid_outputs(const Subject& subject) {
  check_walk(subject, [](const LoadedLibrary&, const Answer& answer) {
    if (answer.call == "process") answer.demand_valid();
  });
}

void puts_what_it_declares(const Subject& subject) {
  check_walk(subject, [&](const LoadedLibrary& library, const Answer& answer) {
    const std::vector<std::uint32_t> declared = outputs_of(library.info(subject.plugin));
    for (const std::uint32_t kind : answer.put.kinds) {
      demand(std::ranges::find(declared, kind) != declared.end(),
             answer.call + "() put " + host::output_kind_name(kind) +
                 ", which is not among the plugin's outputs");
    }
  });
}

void writes_zeros(const Subject& subject) {
  check_walk(subject, [](const LoadedLibrary&, const Answer& answer) {
    demand(!answer.put.reserved_written,
           answer.call + "() put an output whose flags or reserved member are not 0");
  });
}

void numbers_parts(const Subject& subject) {
  check_walk(subject, [](const LoadedLibrary&, const Answer& answer) {
    demand(answer.put.epoch_problem.empty(), answer.call + "(): " + answer.put.epoch_problem);
  });
}

void keeps_places(const Subject& subject) {
  std::map<std::uint32_t, std::int64_t> known;
  check_walk(subject, [&](const LoadedLibrary&, const Answer& answer) {
    for (const auto& [id, t_ns] : answer.put.places) {
      const auto before = known.emplace(id, t_ns).first;
      demand(before->second == t_ns,
             answer.call + "() put the place " + std::to_string(id) + " with another time than before");
    }
  });
}

void puts_in_turn(const Subject& subject) {
  Active plugin(subject);
  plugin.walk(0, 3);
  plugin.must_reset();
  plugin.walk(3, 5);
  plugin.deactivate();
  plugin.close();
  demand(plugin.host().out_of_turn() == 0, "it called put() outside of process() and report()");
}

constexpr Test kOutputTests[] = {
    {"outputs-valid",
     "What process() puts is as output.h, planes.h, topology.h and drawing.h say: finite, unit quaternions "
     "and normals, distinct ids, edges between nodes, counts that match.",
     puts_valid_outputs},
    {"outputs-declared", "Only outputs are put whose kinds the plugin declares.", puts_what_it_declares},
    {"outputs-reserved", "Flags and reserved members of what is put are 0.", writes_zeros},
    {"outputs-map-epoch",
     "Parts of the map are numbered by whole numbers, once in a call, and joined to older ones.",
     numbers_parts},
    {"outputs-topology", "A place of a topology keeps its id, and the time at which it was met first.",
     keeps_places},
    {"outputs-in-turn", "Outputs are put during process() and report(), and at no other time.", puts_in_turn},
};

}  // namespace

std::span<const Test> output_tests() {
  return kOutputTests;
}

}  // namespace hallway::conformance
