// SPDX-License-Identifier: MIT
#include "icp/core/scan_options.hpp"

namespace hallway::icp {
namespace {

constexpr OptionRow<ScanOptions> kScanParameters[] = {
    {"noise_m", "m", 0.0, 10.0, "Scans: standard deviation of a range; the sensor's where that is known.",
     &ScanOptions::noise_m},
    {"noise_per_m", "1", 0.0, 1.0,
     "Scans: standard deviation of a second part, per metre of distance; the sensor's where that is known.",
     &ScanOptions::noise_per_m},
    {"map_cube_m", "m", 0.1, 100.0,
     "Scans: edge of the largest cubes of the map whose points may be one plane; there are halves and "
     "quarters.",
     &ScanOptions::map_cube_m},
    {"map_range_m", "m", 1.0, 10000.0, "Scans: what is farther from the sensor is forgotten.",
     &ScanOptions::map_range_m},
    {"scan_reach_m", "m", 0.01, 100.0,
     "Scans: farthest match at first; less where predictions have been better.", &ScanOptions::scan_reach_m},
    {"scan_overlap", "1", 0.0, 1.0, "Scans: a pose needs this share of the points on the map.",
     &ScanOptions::scan_overlap},
    {"max_sigma_m", "m", 1e-4, 1000.0,
     "Scans: there is no pose where the motion has a larger standard deviation along some axis, as in a "
     "plain "
     "corridor.",
     &ScanOptions::max_sigma_m},
    {"max_sigma_rad", "rad", 1e-5, 3.15, "Scans: likewise of its rotation.", &ScanOptions::max_sigma_rad},
    {"scan_turn_rad", "rad", 0.0, 3.15,
     "Scans: how far about the sensor's z axis turns are tried when the prediction fails; 0 means none.",
     &ScanOptions::scan_turn_rad},
    {"restart_scans", "scans", 1, 1000000, "Scans without a pose after which a new map is begun.",
     &ScanOptions::restart_scans},
};

}  // namespace

std::span<const OptionRow<ScanOptions>> scan_parameters() {
  return kScanParameters;
}

}  // namespace hallway::icp
