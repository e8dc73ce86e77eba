// SPDX-License-Identifier: MIT
//
// Point clouds in every form: whatever the bytes are, they are refused with an Error or are finite points with rows that ascend. The first byte chooses the
// name's end, for forms that do not tell themselves.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "planes/cloud.hpp"

namespace {

constexpr const char* kNames[] = {"a.csv", "a.obj", "a.ply", "a.pcd", "a.png"};

void demand(bool condition) {
  if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hallway;
  if (size == 0) return 0;
  const std::string bytes(data + 1, data + size);
  try {
    const planes::Cloud cloud = planes::parse_cloud(bytes, kNames[data[0] % std::size(kNames)],
                                                    {.camera = import::Camera{}, .units_per_metre = 1000.0});
    demand(cloud.rows.size() == cloud.points.size());
    demand(cloud.labels.empty() || cloud.labels.size() == cloud.points.size());
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
      demand(cloud.points[i].allFinite());
      demand(i == 0 || cloud.rows[i] > cloud.rows[i - 1]);
    }
    if (!cloud.labels.empty()) demand(planes::truth_of_labels(cloud).planes.size() <= cloud.points.size());
  } catch (const Error& error) {
    demand(error.code() == ErrorCode::kBadInput && !error.where().file.empty());
  }
  return 0;
}
