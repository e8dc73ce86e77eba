// SPDX-License-Identifier: MIT
// What samples of single kinds may hold: a sensor that sees nothing, lacks an axis or knows no covariance is no reason to fail.
#include <hallway/hallway.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "conformance/instance.hpp"
#include "conformance/walk.hpp"
#include "host/samples/payload.hpp"
#include "host/samples/sample_kind.hpp"

namespace hallway::conformance {
namespace {

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();
constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr std::uint64_t kSampleFrames = 6;

/// Frames of the walk in which `change` changes the payload of each sample of a kind.
/// @tparam Struct  of the payload
template <typename Struct, typename Change>
void walk_with(const Subject& subject, const host::SampleKind& kind, Change change) {
  Active plugin(subject);
  plugin.step(0).demand_valid();
  for (std::uint64_t step = 1; step < kSampleFrames; ++step) {
    Frame frame = plugin.ordinary().frame(step);
    Reading& reading = reading_of(frame, kind);
    const auto payload = std::make_shared<host::Payload>();
    payload->assign(kind, reading.payload->get());
    payload->own_all_arrays();
    change(*payload, *static_cast<Struct*>(static_cast<void*>(payload->get())));
    reading.payload = payload;
    plugin.process(frame).demand_valid();
  }
  plugin.report(0).demand_valid();
}

hw_ray_t* rays_of(const hw_range_scan_t& scan) {
  return static_cast<hw_ray_t*>(const_cast<void*>(scan.rays));
}

void takes_scans_without_returns(const Subject& subject) {
  for (const double range : {kEndless, kNotMeasured}) {
    walk_with<hw_range_scan_t>(subject, host::kRangeScanSamples, [&](host::Payload&, hw_range_scan_t& scan) {
      for (std::uint64_t i = 0; i < scan.count; ++i) rays_of(scan)[i].range_m = range;
    });
  }
}

void takes_scans_in_no_order(const Subject& subject) {
  walk_with<hw_range_scan_t>(subject, host::kRangeScanSamples, [](host::Payload&, hw_range_scan_t& scan) {
    scan.width = scan.height = 0;
    std::reverse(rays_of(scan), rays_of(scan) + scan.count);
  });
}

/// Of each ray a second return, a metre behind the first one, and of every third ray none.
void takes_scans_of_layers(const Subject& subject) {
  walk_with<hw_range_scan_t>(
      subject, host::kRangeScanSamples, [](host::Payload& payload, hw_range_scan_t& scan) {
        std::vector<hw_ray_t> rays(rays_of(scan), rays_of(scan) + scan.count);
        for (std::size_t i = 0; i < scan.count; ++i) {
          rays.push_back(rays[i]);
          rays.back().range_m = i % 3 == 0 ? kNotMeasured : rays[i].range_m + 1.0;
        }
        scan.t_offset_ns = nullptr;
        scan.intensity = nullptr;
        scan.ring = nullptr;
        scan.layers = 2;
        std::ranges::copy(rays,
                          static_cast<hw_ray_t*>(static_cast<void*>(payload.make_array(0, rays.size()))));
      });
}

void takes_imus_that_lack_axes(const Subject& subject) {
  walk_with<hw_imu_t>(subject, host::kImuSamples, [](host::Payload&, hw_imu_t& imu) {
    imu.angular_rad_s[0] = imu.angular_rad_s[1] = kNotMeasured;
    std::ranges::fill(imu.force_m_s2, kNotMeasured);
    std::ranges::fill(imu.angular_covariance, kNotMeasured);
    std::ranges::fill(imu.force_covariance, kNotMeasured);
  });
}

void takes_odometry_of_which_little_is_known(const Subject& subject) {
  for (const bool unmeasured : {false, true}) {
    walk_with<hw_odometry_t>(subject, host::kOdometrySamples, [&](host::Payload&, hw_odometry_t& odometry) {
      std::ranges::fill(odometry.linear_m_s, kNotMeasured);
      std::ranges::fill(odometry.angular_rad_s, kNotMeasured);
      std::ranges::fill(odometry.covariance, unmeasured ? 0.0 : kNotMeasured);
      if (unmeasured) odometry.covariance[20] = kEndless;  // the turn about z
    });
  }
}

void takes_no_fix(const Subject& subject) {
  walk_with<hw_gnss_t>(subject, host::kGnssSamples, [](host::Payload&, hw_gnss_t& gnss) {
    gnss.fix = HW_GNSS_NO_FIX;
    std::ranges::fill(gnss.position_m, kNotMeasured);
    std::ranges::fill(gnss.covariance, kNotMeasured);
  });
}

void takes_fixes_of_an_unknown_kind(const Subject& subject) {
  constexpr std::uint32_t kLater = 77;
  walk_with<hw_gnss_t>(subject, host::kGnssSamples, [](host::Payload&, hw_gnss_t& gnss) {
    gnss.fix = kLater;
    for (double& coordinate : gnss.position_m) coordinate = std::isnan(coordinate) ? 0.0 : coordinate;
  });
}

void takes_no_heading(const Subject& subject) {
  walk_with<hw_magnetic_t>(subject, host::kMagneticSamples, [](host::Payload&, hw_magnetic_t& magnetic) {
    magnetic.heading_rad = magnetic.variance_rad2 = kNotMeasured;
  });
}

/// A host that has dropped frames gives their samples with the next one.
void takes_carried_samples(const Subject& subject) {
  constexpr std::uint64_t kDropped = 50;
  const auto is_carried = [](const Reading& reading) {
    const host::SampleKind* kind = host::find_sample_kind(reading.kind);
    return kind != nullptr && kind->carried;
  };
  Active plugin(subject);
  plugin.step(0).demand_valid();
  Frame frame = plugin.ordinary().frame(kDropped);
  if (std::ranges::none_of(frame.readings, is_carried))
    throw Skipped("the plugin takes no kind of sample of which none may be missed");
  std::vector<Reading> all;
  for (std::uint64_t step = 1; step < kDropped; ++step) {
    const Frame dropped = plugin.ordinary().frame(step);
    for (const Reading& reading : dropped.readings) {
      if (!is_carried(reading)) continue;
      all.push_back(reading);
      all.back().age_ns = frame.t_ns - dropped.t_ns;
    }
  }
  all.insert(all.end(), frame.readings.begin(), frame.readings.end());
  std::ranges::stable_sort(all, {}, &Reading::sensor);
  frame.readings = all;
  plugin.process(frame).demand_valid();
  plugin.step(kDropped + 1).demand_valid();
  plugin.report(0).demand_valid();
}

constexpr Test kSampleTests[] = {
    {"scan-no-returns", "A scan of which no ray has a return is a valid one.", takes_scans_without_returns},
    {"scan-no-order", "Rays of a scan need not be in rows and columns.", takes_scans_in_no_order},
    {"scan-layers", "Rays of a scan may have several returns.", takes_scans_of_layers},
    {"imu-missing-axes", "An IMU may lack axes, and covariances.", takes_imus_that_lack_axes},
    {"odometry-unknown", "Odometry may come without velocities and without a covariance.",
     takes_odometry_of_which_little_is_known},
    {"gnss-no-fix", "A receiver of satellites may know nothing.", takes_no_fix},
    {"gnss-later-fix", "A fix may be of a kind that a later version brings.", takes_fixes_of_an_unknown_kind},
    {"magnetic-unknown", "A compass may not know where it points.", takes_no_heading},
    {"carried-samples",
     "Samples of which none may be missed come with the next frame where a host has dropped one: several of "
     "one sensor are answered.",
     takes_carried_samples},
};

}  // namespace

std::span<const Test> sample_tests() {
  return kSampleTests;
}

}  // namespace hallway::conformance
