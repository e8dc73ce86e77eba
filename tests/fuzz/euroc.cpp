// SPDX-License-Identifier: MIT
//
// The files of the ASL layout (EuRoC). Whatever the bytes are, they are refused with an Error that names their file, or what was read is sound. The first
// byte chooses which file the rest is.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/error.hpp"
#include "import/euroc.hpp"
#include "import/timed_poses.hpp"

namespace {

using namespace hallway;

enum What : std::uint8_t { kSensor, kImu, kTruth, kCount };

void demand(bool condition) {
  if (!condition) std::abort();
}

void check_sensor(const std::string& text) {
  import::EurocImuSensor sensor = import::parse_euroc_sensor(text, "file");
  demand(import::is_sound(sensor.T_body_imu));
  // A comment is written in quotes, which may not be in it.
  sensor.comment.clear();
  const import::EurocImuSensor again =
      import::parse_euroc_sensor(import::print_euroc_sensor(sensor), "again");
  demand(std::isnan(sensor.rate_hz) ? std::isnan(again.rate_hz) : again.rate_hz == sensor.rate_hz);
  demand((again.T_body_imu.t - sensor.T_body_imu.t).norm() == 0.0);
}

void check(What what, const std::string& text) {
  if (what == kSensor) return check_sensor(text);
  std::int64_t last_ns = -1;
  if (what == kImu) {
    for (const import::ImuSample& sample : import::parse_euroc_imu(text, "file")) {
      import::check_sample(sample, last_ns, "sample");
      last_ns = sample.t_ns;
    }
    return;
  }
  for (const import::EurocState& state : import::parse_euroc_truth(text, "file")) {
    demand(state.t_ns > last_ns && import::is_sound(state.T_world_body));
    last_ns = state.t_ns;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  try {
    check(static_cast<What>(data[0] % kCount), std::string(data + 1, data + size));
  } catch (const Error& error) {
    demand(error.code() == ErrorCode::kBadInput && error.where().file == "file");
  }
  return 0;
}
