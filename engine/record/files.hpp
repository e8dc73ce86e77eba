// SPDX-License-Identifier: MIT
#pragma once

#include "log/plane_names.hpp"

/// The names of the files of a run folder.
namespace hallway::record::files {

inline constexpr const char* kRun = "run.json";
inline constexpr const char* kMetrics = "metrics.json";
inline constexpr const char* kScenario = "scenario.toml";
inline constexpr const char* kMap = "map.map";
inline constexpr const char* kRobotFile = "robot.map";
inline constexpr const char* kObservations = "observations.csv";
inline constexpr const char* kObservedPlanes = "observed_planes.csv";
inline constexpr const char* kLog = "run.mcap";
inline constexpr const char* kTruePoses = "truth_poses.csv";
inline constexpr const char* kTrueLandmarks = "truth_landmarks.csv";
inline constexpr const char* kTruePlanes = log::plane_names::kTruePlanesFile;
inline constexpr const char* kTrueTrajectory = "truth.tum";
inline constexpr const char* kTrajectory = "trajectory.tum";
inline constexpr const char* kMapEpochs = "map_epochs.csv";
inline constexpr const char* kPoseCovariances = "pose_covariances.csv";
inline constexpr const char* kPoseTimes = "pose_times.csv";
inline constexpr const char* kCommands = "commands.csv";
inline constexpr const char* kObeyedCommands = "drive.csv";
inline constexpr const char* kContacts = "contacts.csv";
inline constexpr const char* kEvents = "events.csv";
inline constexpr const char* kPlanes = "planes.csv";
inline constexpr const char* kFoundPlanes = "found_planes.csv";
inline constexpr const char* kLandmarks = "landmarks.csv";
inline constexpr const char* kLandmarksPly = "landmarks.ply";
inline constexpr const char* kPoseErrors = "pose_errors.csv";
inline constexpr const char* kMatches = "matches.csv";
inline constexpr const char* kMappedPlanes = "mapped_planes.csv";
inline constexpr const char* kSubmaps = "submaps.csv";
inline constexpr const char* kSubmapPoses = "submap_poses.csv";
inline constexpr const char* kTopology = "topology.json";
inline constexpr const char* kTopologyGraph = "topology.graphml";
inline constexpr const char* kTiming = "timing.csv";

}  // namespace hallway::record::files
