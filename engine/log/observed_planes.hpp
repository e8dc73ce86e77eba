// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "log/frame_list.hpp"
#include "log/frame_rows.hpp"
#include "log/landmark_id.hpp"
#include "log/planes.hpp"

namespace hallway::log {

/// A plane that a sensor gave.
struct ObservedPlane {
  LandmarkId wall = kNoLandmark;  ///< the true wall, for scoring only; kNoLandmark where it is not known
  Plane plane{};
  std::vector<std::array<double, 3>> hull_m{};  ///< like the corners; empty where it is not told
};

/// The planes that a sensor gave in a run.
class ObservedPlaneLog : public FrameList<ObservedPlane> {
 public:
  /// @param has_identities  whether the planes name their true walls
  explicit ObservedPlaneLog(bool has_identities = false) : has_identities_(has_identities) {}
  bool has_identities() const { return has_identities_; }

 private:
  bool has_identities_;
};

/// What could be read of a log.
struct ReadPlaneLog {
  ObservedPlaneLog log;
  std::optional<Damage> damage;  ///< empty where the file was read to its end
};

/// Whether a table is one of planes, by its header.
bool is_of_planes(std::string_view text);

/// Reads observed planes from CSV: a header with `iteration` and the columns of the geometry of planes.csv, and perhaps `wall_id` and `hull`, in
/// any order, then rows of non-decreasing iterations (docs/formats.md). A plane's id is its place in its frame, and it is of no points.
///
/// A bad row ends the reading: the rows before it are kept and the damage is told. Throws Error{kBadInput} with the line if the header
/// is wrong or the first row is already bad. O(length).
///
/// @param text  the file's content
/// @param file  its name, for messages
ReadPlaneLog parse_observed_planes(std::string_view text, const std::string& file);

/// "file:line: cause; kept what stands before: 1200 planes, iterations below 100": for people.
std::string describe(const Damage& damage, const ObservedPlaneLog& kept, const std::string& file);

/// The text that parse_observed_planes() reads back to the same geometry. Throws Error{kInternal} for a number that is not finite.
std::string print_observed_planes(const ObservedPlaneLog& log);

/// print_observed_planes() to a file, atomically. Throws Error{kIo}.
void write_observed_planes(const std::filesystem::path& path, const ObservedPlaneLog& log);

}  // namespace hallway::log
