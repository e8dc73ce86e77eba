// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "log/frame_list.hpp"
#include "log/frame_rows.hpp"
#include "log/landmark_id.hpp"
#include "log/row_file.hpp"
#include "log/row_writer.hpp"

namespace hallway::log {

/// The visible part of a plane in one frame, as a sensor or a plane finder gave it: hallway::PlaneObservation as files have it, without
/// Eigen, which the recorder of a robot does not need. Sensor frame, metres.
struct PlaneObservation {
  std::uint64_t id = 0;
  LandmarkId true_plane = kNoLandmark;  ///< for scoring only; kNoLandmark where it is not known
  std::array<double, 3> normal{};       ///< unit, towards the sensor
  double offset_m = 0.0;                ///< normal . x on the plane
  std::array<double, 3> centroid_m{};
  std::array<std::array<double, 3>, 4> corners_m{};  ///< counter-clockwise seen from where the normal points
  std::vector<std::array<double, 3>> hull_m{};       ///< like the corners; empty where it is not given
  std::vector<std::uint32_t> members{};  ///< elements of the sample; empty where they are not given
  std::uint64_t points = 0;
  double rms_m = 0.0;
  double exclusive_share = 0.0;

  /// The hull, or else the corners.
  std::span<const std::array<double, 3>> outline() const {
    return hull_m.empty() ? std::span<const std::array<double, 3>>(corners_m) : hull_m;
  }
};

/// One row of planes.csv or found_planes.csv, which have no hulls, members and true planes.
struct IterationPlane {
  std::uint32_t iteration = 0;
  PlaneObservation plane;
};

/// The first line of the table.
inline constexpr std::string_view kPlaneColumns =
    "iteration,plane_id,nx,ny,nz,offset_m,cx,cy,cz,x0,y0,z0,x1,y1,z1,x2,y2,z2,x3,y3,z3,points,rms_m,"
    "exclusive_share";

/// Reads planes from CSV: the columns of kPlaneColumns in any order, iterations not decreasing. Throws Error{kBadInput} with
/// the line of the first thing that is wrong, also for a file that is cut off. O(length).
///
/// @param text  the file's content
/// @param file  its name, for messages
std::vector<IterationPlane> parse_planes(std::string_view text, const std::string& file);

/// Adds a row. Throws Error{kInternal} for a number that is not finite.
void add_row(RowWriter& out, const IterationPlane& plane);

/// The planes that a sensor gave in a run.
class PlaneObservationLog : public FrameList<PlaneObservation> {
 public:
  /// @param has_identities  whether the planes name their true planes
  explicit PlaneObservationLog(bool has_identities = false) : has_identities_(has_identities) {}
  bool has_identities() const { return has_identities_; }

 private:
  bool has_identities_;
};

/// What could be read of a log.
struct ReadPlaneObservations {
  PlaneObservationLog log;
  std::optional<Damage> damage;  ///< empty where the file was read to its end
};

/// Whether a table is one of planes, by its header.
bool is_of_planes(std::string_view text);

/// Reads observed planes from CSV: a header with `iteration` and the columns of the geometry of planes.csv, and perhaps `wall_id` and `hull`, in
/// any order, then rows of non-decreasing iterations (docs/formats.md). A plane's id is its place in its frame, and it is of no points.
///
/// A bad row ends the reading: the rows before it are kept and the damage is reported. Throws Error{kBadInput} with the line if the header
/// is wrong or the first row is already bad. O(length).
///
/// @param text  the file's content
/// @param file  its name, for messages
ReadPlaneObservations parse_observed_planes(std::string_view text, const std::string& file);

/// "file:line: cause; kept what stands before: 1200 planes, iterations below 100": for people.
std::string describe(const Damage& damage, const PlaneObservationLog& kept, const std::string& file);

/// The text that parse_observed_planes() reads back to the same geometry. Throws Error{kInternal} for a number that is not finite.
std::string print_observed_planes(const PlaneObservationLog& log);

/// print_observed_planes() to a file, atomically. Throws Error{kIo}.
void write_observed_planes(const std::filesystem::path& path, const PlaneObservationLog& log);

/// Writes the file of write_observed_planes() frame by frame while a run goes on, in memory that does not grow with it. The column of hulls comes with the
/// first hull: where that is not in the first frame with planes, the file is written anew. All functions throw Error{kIo}.
class ObservedPlaneFile {
 public:
  /// @param path  a file that is not there yet
  ObservedPlaneFile(std::filesystem::path path, bool has_identities);

  /// The next frame; iterations increase.
  void add_frame(std::uint32_t iteration, std::span<const PlaneObservation> planes);
  /// No more frames come.
  void close();

 private:
  void begin_rows();
  void add_hull_column();

  std::filesystem::path path_;
  bool has_identities_;
  bool has_hulls_ = false;
  std::optional<RowFile> rows_;              ///< from the first plane on
  std::optional<std::uint32_t> last_empty_;  ///< the last frame, where it has nothing
};

}  // namespace hallway::log
