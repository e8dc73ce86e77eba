// SPDX-License-Identifier: MIT
//
// The only source file that works with Embree. It holds a tree of boxes in single precision, one box for each block
// of up to eight triangles ("user geometry"); it finds which boxes a ray passes, and the block's triangles are
// decided in single precision with bounds on the error (triangle_blocks.cpp); those that the bounds leave open, by
// TriangleSet::hit() in double precision. Hence the answers are those of the brute-force backend if no box is missed
// that a hit's point lies in. This is why none is:
//
// - Coordinates are taken relative to the centre of the scene, and the ray is first cut, in double precision,
//   to the scene's grown box. So every number that Embree computes with is at most the scene's radius R
//   (times sqrt 2); a ray is at least 2^-20 R long, and runs from 0 to 1.
// - A hit's point lies within box_slack_m() of its triangle's box. The boxes are grown by that and by
//   kFloatSlack R more.
// - Each rounding in Embree's box test (the ray in float, reciprocals by Newton steps, products, differences)
//   acts like a shift of a side of the box by at most a few 2^-24 R, whatever the ray's slope; kFloatSlack
//   covers 32 of them, twice what the longest chain of operations needs. The time at which a box is entered
//   is thus never taken too late, either, and boxes are skipped only if they are entered after the best hit
//   so far.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "base/error.hpp"
#include "trace/embree_library.hpp"
#include "trace/query_backend.hpp"
#include "trace/triangle_blocks.hpp"

namespace hallway::trace {
namespace {

/// Relative to the scene's radius; see above.
constexpr double kFloatSlack = 32.0 * 0x1.0p-24;

const char* error_text(RTCError error) {
  switch (error) {
    case RTC_ERROR_NONE:
      return "no error";
    case RTC_ERROR_INVALID_ARGUMENT:
      return "invalid argument";
    case RTC_ERROR_INVALID_OPERATION:
      return "invalid operation";
    case RTC_ERROR_OUT_OF_MEMORY:
      return "out of memory";
    case RTC_ERROR_UNSUPPORTED_CPU:
      return "this CPU is not supported";
    case RTC_ERROR_CANCELLED:
      return "cancelled";
    default:  // each version adds some
      return "unknown error";
  }
}

/// Throws if Embree reported a failure on this thread since the last call. `device` may be null after a
/// failed start.
void check(RTCDevice device, const char* doing) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE) {
    throw Error(ErrorCode::kInternal, std::string("Embree failed ") + doing + ": " + error_text(error));
  }
}

/// The instruction set that Embree is told to use, so that a run's record says what was used.
const char* instruction_set() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"))
    return "avx2";
  if (__builtin_cpu_supports("avx")) return "avx";
  if (__builtin_cpu_supports("sse4.2")) return "sse4.2";
  return "sse2";
#else
  return "default";
#endif
}

/// One for the process. Trees are built on the calling thread: no thread of Embree's own outlives a call.
class Device {
 public:
  Device() : handle_(rtcNewDevice((std::string("threads=1,isa=") + instruction_set()).c_str())) {
    check(handle_, "to start");
  }
  ~Device() { rtcReleaseDevice(handle_); }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  RTCDevice get() const { return handle_; }

 private:
  RTCDevice handle_;
};

RTCDevice device() {
  static const Device instance;
  return instance.get();
}

struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

struct ReleaseGeometry {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using GeometryHandle = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, ReleaseGeometry>;

float round_down(double value) {
  return std::nextafter(static_cast<float>(value), -std::numeric_limits<float>::max());
}
float round_up(double value) {
  return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::max());
}

/// The part of a line that lies in the box, as distances along the line; empty if it misses.
struct Span {
  double begin;
  double end;
};

