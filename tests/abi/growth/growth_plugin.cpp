// SPDX-License-Identifier: MIT
//
// Tells through counters what it read of every struct that may grow. Built against today's headers and against grown ones.

#include <cmath>
#include <hallway/plugin.hpp>
#include <vector>

namespace {

template <typename T>
double has_grown([[maybe_unused]] const T* p) {
#ifdef HW_TEST_GROWN
  return HW_HAS(p, T, grown_counts) ? 1 : 0;
#else
  return 0;
#endif
}

class GrowthPlugin final : public hallway::sdk::Plugin {
 public:
  static const hw_plugin_info_t* info() {
#if HW_ABI_MINOR >= 5
    static constexpr std::uint32_t kInputs[] = {HW_SAMPLE_POINTS, HW_SAMPLE_RANGE_SCAN, HW_SAMPLE_ODOMETRY,
                                                HW_SAMPLE_IMU};
#else
    static constexpr std::uint32_t kInputs[] = {HW_SAMPLE_POINTS};
#endif
    static constexpr std::uint32_t kOutputs[] = {HW_OUTPUT_POSE};
    static constexpr hw_plugin_info_t kInfo = hallway::sdk::plugin_info(
        "growth", "Growth", "1", "Hallway", "Tells what it read.", kInputs, kOutputs);
    return &kInfo;
  }

  explicit GrowthPlugin(const hw_host_t* host) : Plugin(host), host_has_grown_(has_grown(host)) {
    parameters().add("first", &first_, 0, 10, "", "The first of two.");
    parameters().add("second_m", &second_, 0.0, 10.0, "m", "The second of two.");
  }

  void activate(const hw_activation_t& activation) override {
    if (first_ == 9) throw std::runtime_error("nine is refused");
    activation_has_grown_ = has_grown(&activation);
#if HW_ABI_MINOR >= 4
    read_robot(activation);
#endif
    for (std::uint32_t i = 0; i < activation.n_sensors; ++i) {
      const hw_sensor_info_t& sensor = *activation.sensors[i];
      sensor_sum_ = 100 * sensor_sum_ + sensor.id;
      last_noise_ = sensor.noise_m[2];
      sensor_has_grown_ = has_grown(&sensor);
#if HW_ABI_MINOR >= 4
      read_intrinsics(sensor);
#endif
#if HW_ABI_MINOR >= 5
      const double rate_hz = hw_rate_hz_of(&sensor);
      if (rate_hz == rate_hz) rate_ = rate_hz + hw_noise_per_m_of(&sensor, 2);
      if (const hw_imu_info_t* imu = hw_imu_info_of(&sensor)) gravity_ = imu->gravity_m_s2;
#endif
    }
  }

  void reset() override {}

  void process(const hw_frame_t& frame) override {
    double sample_sum = 0, x_sum = 0, sample_has_grown = 0, points_have_grown = 0;
    std::vector<std::uint64_t> ids;
    for (std::uint32_t k = 0; k < frame.n_samples; ++k) {
      const hw_sample_t& sample = *frame.samples[k];
      if (sample.kind != HW_SAMPLE_POINTS) {
#if HW_ABI_MINOR >= 5
        read_later_kinds(sample);
#endif
        continue;
      }
      const auto& points = *static_cast<const hw_points_t*>(sample.payload);
      sample_sum = 100 * sample_sum + sample.sensor_id;
      sample_has_grown = has_grown(&sample);
      points_have_grown = has_grown(&points);
#if HW_ABI_MINOR >= 5
      if (hw_point_rings_of(&points) != nullptr && points.count > 0)
        ring_ = hw_point_rings_of(&points)[points.count - 1];
#endif
      ids.assign(points.count, k);
      for (std::uint64_t i = 0; i < points.count; ++i) x_sum += hw_point_at(&points, i)->x;
      host().put_associations(k, ids);
    }
#if HW_ABI_MINOR >= 1
    put_plane();
#endif
#if HW_ABI_MINOR >= 5
    host().put_pose({{x_sum, 0, 0}, { 1, 0, 0, 0 }}, nullptr, frame.t_ns - 1);
#else
    host().put_pose({{x_sum, 0, 0}, {1, 0, 0, 0}});
#endif
#if HW_ABI_MINOR >= 4
    host().put_drive_command(0.5, -x_sum, 0.25);
#else
    host().put_drive_command(0.5, -x_sum);
#endif
#if HW_ABI_MINOR >= 6
    put_topology(frame.t_ns);
#endif
    const hw_counter_t counters[] = {
        {"sensor_sum", sensor_sum_},
        {"last_noise", last_noise_},
        {"sample_sum", sample_sum},
        {"x_sum", x_sum},
        {"first", static_cast<double>(first_)},
        {"second", second_},
        {"speed", speed_},
        {"corner", corner_},
        {"wheel", wheel_},
        {"grown_parts", parts_have_grown_},
        {"rate", rate_},
        {"gravity", gravity_},
        {"ring", ring_},
        {"range", range_},
        {"turn", turn_},
        {"way", way_},
        {"grown_payloads", payloads_have_grown_},
        {"grown_structs", host_has_grown_ + activation_has_grown_ + sensor_has_grown_ + has_grown(&frame) +
                              sample_has_grown + points_have_grown}};
    host().put_counters(counters);
  }

