// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "log/drawing.hpp"
#include "log/drive_tables.hpp"
#include "log/landmarks.hpp"
#include "log/map_answer.hpp"
#include "log/mcap_writer.hpp"
#include "log/plane_names.hpp"
#include "log/plane_observations.hpp"
#include "log/pose_covariances.hpp"
#include "log/poses.hpp"
#include "log/surface_label.hpp"
#include "log/topology.hpp"
#include "log/true_planes.hpp"

namespace hallway::log {

// What Hallway puts into an MCAP file (docs/formats.md): one channel for what plugins are given, others for what they
// answer and for what is true, which no plugin is ever given.

/// Topics of the channels.
namespace topics {
inline constexpr std::string_view kFrame = "/hallway/frame";                    ///< as given to the plugins
inline constexpr std::string_view kActivation = "/hallway/activation";          ///< facts given once
inline constexpr std::string_view kTruePose = "/hallway/truth/pose";            ///< T_world_body
inline constexpr std::string_view kIdentities = "/hallway/truth/identities";    ///< of the observations
inline constexpr std::string_view kSampleTruth = "/hallway/truth/sample";       ///< of one sample
inline constexpr std::string_view kTrueLandmarks = "/hallway/truth/landmarks";  ///< world
inline constexpr std::string_view kTruePlanes = plane_names::kTruePlanesTopic;  ///< world
inline constexpr std::string_view kLabels = "/hallway/truth/labels";            ///< of the returns of lidars
inline constexpr std::string_view kPose = "/hallway/output/pose";               ///< T_map_body
inline constexpr std::string_view kAssociations = "/hallway/output/associations";
inline constexpr std::string_view kCommand = "/hallway/output/command";    ///< how to drive
inline constexpr std::string_view kPlanes = "/hallway/output/planes";      ///< found in the readings
inline constexpr std::string_view kMap = "/hallway/output/map";            ///< at the end, as re-solved
inline constexpr std::string_view kTopology = "/hallway/output/topology";  ///< the whole of it
inline constexpr std::string_view kDrawing = "/hallway/output/drawing";    ///< what a plugin shows of itself
inline constexpr std::string_view kObeyed = "/hallway/drive/obeyed";       ///< the command from a frame on
inline constexpr std::string_view kContact = "/hallway/drive/contact";     ///< that began
inline constexpr std::string_view kEvent = "/hallway/drive/event";         ///< of the scenario
}  // namespace topics

/// Ids of channels and schemas below this one are the run's own.
inline constexpr std::uint16_t kFirstOtherId = 1000;

/// Whether the messages of a topic are of the whole log and not of a moment.
bool is_of_whole_log(std::string_view topic);

/// Which frame a message belongs to.
struct FrameStamp {
  std::uint32_t iteration = 0;
  std::int64_t t_ns = 0;  ///< not below 0
};

/// A pose that a plugin put.
struct PoseAnswer {
  bool valid = false;  ///< false: the plugin says that it is lost
  std::array<double, 3> position_m{};
  std::array<double, 4> orientation{1.0, 0.0, 0.0, 0.0};  ///< w, x, y, z
  std::optional<PoseCovariance> covariance{};             ///< where it was told
  std::optional<std::uint64_t>
      map_epoch{};        ///< where it was told: which connected part of the map the pose is in
  std::int64_t t_ns = 0;  ///< the time that it is of, above 0; 0: the frame's
};

/// A drive command that a plugin put.
struct CommandAnswer {
  double linear_m_s = 0;
  double angular_rad_s = 0;
  double lateral_m_s = 0;

  bool operator==(const CommandAnswer&) const = default;
};

/// What is true of one sample of a frame, beside the frame's own truth.
struct SampleTruth {
  std::uint32_t sample = 0;  ///< index in the frame
  std::optional<std::array<double, 3>>
      position_m{};  ///< of the body at the sample's time, world, where that is not the frame's
  std::array<double, 4> orientation{1.0, 0.0, 0.0, 0.0};  ///< w, x, y, z
  /// By name, such as `travel_m`; what they are stands in docs/formats.md. Letters a-z, digits and `_`; finite.
  std::map<std::string, std::vector<double>> values{};

  bool operator==(const SampleTruth&) const = default;
};

/// Records a run. The same calls give the same bytes. All functions throw Error{kIo}, and Error{kInternal} for a number that
/// is not finite.
class RunLogWriter {
 public:
  /// Keeps a reference to `output`.
  /// @param library   which program writes
  /// @param manifest  JSON: the facts of the run that are known before its first frame
  RunLogWriter(ByteOutput& output, const std::string& library, const std::string& manifest);