std::optional<Span> clip(const SightLine& line, const Box& box) {
  Span span{0.0, line.max_distance};
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.min()[axis] - line.origin[axis];
    const double high = box.max()[axis] - line.origin[axis];
    const double slope = line.direction[axis];
    if (slope == 0.0) {
      if (low > 0.0 || high < 0.0) return std::nullopt;
      continue;
    }
    span.begin = std::max(span.begin, std::min(low / slope, high / slope));
    span.end = std::min(span.end, std::max(low / slope, high / slope));
  }
  return span.begin <= span.end ? std::optional(span) : std::nullopt;
}

constexpr std::size_t kPacket = 8;  ///< rays that Embree traces together: as wide as AVX
alignas(32) constexpr std::array<int, kPacket> kAllValid{-1, -1, -1, -1, -1, -1, -1, -1};

/// True for rays whose ends lie side by side as seen from their common start: tracing them together then pays.
bool run_together(const RTCRay8& rays) {
  constexpr float kSpread = 1.5f;  // packets of rays further apart are slower than single rays
  const auto spread = [](const float* values) {
    const auto [low, high] = std::minmax_element(values, values + kPacket);
    return *high - *low;
  };
  float longest = 0.0f;
  for (std::size_t i = 0; i < kPacket; ++i) {
    longest = std::max(longest, std::abs(rays.dir_x[i]) + std::abs(rays.dir_y[i]) + std::abs(rays.dir_z[i]));
  }
  return spread(rays.dir_x) + spread(rays.dir_y) + spread(rays.dir_z) < kSpread * longest;
}

class EmbreeBackend final : public QueryBackend {
 public:
  explicit EmbreeBackend(TriangleSet triangles)
      : triangles_(std::move(triangles)),
        blocks_(triangles_),
        box_growth_m_(triangles_.box_slack_m() + kFloatSlack * triangles_.radius_m()),
        reach_(triangles_.bounds()),
        certify_(fastest_certify()) {
    if (blocks_.size() == 0) {
      reach_.setEmpty();
      return;
    }
    reach_.min().array() -= box_growth_m_;
    reach_.max().array() += box_growth_m_;
    build();
  }

  std::optional<Hit> first_hit(const SightLine& line) const override {
    SearchedRay searched;
    return begin_search(line, searched) ? search(searched) : std::nullopt;
  }

