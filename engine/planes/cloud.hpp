// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "import/depth_camera.hpp"
#include "import/recording.hpp"
#include "planes/plane.hpp"

namespace hallway::planes {

/// Points read from a file.
struct Cloud {
  std::vector<Vec3> points{};  ///< all finite, in the file's order
  std::vector<std::uint64_t>
      rows{};  ///< for each point its row in the file, from 0; of an image its pixel, row by row
  std::vector<std::int64_t> labels{};  ///< for each point; empty where the file has none
  import::PixelGrid image{};           ///< that the points are pixels of: a depth image, an organised PCD
  std::uint64_t n_rows = 0;            ///< in the file
  std::uint64_t not_finite = 0;        ///< rows left out since a coordinate is none
};

/// The columns of a CSV file that are read.
struct CloudColumns {
  std::string x = "x";
  std::string y = "y";
  std::string z = "z";
  std::string label = "label";  ///< need not be there
};

struct CloudOptions {
  CloudColumns columns{};
  std::int64_t unlabelled =
      kNoLabel;  ///< this label, and every negative one, says that a point belongs to no plane
  std::optional<import::Camera> camera{};                ///< of a depth image, which cannot be read without
  double units_per_metre = import::kDepthUnitsPerMetre;  ///< of a depth image
};

/// The points in a file's content. `name` tells the kind where the content does not, and stands in messages. Throws as read_cloud() does.
Cloud parse_cloud(std::string_view content, const std::filesystem::path& name, const CloudOptions& options);

/// Reads a cloud: PLY and PCD as `hallway log convert` does, CSV with a header, the `v` lines of OBJ, a depth image (PNG, 16 bits grey) with a camera.
/// What the file begins with tells the kind, else the end of its name. Throws Error{kBadInput} with file and line, Error{kIo}; Error{kUsage} for a
/// depth image without a camera.
Cloud read_cloud(const std::filesystem::path& path, const CloudOptions& options);

/// Reads labels: one whole number in each line, for each row of the cloud's file; a first line that is none is passed over.
/// @return for each point of the cloud. Throws as read_cloud() does, also where there are more or fewer lines than rows
std::vector<std::int64_t> read_labels(const std::filesystem::path& path, const Cloud& cloud,
                                      std::int64_t unlabelled);

/// What labels alone tell: for each label the plane that is nearest to its points in the sum of squared distances. No corners, no noise.
Truth truth_of_labels(const Cloud& cloud);

}  // namespace hallway::planes
