// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
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

namespace hallway::log {

/// Id under which the sensor itself follows a point from frame to frame.
using TrackId = std::uint64_t;
/// "The sensor does not follow this point."
inline constexpr TrackId kNoTrack = ~TrackId{0};

/// One observed point.
struct Observation {
  LandmarkId landmark =
      kNoLandmark;                ///< the true landmark, for scoring only; kNoLandmark where it is not known
  std::array<double, 3> point{};  ///< sensor frame (x forward, y left, z up), metres
  TrackId track = kNoTrack;       ///< where the sensor follows its points; never a true identity
};

/// The observations of a run.
class ObservationLog : public FrameList<Observation> {
 public:
  /// @param has_identities  whether the observations name their true landmarks
  /// @param has_tracks      whether the sensor follows its points
  explicit ObservationLog(bool has_identities = false, bool has_tracks = false)
      : has_identities_(has_identities), has_tracks_(has_tracks) {}

  bool has_identities() const { return has_identities_; }
  bool has_tracks() const { return has_tracks_; }
  /// All observations, in the order of the frames.
  std::span<const Observation> observations() const { return all(); }

 private:
  bool has_identities_;
  bool has_tracks_;
};

/// What could be read of a log.
struct ReadLog {
  ObservationLog log;
  std::optional<Damage> damage;  ///< empty where the file was read to its end
};

/// Reads observations from CSV: a header with the columns `iteration`, `x`, `y`, `z` and perhaps `landmark_id` and `track` in
/// any order, then rows of non-decreasing iterations (docs/formats.md).
///
/// A bad row ends the reading: the rows before it are kept and the damage is told. Throws Error{kBadInput} with the line if
/// the header is wrong or the first row is already bad. O(length).
///
/// @param text  the file's content
/// @param file  its name, for messages
ReadLog parse_observations(std::string_view text, const std::string& file);

/// parse_observations() of a file. Throws Error{kIo} if it cannot be read.
ReadLog read_observations(const std::filesystem::path& path);

/// "file:line: cause; kept 1200 observations of iterations 0 to 99": for people.
std::string describe(const Damage& damage, const ObservationLog& kept, const std::string& file);

/// The text that parse_observations() reads back to the same log. Throws Error{kInternal} for a number that is not finite.
std::string print_observations(const ObservationLog& log);

/// print_observations() to a file, atomically. Throws Error{kIo}.
void write_observations(const std::filesystem::path& path, const ObservationLog& log);

/// Writes the file of write_observations() frame by frame while a run goes on, in memory that does not grow with it. All functions throw Error{kIo}.
class ObservationFile {
 public:
  /// @param path  a file that is not there yet
  ObservationFile(const std::filesystem::path& path, bool has_identities, bool has_tracks);

  /// The next frame; iterations increase.
  void add_frame(std::uint32_t iteration, std::span<const Observation> observations);
  /// No more frames come.
  void close();

 private:
  bool has_identities_;
  bool has_tracks_;
  RowFile rows_;
  std::optional<std::uint32_t> last_empty_;  ///< the last frame, where it has nothing
};

}  // namespace hallway::log
