// SPDX-License-Identifier: MIT
#pragma once

// The one file that knows Embree's versions: 3.13 (Debian 12) and 4 (from Debian 13 on).

#ifndef HALLWAY_EMBREE_MAJOR
#error "HALLWAY_EMBREE_MAJOR comes with the CMake target hallway_embree"
#endif

#if HALLWAY_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace hallway::trace {

#if HALLWAY_EMBREE_MAJOR >= 4

/// What rides along with a ray to the call-backs.
struct EmbreeQuery : RTCRayQueryContext {
  EmbreeQuery() : RTCRayQueryContext() { rtcInitRayQueryContext(this); }
};

/// Finds the first thing that the ray meets.
inline void embree_first_hit(RTCScene scene, EmbreeQuery& query, RTCRayHit& ray) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &query;
  rtcIntersect1(scene, &ray, &arguments);
}

/// The same for eight rays; `valid` is -1 for each that counts, and aligned to 32 bytes.
inline void embree_first_hit(RTCScene scene, EmbreeQuery& query, const int* valid, RTCRayHit8& rays) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &query;
  rtcIntersect8(valid, scene, &rays, &arguments);
}

/// Sets `tfar` below 0 if the ray meets anything.
inline void embree_occluded(RTCScene scene, EmbreeQuery& query, RTCRay& ray) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &query;
  rtcOccluded1(scene, &ray, &arguments);
}

/// The same for eight rays; `valid` is -1 for each that counts, and aligned to 32 bytes.
inline void embree_occluded(RTCScene scene, EmbreeQuery& query, const int* valid, RTCRay8& rays) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &query;
  rtcOccluded8(valid, scene, &rays, &arguments);
}

#else

/// What rides along with a ray to the call-backs.
struct EmbreeQuery : RTCIntersectContext {
  EmbreeQuery() : RTCIntersectContext() { rtcInitIntersectContext(this); }
};

/// Finds the first thing that the ray meets.
inline void embree_first_hit(RTCScene scene, EmbreeQuery& query, RTCRayHit& ray) {
  rtcIntersect1(scene, &query, &ray);
}

/// The same for eight rays; `valid` is -1 for each that counts, and aligned to 32 bytes.
inline void embree_first_hit(RTCScene scene, EmbreeQuery& query, const int* valid, RTCRayHit8& rays) {
  rtcIntersect8(valid, scene, &query, &rays);
}

/// Sets `tfar` below 0 if the ray meets anything.
inline void embree_occluded(RTCScene scene, EmbreeQuery& query, RTCRay& ray) {
  rtcOccluded1(scene, &query, &ray);
}

/// The same for eight rays; `valid` is -1 for each that counts, and aligned to 32 bytes.
inline void embree_occluded(RTCScene scene, EmbreeQuery& query, const int* valid, RTCRay8& rays) {
  rtcOccluded8(valid, scene, &query, &rays);
}

#endif

}  // namespace hallway::trace
