// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "drawing.h"
#include "growth.h"
#include "mapped_planes.h"
#include "planes.h"
#include "pose.h"
#include "topology.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Kinds of outputs, and what hw_output_t.payload points to. Numbers without a payload type are reserved. A
/// host skips kinds that it does not know.
enum {
  HW_OUTPUT_POSE = 1,           ///< hw_pose_output_t; at most one in a call
  HW_OUTPUT_LANDMARKS = 2,      ///< hw_landmarks_t; several in a call are one list
  HW_OUTPUT_ASSOCIATIONS = 3,   ///< hw_associations_t; at most one for a sample, in process() only
  HW_OUTPUT_SUBMAPS = 4,        ///< hw_submaps_t; several in a call are one list
  HW_OUTPUT_COUNTERS = 5,       ///< hw_counters_t; several in a call are one list
  HW_OUTPUT_PLANES = 6,         ///< hw_planes_t; at most one for a sample, in process() only; since 1.1
  HW_OUTPUT_SEGMENTS = 7,       ///< reserved
  HW_OUTPUT_TOPOLOGY = 8,       ///< hw_topology_t; at most one in a call; since 1.6
  HW_OUTPUT_DRIVE_COMMAND = 9,  ///< hw_drive_command_t; at most one in a call, in process() only
  HW_OUTPUT_DRAWING = 10,       ///< hw_drawing_t; at most one in a call, in process() only; since 1.6
  HW_OUTPUT_MAPPED_PLANES = 11  ///< hw_mapped_planes_t; several in a call are one list; since 1.3
};

/// One answer of a plugin, handed to hw_host_vtable_t.put(). The host copies it before put() returns.
typedef struct hw_output_t {
  uint32_t size;        ///< sizeof(hw_output_t) of the writer
  uint32_t kind;        ///< HW_OUTPUT_…
  uint32_t flags;       ///< 0
  uint32_t reserved;    ///< 0
  const void* payload;  ///< by kind; never null
} hw_output_t;

/// hw_pose_output_t.status.
enum {
  HW_POSE_LOST = 0,  ///< the frame does not determine the pose; T_map_body is not read
  HW_POSE_VALID = 1  ///< T_map_body is the pose
};

/// Payload of HW_OUTPUT_POSE: where the body is at the time of this frame, or at `t_ns`. The map's frame is the plugin's
/// choice; usually the body frame of the first frame.
typedef struct hw_pose_output_t {
  uint32_t size;         ///< sizeof(hw_pose_output_t) of the writer
  uint32_t status;       ///< HW_POSE_…
  hw_pose_t T_map_body;  ///< finite, unit quaternion (to 1e-6)
  /// Null: not told. Else the covariance of the pose's error, 6 x 6, by rows: of its position (x, y, z in the map's frame,
  /// metres), then of its rotation (a rotation vector in the map's frame, radians: true rotation = exp(error) * rotation).
  /// Finite, symmetric, no negative variance. Since 1.2.
  const double* covariance;
  /// The time that the pose is of, on the clock of hw_frame_t.t_ns: above 0 and not later than the frame's. 0: the frame's. In report() 0. Since 1.5.
  int64_t t_ns;
} hw_pose_output_t;

/// The time that a pose is of; 0: the frame's, also where it was written before 1.5. [any]
static inline int64_t hw_pose_time_ns(const hw_pose_output_t* pose) {
  return HW_HAS(pose, hw_pose_output_t, t_ns) ? pose->t_ns : 0;
}

/// Payload of HW_OUTPUT_DRIVE_COMMAND: how the robot shall move from now on, until the next command. A host that has no
/// robot to drive takes it down and does nothing with it.
typedef struct hw_drive_command_t {
  uint32_t size;         ///< sizeof(hw_drive_command_t) of the writer
  uint32_t reserved;     ///< 0
  double linear_m_s;     ///< along the body's x axis, forward positive; finite
  double angular_rad_s;  ///< about the body's z axis, to the left positive; finite
  double lateral_m_s;    ///< along the body's y axis, to the left positive; finite; not there: 0. Since 1.4.
} hw_drive_command_t;

/// How fast a command moves the robot to the left; 0 where it was written before 1.4. [any]
static inline double hw_lateral_m_s(const hw_drive_command_t* command) {
  return HW_HAS(command, hw_drive_command_t, lateral_m_s) ? command->lateral_m_s : 0.0;
}