  /// JSON: the period and the sensors.
  void add_activation(const std::string& json);
  void add_true_landmarks(std::span<const Landmark> landmarks);
  void add_true_planes(std::span<const TruePlane> planes);
  void add_labels(std::span<const SurfaceLabel> labels);
  /// A frame in the form of host/samples/frame_bytes.hpp.
  void add_frame(const FrameStamp& stamp, std::string_view bytes);
  void add_true_pose(const FrameStamp& stamp, const IterationPose& pose);
  /// Of one sample of the frame, by its index; so are associations and planes.
  void add_identities(const FrameStamp& stamp, std::uint32_t sample, std::span<const LandmarkId> ids);
  void add_sample_truth(const FrameStamp& stamp, const SampleTruth& truth);
  void add_pose(const FrameStamp& stamp, const PoseAnswer& pose);
  void add_associations(const FrameStamp& stamp, std::uint32_t sample, std::span<const LandmarkId> ids);
  void add_command(const FrameStamp& stamp, const CommandAnswer& command);
  /// The command that the drive obeys from the frame on; its iteration is the stamp's. As the tables' add_row(), these three throw
  /// Error{kInternal} for what could not be read back.
  void add_obeyed(const FrameStamp& stamp, const ObeyedCommand& command);
  /// A contact that began at the frame or before it and after the one before.
  void add_contact(const FrameStamp& stamp, const ContactRow& contact);
  /// An event of the same time.
  void add_event(const FrameStamp& stamp, const EventRow& event);
  /// The planes that were found in it.
  void add_planes(const FrameStamp& stamp, std::uint32_t sample, std::span<const PlaneObservation> planes);
  /// The topological map from then on, whole.
  void add_topology(const FrameStamp& stamp, const Topology& topology);
  /// What a plugin shows at the frame.
  void add_drawing(const FrameStamp& stamp, const Drawing& drawing);
  /// The map at the end, under the stamp of the last frame; its topology is a message of its own, add_topology().
  void add_map(const FrameStamp& stamp, const MapAnswer& map);
  /// Makes sure that what was added survives the end of the program (McapWriter::keep_chunk).
  void keep();
  /// Writes what is left and the index.
  void finish();

  /// The file itself, for channels beside the run's own: their ids and those of their schemas are kFirstOtherId or more.
  McapWriter& file() { return writer_; }

 private:
  void add(std::string_view topic, const FrameStamp& stamp, std::string_view data);

  McapWriter writer_;
  std::set<std::uint16_t> channels_;  ///< those in the log
};

/// A frame as it stands in a log.
struct FrameMessage {
  std::string_view bytes;  ///< host/samples/frame_bytes.hpp
};
struct ActivationMessage {
  std::string json;
};
struct IdentitiesMessage {
  std::uint32_t iteration = 0;
  std::uint32_t sample = 0;  ///< index in the frame
  std::vector<LandmarkId> ids;
};

struct SampleTruthMessage {
  std::uint32_t iteration = 0;
  SampleTruth truth;
};

/// A drive command as a plugin gave it.
struct CommandMessage {
  std::uint32_t iteration = 0;
  CommandAnswer command;
};

/// What replay needs of a log, with the true pose of a frame, the true landmarks and planes of the world, and the labels of its surfaces; std::monostate for all else.
using RunMessage = std::variant<std::monostate, FrameMessage, ActivationMessage, IterationPose,
                                IdentitiesMessage, std::vector<Landmark>, std::vector<TruePlane>,
                                std::vector<SurfaceLabel>, CommandMessage, SampleTruthMessage>;

/// What a message says, by its channel's topic. Throws Error{kBadInput} with the cause if it is not what the topic
/// promises.
RunMessage parse_run_message(const McapChannel& channel, const McapMessage& message);

struct PoseMessage {
  std::uint32_t iteration = 0;
  PoseAnswer pose;
};

struct TopologyMessage {
  std::uint32_t iteration = 0;
  Topology topology;
};

struct DrawingMessage {
  std::uint32_t iteration = 0;
  Drawing drawing;
};

/// What a plugin answered; std::monostate for all else.
using AnswerMessage = std::variant<std::monostate, PoseMessage, MapAnswer, TopologyMessage, DrawingMessage>;

/// What a message says, by its channel's topic. Throws as parse_run_message() does.
AnswerMessage parse_answer_message(const McapChannel& channel, const McapMessage& message);

struct ContactMessage {
  std::uint32_t iteration = 0;  ///< of the frame at its time or the first one after it
  ContactRow contact;
};
struct EventMessage {
  std::uint32_t iteration = 0;  ///< as of a contact
  EventRow event;
};

/// What a drive did and what happened to the robot; std::monostate for all else.
using DriveMessage = std::variant<std::monostate, ObeyedCommand, ContactMessage, EventMessage>;

/// What a message says, by its channel's topic. Throws as parse_run_message() does.
DriveMessage parse_drive_message(const McapChannel& channel, const McapMessage& message);

/// The manifest that RunLogWriter was given, from its metadata record; empty for one of another name.
std::optional<std::string> manifest_of(const McapMetadata& metadata);

}  // namespace hallway::log