  void report(bool) override {
    host().put_landmarks({{7, {1, 2, 3}, 4, HW_LANDMARK_MAPPED}, {8, {5, 6, 7}, 8, HW_LANDMARK_TEMPORARY}});
#if HW_ABI_MINOR >= 3
    host().put_mapped_planes({{ 9,
                                {0, 0, 1},
                                0,
                                1,
                                HW_LANDMARK_MAPPED,
                                0,
                                3 }},
                             {{{0, 0, 0}, HW_EDGE_CERTAIN, 0},
                              {{1, 0, 0}, 0, 0},
                              { {0, 1, 0},
                                0,
                                0 }});
#endif
    host().put_submaps({{1, {{0, 0, 0}, {1, 0, 0, 0}}, 0, 2}}, {7, 8});
  }

 private:
#if HW_ABI_MINOR >= 4
  void read_robot(const hw_activation_t& activation) {
    if (const hw_drive_info_t* drive = hw_drive_of(&activation)) {
      speed_ = drive->max_speed_m_s;
      parts_have_grown_ += has_grown(drive);
    }
    if (const hw_body_info_t* body = hw_body_of(&activation)) {
      corner_ = hw_body_corner(body, body->n_corners - 1)[1];
      parts_have_grown_ += has_grown(body);
    }
  }

  void read_intrinsics(const hw_sensor_info_t& sensor) {
    const hw_encoder_info_t* encoder = hw_encoder_info_of(&sensor);
    if (encoder == nullptr) return;
    wheel_ = hw_encoder_wheel_at(encoder, encoder->count - 1)->m_per_tick;
    parts_have_grown_ += has_grown(encoder);
  }
#endif
#if HW_ABI_MINOR >= 5
  void read_later_kinds(const hw_sample_t& sample) {
    if (const auto scan = hallway::sdk::range_scan_in(sample)) {
      range_ = (*scan)[scan->size() - 1].range_m;
      payloads_have_grown_ += has_grown(&scan->c_scan());
    }
    if (const hw_imu_t* imu = hallway::sdk::imu_in(sample)) {
      turn_ = imu->angular_rad_s[2];
      payloads_have_grown_ += has_grown(imu);
    }
    if (const hw_odometry_t* odometry = hallway::sdk::odometry_in(sample)) {
      way_ = odometry->T_odom_sensor.position[0] + odometry->covariance[20];
      payloads_have_grown_ += has_grown(odometry);
    }
  }
#endif
#if HW_ABI_MINOR >= 6
  void put_topology(std::int64_t t_ns) const {
    hw_topology_node_t room{};
    room.id = 4;
    room.kind = HW_TOPOLOGY_ROOM;
    room.size_m = std::nan("");
    room.t_ns = t_ns;
    hw_topology_edge_t edge{};
    edge.from = edge.to = 4;
    edge.length_m = 2.5;
    host().put_topology({room}, {edge}, HW_LOOP_CLOSED, "it came back");
    hallway::sdk::Drawing drawing;
    drawing.add_text(HW_COLOUR_WARNING, 1, 2, "here");
    drawing.add_circle(HW_COLOUR_SENSED, 3, 4, 0.5);
    host().put_drawing(drawing);
  }
#endif
#if HW_ABI_MINOR >= 1
  /// Of the first reading's only point.
  void put_plane() const {
    hw_plane_t plane{};
    plane.id = 3;
    plane.normal[0] = -1;
    plane.offset_m = -1;
    plane.centroid[0] = 1;
    for (auto& corner : plane.corners) corner[0] = 1;
    plane.n_points = plane.n_members = 1;
    host().put_planes(0, {plane}, {}, {0});
  }
#endif

  int first_ = 1;
  double second_ = 2;
  double host_has_grown_ = 0, activation_has_grown_ = 0, sensor_has_grown_ = 0;
  double sensor_sum_ = 0, last_noise_ = 0;
  double speed_ = 0, corner_ = 0, wheel_ = 0, parts_have_grown_ = 0;
  double rate_ = 0, gravity_ = 0, ring_ = 0, range_ = 0, turn_ = 0, way_ = 0, payloads_have_grown_ = 0;
};

}  // namespace

HALLWAY_PLUGINS(GrowthPlugin);
