// SPDX-License-Identifier: MIT
#include <algorithm>

#include "conformance/test.hpp"

namespace hallway::conformance {

const std::vector<Test>& all_tests() {
  static const std::vector<Test> kAll = [] {
    std::vector<Test> all;
    for (const std::span<const Test> group :
         {entry_tests(), life_cycle_tests(), parameter_tests(), parameter_2_tests(), activation_tests(),
          robot_tests(), frame_tests(), sample_tests(), input_tests(), growth_tests(), output_tests(),
          report_tests(), result_tests(), error_tests(), host_tests(), manners_tests()}) {
      all.insert(all.end(), group.begin(), group.end());
    }
    return all;
  }();
  return kAll;
}

const Test* find_test(std::string_view name) {
  const auto found = std::ranges::find_if(all_tests(), [&](const Test& test) { return test.name == name; });
  return found == all_tests().end() ? nullptr : &*found;
}

}  // namespace hallway::conformance
