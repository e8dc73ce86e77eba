// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "growth.h"

#ifdef __cplusplus
extern "C" {
#endif

/// hw_topology_node_t.kind. Since 1.6.
enum {
  HW_TOPOLOGY_DISCONTINUITY = 1,  ///< a step or an end of the wall that the robot follows
  HW_TOPOLOGY_SWEEP = 2,          ///< a sonar sweep at an opening that is neither a room nor a hallway yet
  HW_TOPOLOGY_ROOM = 3,           ///< the opening of a room
  HW_TOPOLOGY_HALLWAY_END = 4,    ///< the end of a hallway
  HW_TOPOLOGY_JUNCTION = 5        ///< where hallways meet
};

/// hw_topology_t.loop. Since 1.6.
enum {
  HW_LOOP_OPEN = 0,      ///< no loop is closed
  HW_LOOP_CLOSED = 1,    ///< the way leads back to where it began
  HW_LOOP_UNCERTAIN = 2  ///< it may: several places read alike
};

/// Limits of a topology. Since 1.6.
#define HW_MAX_TOPOLOGY_NODES 65536u
#define HW_MAX_TOPOLOGY_EDGES 65536u
/// Bytes of hw_topology_t.note without its terminating 0.
#define HW_MAX_NOTE_BYTES 1000u

/// A place of a topological map. It has no pose: it says where the place was seen from the robot, and when. Frozen; since 1.6.
typedef struct hw_topology_node_t {
  uint32_t id;        ///< names the place for the life of the plugin; distinct in a topology
  uint32_t kind;      ///< HW_TOPOLOGY_…
  int32_t direction;  ///< of a discontinuity: +1 the wall goes on farther from the robot, -1 nearer; else 0
  uint32_t visits;    ///< how often the robot was there
  /// Of a discontinuity the step of the wall, metres, from 0 on; +Inf where no wall was seen behind. Else NaN.
  double size_m;
  int64_t t_ns;  ///< hw_frame_t.t_ns of the frame in which the robot was abreast of it the first time
  double x_m;    ///< where it was in the body's frame at that time: forward; finite
  double y_m;    ///< to the left; finite
} hw_topology_node_t;

/// A way that the robot took along the wall from one place to another. Frozen; since 1.6.
typedef struct hw_topology_edge_t {
  uint32_t from;          ///< id of a node
  uint32_t to;            ///< id of a node
  double length_m;        ///< of the way, by odometry; finite, from 0 on
  double confidence;      ///< that the edge is right, from 0 to 1
  int32_t quarter_turns;  ///< sum of the turns of 90 degrees on the way, to the left positive
  uint32_t reserved;      ///< 0
} hw_topology_edge_t;

/// Payload of HW_OUTPUT_TOPOLOGY: the whole topological map as it is now, after section 2.2.4 of the thesis. Put in process() when it has
/// changed, and in report(); the last one holds. Since 1.6.
typedef struct hw_topology_t {
  uint32_t size;         ///< sizeof(hw_topology_t) of the writer
  uint32_t loop;         ///< HW_LOOP_…
  uint32_t node_stride;  ///< bytes from one node to the next, a multiple of 8
  uint32_t edge_stride;  ///< bytes from one edge to the next, a multiple of 8
  uint64_t n_nodes;      ///< number of nodes, at most HW_MAX_TOPOLOGY_NODES
  const void* nodes;     ///< hw_topology_node_t by `node_stride`
  uint64_t n_edges;      ///< number of edges, at most HW_MAX_TOPOLOGY_EDGES
  const void* edges;     ///< hw_topology_edge_t by `edge_stride`; several may join the same two nodes
  const char*
      note;  ///< why the loop is open, closed or uncertain, for people: UTF-8, may be empty, never null
} hw_topology_t;

#ifdef __cplusplus
}
#endif
