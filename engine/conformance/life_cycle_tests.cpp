// SPDX-License-Identifier: MIT
// Calls in every order that the ABI allows.
#include <string>
#include <vector>

#include "base/helper.hpp"
#include "conformance/instance.hpp"
#include "conformance/surroundings.hpp"
#include "conformance/walk.hpp"

namespace hallway::conformance {
namespace {

constexpr std::uint64_t kLifeCycleFrames = 6;
constexpr int kLoads = 40;
constexpr int kWarmUp = 200;
constexpr int kCreations = 1000;
constexpr std::size_t kHeapSlack = 2048;  // what a thousand objects of one byte would exceed
constexpr std::size_t kResidentSlack = std::size_t{8} << 20;  // for memory that is not of malloc()

/// Throws Failed where memory has grown since `heap` and `resident`.
void demand_flat(std::size_t heap, std::size_t resident, const std::string& what) {
  if (reserves_addresses()) throw Skipped("under a sanitizer memory cannot be counted");
  const std::size_t heap_now = heap_bytes();
  const std::size_t resident_now = resident_bytes();
  demand(heap_now <= heap + kHeapSlack,
         what + " has left " + std::to_string(heap_now - heap) + " bytes of memory behind");
  demand(resident_now <= resident + kResidentSlack,
         what + " has left " + std::to_string(resident_now - resident) + " bytes of resident memory behind");
}

void is_destroyed_at_once(const Subject& subject) {
  Instance(subject.plain()).close();
}

void is_deactivated_at_once(const Subject& subject) {
  Active plugin(subject);
  plugin.deactivate();
  plugin.close();
}

/// Two instances, one of which was active before with other frames, get the same frames from then on.
void deactivation_forgets(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  Instance used(library, subject);
  for (std::uint64_t round = 0; round < 2; ++round) {
    used.activate();
    used.walk(round * kLifeCycleFrames, (round + 1) * kLifeCycleFrames);
    used.deactivate();
  }
  used.activate();
  Active fresh(library, subject);
  demand_same(used.walk(2 * kLifeCycleFrames, 3 * kLifeCycleFrames),
              fresh.walk(2 * kLifeCycleFrames, 3 * kLifeCycleFrames),
              "a plugin that was active before answers otherwise than a new one");
}

void is_reset_at_once(const Subject& subject) {
  Active plugin(subject);
  plugin.must_reset();
  plugin.must_reset();
  plugin.walk(0, 1);
}

void reset_forgets(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  Active used(library, subject);
  used.walk(0, kLifeCycleFrames);
  used.must_reset();
  Active fresh(library, subject);
  demand_same(used.walk(kLifeCycleFrames, 3 * kLifeCycleFrames),
              fresh.walk(kLifeCycleFrames, 3 * kLifeCycleFrames),
              "a plugin that was reset answers otherwise than a newly activated one");
}

/// Bytes of a walk of one instance with nothing beside it.
std::string alone(const LoadedLibrary& library, const Subject& subject) {
  Active plugin(library, subject);
  return plugin.walk(0, kLifeCycleFrames);
}

void instances_are_independent(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  Subject other = subject;
  other.seed = subject.seed + 1;
  const std::string expected = alone(library, subject);
  Instance first(library, subject);
  Instance second(library, other);
  first.activate();
  second.activate();
  std::string bytes;
  for (std::uint64_t step = 0; step < kLifeCycleFrames; ++step) {
    bytes += first.step(step).bytes();
    second.step(2 * step).demand_good();
  }
  second.close();
  demand_same(bytes + first.report(0).bytes(), expected,
              "a plugin answers otherwise while another one of its kind is fed beside it");
}

void need_refusal(Instance& plugin) {
  if (plugin.activate({}).good()) throw Skipped("the plugin refuses no sensors that this suite knows");
}

void survives_a_refusal(const Subject& subject) {
  Instance plugin(subject);
  need_refusal(plugin);
  plugin.close();
}

void can_be_activated_after_a_refusal(const Subject& subject) {
  Instance plugin(subject);
  need_refusal(plugin);
  plugin.activate();
  plugin.walk(0, 2);
}

void creation_leaves_nothing(const Subject& subject) {
  const LoadedLibrary library(subject.file);
  std::size_t heap = 0;
  std::size_t resident = 0;
  for (int i = 0; i < kCreations; ++i) {
    if (i == kWarmUp) heap = heap_bytes(), resident = resident_bytes();
    Instance plugin(library, subject);
    plugin.parameters();
    plugin.close();
  }
  demand_flat(heap, resident,
              "creating and destroying it " + std::to_string(kCreations - kWarmUp) + " times");
}

void use_leaves_nothing(const Subject& subject) {
  // malloc() counts what a thread keeps for later as used; what it keeps settles within some hundred rounds.
  constexpr int kWarmUpRounds = 200;
  constexpr int kRounds = 320;
  const LoadedLibrary library(subject.file);
  std::vector<Frame> frames;
  std::size_t heap = 0;
  std::size_t resident = 0;
  for (int i = 0; i < kRounds; ++i) {
    if (i == kWarmUpRounds) heap = heap_bytes(), resident = resident_bytes();
    Instance plugin(library, subject);
    if (frames.empty()) {
      const Walk ordinary = plugin.ordinary();
      frames = {ordinary.frame(0), ordinary.frame(1)};
    }
    plugin.activate();
    for (const Frame& frame : frames) plugin.process(frame).demand_good();
    plugin.report(HW_REPORT_REFINE).demand_good();
    plugin.must_reset();
    for (const Frame& frame : frames) plugin.process(frame).demand_good();
    plugin.close();
  }
  demand_flat(heap, resident, "using it " + std::to_string(kRounds - kWarmUpRounds) + " times");
}

void loads_again_and_again(const Subject& subject) {
  for (int i = 0; i < kLoads; ++i) {
    try {
      LoadedLibrary library(subject.file);
      Instance plugin(library, subject);
      plugin.activate();
      plugin.step(0).demand_good();
      plugin.close();
      library.unload();
    } catch (const NotLoadable& problem) {
      throw Failed("when it was loaded for time " + std::to_string(i + 1) + ": " + problem.what());
    }
  }
}

constexpr Test kLifeCycleTests[] = {
    {"create-destroy", "A plugin can be destroyed without having been activated or asked anything.",
     is_destroyed_at_once},
    {"activate-deactivate", "A plugin can be deactivated and destroyed without having been given a frame.",
     is_deactivated_at_once},
    {"deactivate-forgets",
     "deactivate() forgets the map: activated again, a plugin answers as a new one, to the last bit.",
     deactivation_forgets},
    {"reset-at-once", "reset() succeeds right after activate(), and again.", is_reset_at_once},
    {"reset-forgets", "reset() forgets the map: what follows is as after activate(), to the last bit.",
     reset_forgets},
    {"instances-independent", "Two instances that are fed in turn give what each gives alone.",
     instances_are_independent},
    {"refused-destroy", "A plugin can be destroyed after activate() has failed.", survives_a_refusal},
    {"refused-activate",
     "After activate() has failed a plugin is inactive, and can be activated with what it needs.",
     can_be_activated_after_a_refusal},
    {"create-memory", "A thousand plugins that are created and destroyed leave no memory behind.",
     creation_leaves_nothing},
    {"use-memory", "Plugins that are activated, fed, asked, reset and destroyed leave no memory behind.",
     use_leaves_nothing},
    {"load-again", "The library can be unloaded and loaded again, many times.", loads_again_and_again},
};

}  // namespace

std::span<const Test> life_cycle_tests() {
  return kLifeCycleTests;
}

}  // namespace hallway::conformance
