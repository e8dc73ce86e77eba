// SPDX-License-Identifier: MIT
// What a plugin may do with the memory of its inputs.
#include <sys/mman.h>

#include <string>
#include <vector>

#include "conformance/instance.hpp"
#include "conformance/walk.hpp"

namespace hallway::conformance {
namespace {

constexpr std::uint64_t kInputFrames = 5;

void does_not_keep_frames(const Subject& subject) {
  Active plugin(subject);
  std::vector<InputMemory> memories(kInputFrames);
  for (std::uint64_t step = 0; step < kInputFrames; ++step) {
    const hw_frame_t& frame = memories[step].put_frame(plugin.ordinary().frame(step));
    plugin.process(frame).demand_good();
    memories[step].protect(PROT_NONE);
  }
  plugin.report(HW_REPORT_REFINE).demand_good();
  plugin.must_reset();
  plugin.close();
}

void does_not_keep_the_activation(const Subject& subject) {
  Active plugin(subject);
  plugin.poison_activation();
  plugin.walk(0, kInputFrames);
  plugin.must_reset();
  plugin.walk(kInputFrames, kInputFrames + 1);
  plugin.close();
}

void does_not_write(const Subject& subject) {
  Active plugin(subject);
  for (std::uint64_t step = 0; step < kInputFrames; ++step) {
    InputMemory memory;
    const hw_frame_t& frame = memory.put_frame(plugin.ordinary().frame(step));
    memory.protect(PROT_READ);
    plugin.process(frame).demand_good();
  }
}

void does_not_read_on(const Subject& subject) {
  Instance plugin(subject);
  const InputShape tight{.tight = true};
  plugin.activate(plugin.ordinary().sensors(), tight).demand_good();
  for (std::uint64_t step = 0; step < kInputFrames; ++step) {
    const Frame frame = step == 1 ? plugin.ordinary().frame(step, 0) : plugin.ordinary().frame(step);
    plugin.process(frame, tight).demand_good();
  }
}

constexpr Test kInputTests[] = {
    {"input-not-kept", "A frame is not looked at after process() has returned.", does_not_keep_frames},
    {"activation-not-kept", "The activation is not looked at after activate() has returned.",
     does_not_keep_the_activation},
    {"input-not-written", "A frame is not written to.", does_not_write},
    {"input-not-overrun", "Nothing is read behind the end of what was given.", does_not_read_on},
};

}  // namespace

std::span<const Test> input_tests() {
  return kInputTests;
}

}  // namespace hallway::conformance