  void first_hits(std::span<const SightLine> lines, std::span<std::optional<Hit>> hits) const override {
    std::array<SearchedRay, kPacket> packet;
    std::array<std::size_t, kPacket> place{};
    std::size_t n = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      hits[i].reset();
      if (!begin_search(lines[i], packet[n])) continue;
      place[n++] = i;
      if (n < kPacket) continue;
      search_packet(packet);
      for (std::size_t k = 0; k < kPacket; ++k) hits[place[k]] = packet[k].nearest;
      n = 0;
    }
    for (std::size_t k = 0; k < n; ++k) hits[place[k]] = search(packet[k]);
  }

  bool occluded(const Vec3& from, const Vec3& to) const override {
    FloatSegment segment;
    if (reaches(from) && reaches(to) && is_long(to - from)) {
      segment = blocks_.segment(from - blocks_.centre(), to - from, true);
    } else {
      const auto line = sight_line_between(from, to);
      const auto span = line ? part_in_reach(*line) : std::nullopt;
      if (!span) return false;
      segment = segment_on(*line, *span);
    }
    return trace(from, to, segment);
  }

  void occluded_from(const Vec3& eye, std::span<const Vec3> points,
                     std::span<std::uint8_t> occluded_points) const override {
    if (!reaches(eye)) {
      for (std::size_t i = 0; i < points.size(); ++i) occluded_points[i] = occluded(eye, points[i]) ? 1 : 0;
      return;
    }
    for (std::size_t i = 0; i < points.size(); i += kPacket) {
      const std::size_t count = std::min(kPacket, points.size() - i);
      trace_packet(eye, points.subspan(i, count), occluded_points.subspan(i, count));
    }
  }

 private:
  /// Rides along with rays through Embree to the call-back. Rays carry their index in `time`, which nothing here uses
  /// otherwise: where Embree regroups rays it does not hand on `id`.
  struct OcclusionQuery : EmbreeQuery {
    OcclusionQuery(const Vec3& start, const Vec3* end_points, const FloatSegment* float_segments)
        : from(start), ends(end_points), segments(float_segments) {}
    const Vec3& from;
    const Vec3* ends;
    const FloatSegment* segments;
  };

  /// A ray whose first hit is searched for.
  struct SearchedRay {
    const SightLine* line = nullptr;
    FloatSegment segment{};
    double begin = 0.0;   ///< distance along the line at which Embree's ray starts
    double length = 0.0;  ///< of Embree's ray, metres
    std::optional<Hit> nearest{};
  };

  struct FirstHitQuery : EmbreeQuery {
    FirstHitQuery(const EmbreeBackend& asked_backend, SearchedRay* searched_rays)
        : backend(asked_backend), rays(searched_rays) {}
    const EmbreeBackend& backend;
    SearchedRay* rays;  ///< by RTCRay::time
  };

  /// False for a line that meets nothing.
  bool begin_search(const SightLine& line, SearchedRay& searched) const {
    const auto span = part_in_reach(line);
    if (!span) return false;
    searched.line = &line;
    searched.segment = segment_on(line, *span);
    searched.begin = span->begin;
    searched.length = std::max(span->end - span->begin, blocks_.least_length_m());
    searched.nearest.reset();
    return true;
  }

  std::optional<Hit> search(SearchedRay& searched) const {
    FirstHitQuery query(*this, &searched);
    RTCRayHit ray{};
    ray.ray = float_ray(searched.segment);
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    embree_first_hit(scene_.get(), query, ray);
    return searched.nearest;
  }

  void search_packet(std::array<SearchedRay, kPacket>& packet) const {
    RTCRayHit8 rays;
    for (std::size_t i = 0; i < kPacket; ++i) {
      set_ray(rays.ray, i, packet[i].segment);
      rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    if (!run_together(rays.ray)) {
      for (SearchedRay& searched : packet) search(searched);
      return;
    }
    FirstHitQuery query(*this, packet.data());
    embree_first_hit(scene_.get(), query, kAllValid.data(), rays);
  }

  void build() {
    const RTCDevice embree = device();
    scene_.reset(rtcNewScene(embree));
    check(embree, "to make a scene");
    // Robust: Embree's other mode trades exactness of the traversal for speed.
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    const GeometryHandle geometry(rtcNewGeometry(embree, RTC_GEOMETRY_TYPE_USER));
    check(embree, "to make a geometry");
    rtcSetGeometryUserPrimitiveCount(geometry.get(), blocks_.size());
    rtcSetGeometryUserData(geometry.get(), this);
    rtcSetGeometryBoundsFunction(geometry.get(), &EmbreeBackend::give_box, nullptr);
    rtcSetGeometryIntersectFunction(geometry.get(), &EmbreeBackend::take_first_hit);
    rtcSetGeometryOccludedFunction(geometry.get(), &EmbreeBackend::take_any_hit);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene_.get(), geometry.get());
    rtcCommitScene(scene_.get());
    check(embree, "to build the tree of the scene's triangles");
  }

  std::optional<Span> part_in_reach(const SightLine& line) const {
    return reach_.isEmpty() ? std::nullopt : clip(line, reach_);
  }

  bool reaches(const Vec3& point) const {
    return point.x() >= reach_.min().x() && point.x() <= reach_.max().x() && point.y() >= reach_.min().y() &&
           point.y() <= reach_.max().y() && point.z() >= reach_.min().z() && point.z() <= reach_.max().z();
  }

  bool is_long(const Vec3& delta) const { return delta.squaredNorm() > least_squared_; }

  FloatSegment segment_on(const SightLine& line, const Span& span) const {
    const double length = span.end - span.begin;
    const double least = blocks_.least_length_m();
    const Vec3 origin = line.origin - blocks_.centre();
    const bool sure = length >= least && origin.cwiseAbs().maxCoeff() <= blocks_.sure_within_m();
    return blocks_.segment(origin + span.begin * line.direction, std::max(length, least) * line.direction,
                           sure);
  }

  static RTCRay float_ray(const FloatSegment& segment) {
    RTCRay ray{};
    ray.org_x = segment.origin[0];
    ray.org_y = segment.origin[1];
    ray.org_z = segment.origin[2];
    ray.dir_x = segment.delta[0];
    ray.dir_y = segment.delta[1];
    ray.dir_z = segment.delta[2];
    ray.tnear = 0.0f;
    ray.tfar = 1.0f;
    ray.mask = ~0u;
    return ray;
  }

  bool trace(const Vec3& from, const Vec3& to, const FloatSegment& segment) const {
    OcclusionQuery query(from, &to, &segment);
    RTCRay ray = float_ray(segment);
    embree_occluded(scene_.get(), query, ray);
    return ray.tfar < 0.0f;
  }

  void trace_packet(const Vec3& eye, std::span<const Vec3> points,
                    std::span<std::uint8_t> occluded_points) const {
    std::array<FloatSegment, kPacket> segments;
    RTCRay8 rays;
    bool simple = points.size() == kPacket;
    for (std::size_t i = 0; i < points.size() && simple; ++i) {
      simple = reaches(points[i]) && is_long(points[i] - eye);
      segments[i] = blocks_.segment(eye - blocks_.centre(), points[i] - eye, true);
      set_ray(rays, i, segments[i]);
    }
    if (!simple) {
      for (std::size_t i = 0; i < points.size(); ++i) occluded_points[i] = occluded(eye, points[i]) ? 1 : 0;
      return;
    }
    if (!run_together(rays)) {
      for (std::size_t i = 0; i < kPacket; ++i)
        occluded_points[i] = trace(eye, points[i], segments[i]) ? 1 : 0;
      return;
    }
    OcclusionQuery query(eye, points.data(), segments.data());
    embree_occluded(scene_.get(), query, kAllValid.data(), rays);
    for (std::size_t i = 0; i < kPacket; ++i) occluded_points[i] = rays.tfar[i] < 0.0f ? 1 : 0;
  }

  static void set_ray(RTCRay8& rays, std::size_t i, const FloatSegment& segment) {
    rays.org_x[i] = segment.origin[0];
    rays.org_y[i] = segment.origin[1];
    rays.org_z[i] = segment.origin[2];
    rays.dir_x[i] = segment.delta[0];
    rays.dir_y[i] = segment.delta[1];
    rays.dir_z[i] = segment.delta[2];
    rays.tnear[i] = 0.0f;
    rays.tfar[i] = 1.0f;
    rays.time[i] = static_cast<float>(i);
    rays.mask[i] = ~0u;
    rays.id[i] = 0;
    rays.flags[i] = 0;
  }

  static void give_box(const RTCBoundsFunctionArguments* arguments) {
    const auto* self = static_cast<const EmbreeBackend*>(arguments->geometryUserPtr);
    const Box& box = self->blocks_.box(arguments->primID);
    const Vec3 low = (box.min() - self->blocks_.centre()).array() - self->box_growth_m_;
    const Vec3 high = (box.max() - self->blocks_.centre()).array() + self->box_growth_m_;
    RTCBounds& bounds = *arguments->bounds_o;
    bounds.lower_x = round_down(low.x());
    bounds.lower_y = round_down(low.y());
    bounds.lower_z = round_down(low.z());
    bounds.upper_x = round_up(high.x());
    bounds.upper_y = round_up(high.y());
    bounds.upper_z = round_up(high.z());
  }

  static void take_first_hit(const RTCIntersectFunctionNArguments* arguments) {
    const auto& query = static_cast<const FirstHitQuery&>(*arguments->context);
    RTCRayN* const rays = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
    for (unsigned i = 0; i < arguments->N; ++i) {
      if (arguments->valid[i] == 0) continue;
      SearchedRay& ray = query.rays[static_cast<std::size_t>(RTCRayN_time(rays, arguments->N, i))];
      if (!query.backend.search_block(arguments->primID, ray)) continue;
      // From here on only boxes that are entered no later than this hit are of interest.
      const float at = round_up((ray.nearest->distance - ray.begin) / ray.length);
      float& end = RTCRayN_tfar(rays, arguments->N, i);
      end = std::min(end, std::max(0.0f, at));
    }
  }

  /// Whether a block of triangles has a nearer hit.
  bool search_block(std::uint32_t index, SearchedRay& ray) const {
    const TriangleBlock& block = blocks_[index];
    bool nearer = false;
    const Verdict verdict = certify_(block, ray.segment);
    for (std::uint32_t open = verdict.open; open != 0; open &= open - 1) {
      const std::uint32_t triangle = block.triangle[static_cast<std::size_t>(std::countr_zero(open))];
      const bool is_sure = (verdict.hit & open & (~open + 1)) != 0;
      const auto distance = is_sure ? std::optional(triangles_.distance_of_hit(triangle, *ray.line))
                                    : triangles_.hit(triangle, *ray.line);
      if (!distance) continue;
      if (ray.nearest &&
          std::pair(*distance, triangle) > std::pair(ray.nearest->distance, ray.nearest->triangle)) {
        continue;
      }
      ray.nearest = Hit{*distance, triangle};
      nearer = true;
    }
    return nearer;
  }

  static void take_any_hit(const RTCOccludedFunctionNArguments* arguments) {
    const auto& query = static_cast<const OcclusionQuery&>(*arguments->context);
    const auto& self = *static_cast<const EmbreeBackend*>(arguments->geometryUserPtr);
    const TriangleBlock& block = self.blocks_[arguments->primID];
    for (unsigned i = 0; i < arguments->N; ++i) {
      if (arguments->valid[i] == 0) continue;
      const auto ray = static_cast<std::size_t>(RTCRayN_time(arguments->ray, arguments->N, i));
      const Verdict verdict = self.certify_(block, query.segments[ray]);
      if (verdict.open == 0) continue;
      if (verdict.hit == 0 && !self.decide(block, verdict.open, query.from, query.ends[ray])) continue;
      RTCRayN_tfar(arguments->ray, arguments->N, i) =
          -std::numeric_limits<float>::infinity();  // Embree: "occluded"
    }
  }

  /// Whether the line meets one of the open triangles of a block, in double precision.
  bool decide(const TriangleBlock& block, std::uint32_t open, const Vec3& from, const Vec3& to) const {
    const auto line = sight_line_between(from, to);
    for (; line && open != 0; open &= open - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(open));
      if (triangles_.hit(block.triangle[lane], *line)) return true;
    }
    return false;
  }

  TriangleSet triangles_;
  TriangleBlocks blocks_;
  double box_growth_m_;
  double least_squared_ = blocks_.least_length_m() * blocks_.least_length_m();
  Box reach_;  ///< all grown boxes lie in it; empty if there are none
  Certify certify_;
  SceneHandle scene_;
};

}  // namespace

std::unique_ptr<const QueryBackend> make_embree_backend(TriangleSet triangles) {
  return std::make_unique<EmbreeBackend>(std::move(triangles));
}

std::string embree_description() {
  const auto part = [](RTCDeviceProperty property) {
    return std::to_string(rtcGetDeviceProperty(device(), property));
  };
  return "Embree " + part(RTC_DEVICE_PROPERTY_VERSION_MAJOR) + "." + part(RTC_DEVICE_PROPERTY_VERSION_MINOR) +
         "." + part(RTC_DEVICE_PROPERTY_VERSION_PATCH) + ", ISA " + instruction_set();
}

}  // namespace hallway::trace