/// Stands for "no landmark"; never the id of one.
#define HW_NO_LANDMARK UINT64_MAX

/// hw_landmark_t.status.
enum {
  HW_LANDMARK_TEMPORARY = 0,  ///< seen too seldom yet to be relied on
  HW_LANDMARK_MAPPED = 1,     ///< part of the map
  HW_LANDMARK_DYNAMIC = 2     ///< found to move; not part of the map
};

/// One landmark of the map. Frozen.
typedef struct hw_landmark_t {
  uint64_t id;            ///< names the landmark for the life of the plugin; not HW_NO_LANDMARK
  double position[3];     ///< x, y, z in the map's frame, metres; finite
  uint32_t observations;  ///< how many observations it was made from
  uint32_t status;        ///< HW_LANDMARK_…
} hw_landmark_t;

/// Payload of HW_OUTPUT_LANDMARKS.
typedef struct hw_landmarks_t {
  uint32_t size;          ///< sizeof(hw_landmarks_t) of the writer
  uint32_t stride;        ///< bytes from one landmark to the next, a multiple of 8
  uint64_t count;         ///< number of landmarks
  const void* landmarks;  ///< hw_landmark_t by `stride`; ids are distinct within a call
  /// Null: not told. Else for each landmark the covariance of its position's error in the map's frame, square metres:
  /// xx, xy, xz, yy, yz, zz. Finite, no negative variance. A landmark of which none is known has six zeros. Since 1.2.
  const double* covariances;
} hw_landmarks_t;

/// Payload of HW_OUTPUT_ASSOCIATIONS: for each element of one sample, in its order, the landmark or mapped plane that
/// it was taken for.
typedef struct hw_associations_t {
  uint32_t size;                 ///< sizeof(hw_associations_t) of the writer
  uint32_t sample;               ///< index of the sample in hw_frame_t.samples
  uint64_t count;                ///< the sample's own number of elements
  const uint64_t* landmark_ids;  ///< `count` ids, HW_NO_LANDMARK where it was taken for none
} hw_associations_t;

/// A part of the map that is rigid in itself. Frozen.
typedef struct hw_submap_t {
  uint64_t id;             ///< names the submap for the life of the plugin
  hw_pose_t T_map_submap;  ///< finite, unit quaternion (to 1e-6)
  /// Its landmarks, or mapped planes, are members[first_member … first_member + n_members - 1].
  uint64_t first_member;
  uint64_t n_members;  ///< number of its members
} hw_submap_t;

/// Payload of HW_OUTPUT_SUBMAPS. A landmark may be a member of several submaps.
typedef struct hw_submaps_t {
  uint32_t size;            ///< sizeof(hw_submaps_t) of the writer
  uint32_t stride;          ///< bytes from one submap to the next, a multiple of 8
  uint64_t count;           ///< number of submaps
  const void* submaps;      ///< hw_submap_t by `stride`
  uint64_t n_members;       ///< number of entries in `members`
  const uint64_t* members;  ///< landmark ids
} hw_submaps_t;

/// Name of a counter that hosts read; since 1.4. In process(): the number of the connected part of the map that this
/// frame's pose is in, a whole number from 0 to 2^53. Poses under one number are in one frame of reference. A part without
/// a known connection to those before has a number that was never used; so has a map that is started over. Where two parts
/// are joined, both go by the smaller number from that frame on. A plugin that puts no such counter has one part. Of a
/// frame without a pose the number is not read.
///
/// In report(): where the poses answered under number N belong to the frame of reference of part M, the counter with the
/// name HW_COUNTER_MAP_EPOCH "_N" (`map_epoch_3`) has the value M. It is put for joined parts only, and M is not joined to
/// another part. Where poses were answered in a frame of reference of their own before a join, it is not put.
#define HW_COUNTER_MAP_EPOCH "map_epoch"

/// A number worth watching. Frozen.
typedef struct hw_counter_t {
  const char* name;  ///< snake_case ASCII with its unit where it has one, e.g. "submaps_closed"
  double value;      ///< finite
} hw_counter_t;

/// Payload of HW_OUTPUT_COUNTERS.
typedef struct hw_counters_t {
  uint32_t size;         ///< sizeof(hw_counters_t) of the writer
  uint32_t stride;       ///< bytes from one counter to the next, a multiple of 8
  uint64_t count;        ///< number of counters
  const void* counters;  ///< hw_counter_t by `stride`
} hw_counters_t;

#ifdef __cplusplus
}
#endif
