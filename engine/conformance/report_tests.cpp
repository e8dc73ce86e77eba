// SPDX-License-Identifier: MIT
// The whole map, when it is asked for.
#include <string>

#include "conformance/instance.hpp"
#include "conformance/walk.hpp"

namespace hallway::conformance {
namespace {

constexpr std::uint64_t kReportFrames = 12;

struct Walked : Active {
  explicit Walked(const Subject& subject, std::uint64_t frames) : Active(subject) {
    for (std::uint64_t k = 0; k < frames; ++k) step(k).demand_good();
  }
};

void reports_a_valid_map(const Subject& subject) {
  Walked(subject, kReportFrames).report(0).demand_valid();
}

void reports_a_valid_refined_map(const Subject& subject) {
  Walked(subject, kReportFrames).report(HW_REPORT_REFINE).demand_valid();
}

void reports_before_frames(const Subject& subject) {
  Walked walked(subject, 0);
  walked.report(0).demand_valid();
  walked.report(HW_REPORT_REFINE).demand_valid();
  walked.walk(0, 2);
}

void reports_the_same_twice(const Subject& subject) {
  for (const std::uint32_t flags : {0u, HW_REPORT_REFINE}) {
    Walked walked(subject, kReportFrames);
    const Answer first = walked.report(flags);
    const Answer second = walked.report(flags);
    demand_same(second.bytes(), first.bytes(),
                "the second of two reports without a frame between is another one");
  }
}

/// What process() puts for some frames, with reports in between or without.
std::string answers(const Subject& subject, bool reports) {
  Walked walked(subject, 0);
  std::string bytes;
  for (std::uint64_t step = 0; step < kReportFrames; ++step) {
    bytes += walked.step(step).bytes();
    if (reports) walked.report(step % 2 == 0 ? HW_REPORT_REFINE : 0).demand_good();
  }
  return bytes;
}

void reporting_changes_nothing(const Subject& subject) {
  demand_same(answers(subject, true), answers(subject, false),
              "frames are answered otherwise after report()");
}

constexpr Test kReportTests[] = {
    {"report-valid",
     "The map that report() puts is as output.h, mapped_planes.h and topology.h say, without associations, "
     "planes and drawings.",
     reports_a_valid_map},
    {"report-refined", "report() with HW_REPORT_REFINE succeeds, and puts a map that is as output.h says.",
     reports_a_valid_refined_map},
    {"report-first", "report() succeeds before there was a frame.", reports_before_frames},
    {"report-twice", "Two reports without a frame between are the same, to the last bit.",
     reports_the_same_twice},
    {"report-aside", "Frames are answered the same whether or not reports are asked for in between.",
     reporting_changes_nothing},
};

}  // namespace

std::span<const Test> report_tests() {
  return kReportTests;
}

}  // namespace hallway::conformance
