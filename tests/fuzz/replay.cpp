// SPDX-License-Identifier: MIT
// replay TARGET FOLDER…: runs a fuzz target on every file of the folders: its committed corpus as an ordinary test. A target tells of a bug as it does
// under libFuzzer, by abort().
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

// HALLWAY_FUZZ_TARGETS: TARGET(a) TARGET(b) …, from the build.
#define TARGET(name) extern "C" int fuzz_##name(const std::uint8_t* data, std::size_t size);
HALLWAY_FUZZ_TARGETS
#undef TARGET

namespace {

namespace fs = std::filesystem;

struct Target {
  std::string_view name;
  int (*run)(const std::uint8_t* data, std::size_t size);
};

#define TARGET(name) {#name, fuzz_##name},
constexpr Target kTargets[] = {HALLWAY_FUZZ_TARGETS};
#undef TARGET

const Target* target_named(std::string_view name) {
  const auto found = std::find_if(std::begin(kTargets), std::end(kTargets),
                                  [&](const Target& target) { return target.name == name; });
  return found == std::end(kTargets) ? nullptr : found;
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

void replay(const Target& target, const fs::path& file) {
  std::printf("%s\n", file.c_str());
  std::fflush(stdout);  // the last name printed is the one at fault
  std::ifstream in(file, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
  const std::vector<std::uint8_t> data(bytes.begin(),
                                       bytes.end());  // its own size, so that sanitizers see overruns
  target.run(data.data(), data.size());
}

}  // namespace

int main(int argc, char** argv) {
  const Target* target = argc < 2 ? nullptr : target_named(argv[1]);
  if (target == nullptr) {
    std::fprintf(stderr, "replay: the first argument is no target's name\n");
    return 2;
  }
  std::size_t count = 0;
  try {
    for (int i = 2; i < argc; ++i) {
      for (const fs::path& file : files_in(argv[i])) {
        replay(*target, file);
        ++count;
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "replay: %s\n", error.what());
    return 1;
  }
  std::printf("%zu files\n", count);
  return count > 0 ? 0 : 1;
}
