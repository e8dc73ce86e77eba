// SPDX-License-Identifier: MIT
#include "host/load/library.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <iterator>

#include "base/helper.hpp"
#include "fixtures.hpp"
#include "host/isolate/process_use.hpp"

namespace hallway::host {
namespace {

bool is_loaded(const std::string& file) {
  void* handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_NOLOAD);
  if (handle) ::dlclose(handle);
  return handle != nullptr;
}

const std::string kMinimal = std::string(FIXTURES) + "/minimal.so";

TEST(Library, IsUnloadedWithItsLastUser) {
  auto first = Library::load(kMinimal);
  auto second = Library::load(kMinimal);
  first.reset();
  EXPECT_TRUE(is_loaded(kMinimal));
  second.reset();
  EXPECT_FALSE(is_loaded(kMinimal));
}

std::size_t open_descriptors() {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator("/proc/self/fd"),
                                                std::filesystem::directory_iterator{}));
}

TEST(Library, LoadsAgainAndAgainWithoutGrowth) {
  const std::size_t descriptors = open_descriptors();
  std::uint64_t memory = 0;
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(Library::load(kMinimal)->plugins().size(), 1u);
    EXPECT_NE(Library::load(EXAMPLE)->find("example_c"), nullptr);
    if (i == 100) memory = read_process_use(::getpid())->memory_bytes;
  }
  EXPECT_EQ(open_descriptors(), descriptors);
  if (!reserves_addresses()) {  // a sanitizer keeps what was freed
    EXPECT_LT(read_process_use(::getpid())->memory_bytes, memory + (std::uint64_t{2} << 20));
  }
}

TEST(Library, TwoLibrariesInTurn) {
  EXPECT_NE(Library::load(kMinimal)->find("minimal"), nullptr);
  EXPECT_NE(Library::load(EXAMPLE)->find("example_c"), nullptr);
  EXPECT_NE(Library::load(kMinimal)->find("minimal"), nullptr);
}

TEST(Library, TellsItsAbiVersion) {
  EXPECT_EQ(Library::load(kMinimal)->abi().abi_major, HW_ABI_MAJOR);
}

TEST(Library, FindsNothingUnderAnUnknownId) {
  EXPECT_EQ(Library::load(kMinimal)->find("maximal"), nullptr);
}

TEST(Library, IsLoadedFromARelativePath) {
  const std::filesystem::path relative = std::filesystem::relative(kMinimal);
  EXPECT_EQ(Library::load(relative)->file(), relative);
}

}  // namespace
}  // namespace hallway::host
