// SPDX-License-Identifier: MIT
//
// The only source file that knows Embree. Embree holds a tree of boxes in single precision, one box for each
// triangle ("user geometry"); it finds which boxes a ray passes, and TriangleSet::hit() decides in double
// precision. Hence the answers are those of the brute-force backend if no box is missed that a hit's point
// lies in. This is why none is:
//
// - Coordinates are taken relative to the centre of the scene, and the ray is first cut, in double precision,
//   to the scene's grown box. So every number that Embree computes with is at most the scene's radius R
//   (times sqrt 2).
// - A hit's point lies within box_slack_m() of its triangle's box. The boxes are grown by that and by
//   kFloatSlack R more.
// - Each rounding in Embree's box test (the ray in float, reciprocals by Newton steps, products, differences)
//   acts like a shift of a side of the box by at most a few 2^-24 R, whatever the ray's slope; kFloatSlack
//   covers 32 of them, twice what the longest chain of operations needs. The time at which a box is entered
//   is thus never taken too late, either, and boxes are skipped only if they are entered after the best hit
//   so far.
#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "base/error.hpp"
#include "trace/query_backend.hpp"

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
    case RTC_ERROR_UNKNOWN:
      break;
  }
  return "unknown error";
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

class EmbreeBackend final : public QueryBackend {
 public:
  explicit EmbreeBackend(TriangleSet triangles)
      : triangles_(std::move(triangles)),
        centre_(triangles_.bounds().isEmpty() ? Vec3::Zero() : Vec3(triangles_.bounds().center())),
        box_growth_m_(triangles_.box_slack_m() + kFloatSlack * triangles_.radius_m()),
        reach_(triangles_.bounds()) {
    if (triangles_.size() == 0) return;  // reach_ is empty: clip() lets nothing through to Embree
    reach_.min().array() -= box_growth_m_;
    reach_.max().array() += box_growth_m_;
    build();
  }

  std::optional<Hit> first_hit(const SightLine& line) const override {
    const auto span = clip(line, reach_);
    if (triangles_.size() == 0 || !span) return std::nullopt;
    Query query(*this, line, span->begin);
    RTCRayHit ray{};
    ray.ray = float_ray(line, *span);
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_.get(), &query, &ray);
    return query.nearest;
  }

  bool any_hit(const SightLine& line) const override {
    const auto span = clip(line, reach_);
    if (triangles_.size() == 0 || !span) return false;
    Query query(*this, line, span->begin);
    RTCRay ray = float_ray(line, *span);
    rtcOccluded1(scene_.get(), &query, &ray);
    return query.nearest.has_value();
  }

 private:
  /// Rides along with a ray through Embree to the call-backs.
  struct Query : RTCIntersectContext {
    Query(const EmbreeBackend& asked_backend, const SightLine& asked_line, double ray_begin)
        : RTCIntersectContext(), backend(asked_backend), line(asked_line), begin(ray_begin) {
      rtcInitIntersectContext(this);
    }
    const EmbreeBackend& backend;
    const SightLine& line;
    double begin;  ///< distance along the line at which Embree's ray starts
    std::optional<Hit> nearest{};
  };

  void build() {
    const RTCDevice embree = device();
    scene_.reset(rtcNewScene(embree));
    check(embree, "to make a scene");
    // Robust: Embree's other mode trades exactness of the traversal for speed.
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    const GeometryHandle geometry(rtcNewGeometry(embree, RTC_GEOMETRY_TYPE_USER));
    check(embree, "to make a geometry");
    rtcSetGeometryUserPrimitiveCount(geometry.get(), triangles_.size());
    rtcSetGeometryUserData(geometry.get(), this);
    rtcSetGeometryBoundsFunction(geometry.get(), &EmbreeBackend::give_box, nullptr);
    rtcSetGeometryIntersectFunction(geometry.get(), &EmbreeBackend::take_first_hit);
    rtcSetGeometryOccludedFunction(geometry.get(), &EmbreeBackend::take_any_hit);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene_.get(), geometry.get());
    rtcCommitScene(scene_.get());
    check(embree, "to build the tree of the scene's triangles");
  }

  RTCRay float_ray(const SightLine& line, const Span& span) const {
    const Vec3 origin = line.origin + span.begin * line.direction - centre_;
    RTCRay ray{};
    ray.org_x = static_cast<float>(origin.x());
    ray.org_y = static_cast<float>(origin.y());
    ray.org_z = static_cast<float>(origin.z());
    ray.dir_x = static_cast<float>(line.direction.x());
    ray.dir_y = static_cast<float>(line.direction.y());
    ray.dir_z = static_cast<float>(line.direction.z());
    ray.tnear = 0.0f;
    ray.tfar = round_up(span.end - span.begin);
    ray.mask = ~0u;
    return ray;
  }

  static void give_box(const RTCBoundsFunctionArguments* arguments) {
    const auto* self = static_cast<const EmbreeBackend*>(arguments->geometryUserPtr);
    const Box box = self->triangles_.box(arguments->primID);
    const Vec3 low = (box.min() - self->centre_).array() - self->box_growth_m_;
    const Vec3 high = (box.max() - self->centre_).array() + self->box_growth_m_;
    RTCBounds& bounds = *arguments->bounds_o;
    bounds.lower_x = round_down(low.x());
    bounds.lower_y = round_down(low.y());
    bounds.lower_z = round_down(low.z());
    bounds.upper_x = round_up(high.x());
    bounds.upper_y = round_up(high.y());
    bounds.upper_z = round_up(high.z());
  }

  static void take_first_hit(const RTCIntersectFunctionNArguments* arguments) {
    auto& query = static_cast<Query&>(*arguments->context);
    const std::uint32_t triangle = arguments->primID;
    const auto distance = query.backend.triangles_.hit(triangle, query.line);
    if (!distance) return;
    if (query.nearest &&
        std::pair(*distance, triangle) > std::pair(query.nearest->distance, query.nearest->triangle)) {
      return;
    }
    query.nearest = Hit{*distance, triangle};
    // From here on only boxes that are entered no later than this hit are of interest.
    float& end = RTCRayN_tfar(RTCRayHitN_RayN(arguments->rayhit, arguments->N), arguments->N, 0);
    end = std::min(end, std::max(0.0f, round_up(*distance - query.begin)));
  }

  static void take_any_hit(const RTCOccludedFunctionNArguments* arguments) {
    auto& query = static_cast<Query&>(*arguments->context);
    const auto distance = query.backend.triangles_.hit(arguments->primID, query.line);
    if (!distance) return;
    query.nearest = Hit{*distance, arguments->primID};
    RTCRayN_tfar(arguments->ray, arguments->N, 0) =
        -std::numeric_limits<float>::infinity();  // Embree: "occluded"
  }

  TriangleSet triangles_;
  Vec3 centre_;
  double box_growth_m_;
  Box reach_;  ///< all grown boxes lie in it
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
