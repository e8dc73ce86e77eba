// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "render/picture.hpp"
#include "run/pictures/scans.hpp"

namespace hallway::run {

/// The hits of scans as dots, coloured by height or, where all scans are flat, by intensity; of flat scans also the beams, fainter where nothing was
/// in range.
/// @param reach_m  beams without a return are drawn no longer
void add_scans(render::Picture& picture, const Scans& scans, ScanPlacement placement, double reach_m);

/// The azimuths between which a scan looks, in its sensor's frame.
struct Sector {
  double from_rad = 0.0;
  double width_rad =
      0.0;  ///< counter-clockwise from there; a full turn where no gap is wider than the others
};

/// The sector of a scan; empty where it has no rays.
std::optional<Sector> sector_of(const RecordedScan& scan);

/// What the scans' sensors look at, level with each: the sector, no longer than `reach_m`. Nothing of a sensor that sees all around and farther than that.
void add_sectors(render::Picture& picture, const Scans& scans, double reach_m);

}  // namespace hallway::run
