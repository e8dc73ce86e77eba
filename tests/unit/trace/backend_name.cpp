// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "trace/scene.hpp"

namespace hallway::trace {
namespace {

TEST(BackendDescription, NamesVersionAndInstructionSet) {
  const std::string text = backend_description(Backend::kEmbree);
  EXPECT_TRUE(text.starts_with("Embree 3.") || text.starts_with("Embree 4.")) << text;
  EXPECT_NE(text.find(", ISA "), std::string::npos) << text;
  EXPECT_EQ(backend_description(Backend::kBruteForce), "brute force, double precision");
}

}  // namespace
}  // namespace hallway::trace
