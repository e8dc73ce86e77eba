// SPDX-License-Identifier: MIT
// load_model() with a helper program that does everything wrong.
#include <gtest/gtest.h>

#include "mesh/load.hpp"
#include "support/errors.hpp"

namespace hallway::mesh {
namespace {

/// What comes of a helper that behaves so; empty if it is a model.
std::string outcome(const std::string& how) {
  LoadLimits limits;
  limits.child.wall_time = std::chrono::milliseconds(how == "hang" ? 200 : 20'000);
  limits.child.output_bytes = 1'000'000;
  const auto error = test::error_of(
      [&] { load_model_by(find_helper("hallway-test-odd-loader"), "/tmp/" + how, "/tmp", limits); });
  return error ? error->what() : "";
}

TEST(OddLoader, EveryEndIsAMessage) {
  EXPECT_EQ(outcome("good"), "");
  const std::string unreadable = "the mesh loader gave a reply that cannot be read: ";
  EXPECT_EQ(outcome("garbage"), "/tmp/garbage: " + unreadable + "it does not begin as one");
  EXPECT_EQ(outcome("nothing at all"), "/tmp/nothing at all: " + unreadable + "it does not begin as one");
  EXPECT_EQ(outcome("cut"), "/tmp/cut: " + unreadable + "it is cut short");
  EXPECT_EQ(outcome("twice"), "/tmp/twice: " + unreadable + "it does not end where it should");
  EXPECT_EQ(outcome("hang"), "/tmp/hang: cannot be read: the mesh loader took longer than 0.2 s");
  EXPECT_EQ(outcome("flood"), "/tmp/flood: cannot be read: the mesh loader wrote more than 1000000 bytes");
  EXPECT_EQ(outcome("status"), "/tmp/status: cannot be read: the mesh loader ended with status 9");
  for (const std::string& how : {std::string("crash after half"), std::string("crash after all")}) {
    EXPECT_EQ(
        outcome(how),
        "/tmp/" + how + ": cannot be read: the mesh loader crashed with signal 11 (Segmentation fault)");
  }
}

}  // namespace
}  // namespace hallway::mesh
