// SPDX-License-Identifier: MIT
#pragma once

// Turns a C++ class into a plugin. Header only, C++17; nothing of C++ crosses the border: every exception becomes
// a status and a message.
//
//     class Mapper final : public hallway::sdk::Plugin {
//      public:
//       static const hw_plugin_info_t* info();           // see plugin_info()
//       explicit Mapper(const hw_host_t* host) : Plugin(host) {
//         parameters().add("noise_m", &noise_m_, 1e-3, 10.0, "m", "Standard deviation of an observation.");
//       }
//       void reset() override;
//       void process(const hw_frame_t& frame) override;  // host().put_pose(…), host().put_associations(…)
//       void report(bool refine) override;               // host().put_landmarks(…), host().put_submaps(…)
//      private:
//       double noise_m_ = 0.05;
//     };
//     HALLWAY_PLUGINS(Mapper);

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hallway.h"

namespace hallway::sdk {

/// A failure with a status of its own choice; any other exception is given one by guard().
class Failure : public std::runtime_error {
 public:
  Failure(hw_status_t status, const std::string& message) : std::runtime_error(message), status_(status) {}
  hw_status_t status() const noexcept { return status_; }

 private:
  hw_status_t status_;
};

/// Calls `work` and turns what it throws into a status and a message: Failure keeps its status,
/// std::invalid_argument is HW_ERROR_ARGUMENT, std::bad_alloc HW_ERROR_MEMORY, all else HW_ERROR_INTERNAL.
template <typename Work>
hw_status_t guard(hw_error_t* error, Work&& work) noexcept {
  const auto fail = [error](hw_status_t status, const char* message) {
    return hw_error_set(error, status, message && *message ? message : "an exception without a message");
  };
  try {
    work();
    return HW_OK;
  } catch (const Failure& failure) {
    return fail(failure.status() == HW_OK ? HW_ERROR_INTERNAL : failure.status(), failure.what());
  } catch (const std::invalid_argument& exception) {
    return fail(HW_ERROR_ARGUMENT, exception.what());
  } catch (const std::bad_alloc&) {
    return fail(HW_ERROR_MEMORY, "out of memory");
  } catch (const std::exception& exception) {
    return fail(HW_ERROR_INTERNAL, exception.what());
  } catch (...) {
    return fail(HW_ERROR_INTERNAL, "an exception that is no std::exception");
  }
}

/// Lines, circles and texts in the body's frame, for Host::put_drawing(). `colour` is HW_COLOUR_…; metres. clear() keeps the memory.
class Drawing {
 public:
  void clear() {
    items_.clear();
    points_.clear();
    texts_.clear();
  }
  /// Joins two points or more.
  void add_polyline(std::uint32_t colour, const std::vector<hw_drawing_point_t>& points,
                    bool closed = false) {
    hw_drawing_item_t& item = add(HW_DRAWING_POLYLINE, colour, points.size());
    if (closed) item.flags = HW_DRAWING_CLOSED;
    points_.insert(points_.end(), points.begin(), points.end());
  }
  /// @param radius_m  above 0
  void add_circle(std::uint32_t colour, double x_m, double y_m, double radius_m) {
    add(HW_DRAWING_CIRCLE, colour, 1).radius_m = radius_m;
    points_.push_back({x_m, y_m});
  }
  /// @param text  UTF-8, not empty
  void add_text(std::uint32_t colour, double x_m, double y_m, const std::string& text) {
    add(HW_DRAWING_TEXT, colour, 1);
    points_.push_back({x_m, y_m});
    texts_.emplace_back(items_.size() - 1, text);
  }

  /// Its items in the C form; valid until the next change.
  const std::vector<hw_drawing_item_t>& items() {
    for (const auto& [item, text] : texts_) items_[item].text = text.c_str();
    return items_;
  }
  const std::vector<hw_drawing_point_t>& points() const { return points_; }

 private:
  hw_drawing_item_t& add(std::uint32_t kind, std::uint32_t colour, std::size_t n_points) {
    hw_drawing_item_t& item = items_.emplace_back();
    item.kind = kind;
    item.colour = colour;
    item.first_point = points_.size();
    item.n_points = n_points;
    return item;
  }

  std::vector<hw_drawing_item_t> items_;
  std::vector<hw_drawing_point_t> points_;
  std::vector<std::pair<std::size_t, std::string>> texts_;  ///< number of the item, its text
};

/// The host, seen from the plugin. The put functions throw Failure if the host refuses; use them in process()
/// and report().
class Host {
 public:
  explicit Host(const hw_host_t* host)
      : host_(host),
        log_(static_cast<const hw_log_t*>(host->vtable->get_extension(host->self, HW_EXT_LOG))) {}

  /// The C form.
  const hw_host_t& c_host() const { return *host_; }

  /// Answers where the body is: T_map_body. @param covariance  36 numbers as hw_pose_output_t says; null: not told
  /// @param t_ns  the time that the pose is of, not later than the frame's; 0: the frame's
  void put_pose(const hw_pose_t& T_map_body, const double* covariance = nullptr,
                std::int64_t t_ns = 0) const {
    hw_pose_output_t payload{};
    payload.status = HW_POSE_VALID;
    payload.T_map_body = T_map_body;
    payload.covariance = covariance;
    payload.t_ns = t_ns;
    put(HW_OUTPUT_POSE, payload);
  }

  /// Answers that this frame does not determine the pose.
  void put_lost() const {
    hw_pose_output_t payload{};
    payload.status = HW_POSE_LOST;
    payload.T_map_body.orientation[0] = 1.0;
    put(HW_OUTPUT_POSE, payload);
  }

  /// Answers, for each element of sample `sample` of the frame, which landmark it was taken for.
  void put_associations(std::uint32_t sample, const std::vector<std::uint64_t>& landmark_ids) const {
    hw_associations_t payload{};
    payload.sample = sample;
    payload.count = landmark_ids.size();
    payload.landmark_ids = landmark_ids.data();
    put(HW_OUTPUT_ASSOCIATIONS, payload);
  }

  /// Answers the landmarks of the map. @param covariances  6 numbers for each, as hw_landmarks_t says; null: not told
  void put_landmarks(const std::vector<hw_landmark_t>& landmarks, const double* covariances = nullptr) const {
    hw_landmarks_t payload{};
    payload.stride = sizeof(hw_landmark_t);
    payload.count = landmarks.size();
    payload.landmarks = landmarks.data();
    payload.covariances = covariances;
    put(HW_OUTPUT_LANDMARKS, payload);
  }

  /// Answers the submaps, whose members are ranges of `members`.
  void put_submaps(const std::vector<hw_submap_t>& submaps, const std::vector<std::uint64_t>& members) const {
    hw_submaps_t payload{};
    payload.stride = sizeof(hw_submap_t);
    payload.count = submaps.size();
    payload.submaps = submaps.data();
    payload.n_members = members.size();
    payload.members = members.data();
    put(HW_OUTPUT_SUBMAPS, payload);
  }

  /// Answers the planes of the map; their outlines are ranges of `corners`.
  void put_mapped_planes(const std::vector<hw_mapped_plane_t>& planes,
                         const std::vector<hw_mapped_corner_t>& corners) const {
    hw_mapped_planes_t payload{};
    payload.stride = sizeof(hw_mapped_plane_t);
    payload.count = planes.size();
    payload.planes = planes.data();
    payload.corner_stride = sizeof(hw_mapped_corner_t);
    payload.n_corners = corners.size();
    payload.corners = corners.data();
    put(HW_OUTPUT_MAPPED_PLANES, payload);
  }

  /// Answers the planes found in sample `sample` of the frame; their hulls are ranges of `hull_points`, their points
  /// ranges of `members`.
  void put_planes(std::uint32_t sample, const std::vector<hw_plane_t>& planes,
                  const std::vector<hw_point3_t>& hull_points,
                  const std::vector<std::uint32_t>& members) const {
    hw_planes_t payload{};
    payload.stride = sizeof(hw_plane_t);
    payload.count = planes.size();
    payload.planes = planes.data();
    payload.sample = sample;
    payload.hull_stride = sizeof(hw_point3_t);
    payload.n_hull_points = hull_points.size();
    payload.hull_points = hull_points.data();
    payload.n_members = members.size();
    payload.members = members.data();
    put(HW_OUTPUT_PLANES, payload);
  }

  /// Answers how the robot shall move from now on: forward, to the left about its vertical axis, and sideways to the left.
  void put_drive_command(double linear_m_s, double angular_rad_s, double lateral_m_s = 0.0) const {
    hw_drive_command_t payload{};
    payload.linear_m_s = linear_m_s;
    payload.angular_rad_s = angular_rad_s;
    payload.lateral_m_s = lateral_m_s;
    put(HW_OUTPUT_DRIVE_COMMAND, payload);
  }

  /// Answers the whole topological map as it is now. `loop` is HW_LOOP_…. @param note  why the loop is so; UTF-8
  void put_topology(const std::vector<hw_topology_node_t>& nodes,
                    const std::vector<hw_topology_edge_t>& edges, std::uint32_t loop = HW_LOOP_OPEN,
                    const std::string& note = {}) const {
    hw_topology_t payload{};
    payload.loop = loop;
    payload.node_stride = sizeof(hw_topology_node_t);
    payload.edge_stride = sizeof(hw_topology_edge_t);
    payload.n_nodes = nodes.size();
    payload.nodes = nodes.data();
    payload.n_edges = edges.size();
    payload.edges = edges.data();
    payload.note = note.c_str();
    put(HW_OUTPUT_TOPOLOGY, payload);
  }

  /// Answers what to show at this frame, in process().
  void put_drawing(Drawing& drawing) const {
    const std::vector<hw_drawing_item_t>& items = drawing.items();
    hw_drawing_t payload{};
    payload.stride = sizeof(hw_drawing_item_t);
    payload.count = items.size();
    payload.items = items.data();
    payload.point_stride = sizeof(hw_drawing_point_t);
    payload.n_points = drawing.points().size();
    payload.points = drawing.points().data();
    put(HW_OUTPUT_DRAWING, payload);
  }

  /// Answers numbers worth watching.
  template <std::size_t N>
  void put_counters(const hw_counter_t (&counters)[N]) const {
    put_counters(counters, N);
  }

  /// Answers, in process(), which connected part of the map the pose is in; see HW_COUNTER_MAP_EPOCH.
  void put_map_epoch(std::uint64_t epoch) const {
    const hw_counter_t counter[] = {{HW_COUNTER_MAP_EPOCH, static_cast<double>(epoch)}};
    put_counters(counter);
  }

  /// Answers, in report(), that the poses answered under `epoch` belong to the part `into`; see HW_COUNTER_MAP_EPOCH.
  void put_joined_epoch(std::uint64_t epoch, std::uint64_t into) const {
    const std::string name = HW_COUNTER_MAP_EPOCH "_" + std::to_string(epoch);
    const hw_counter_t counter[] = {{name.c_str(), static_cast<double>(into)}};
    put_counters(counter);
  }

  /// Tells a person something; does nothing where the host keeps no log. `level` is HW_LOG_….
  void log(std::uint32_t level, const std::string& message) const {
    if (log_) log_->write(host_->self, level, message.c_str());
  }

 private:
  template <typename Payload>
  void put(std::uint32_t kind, Payload& payload) const {
    payload.size = sizeof(Payload);
    hw_output_t output{};
    output.size = sizeof output;
    output.kind = kind;
    output.payload = &payload;
    const hw_status_t status = host_->vtable->put(host_->self, &output);
    if (status != HW_OK) {
      throw Failure(status, std::string("the host refused an output: ") + hw_status_name(status));
    }
  }

  void put_counters(const hw_counter_t* counters, std::size_t count) const {
    hw_counters_t payload{};
    payload.stride = sizeof(hw_counter_t);
    payload.count = count;
    payload.counters = counters;
    put(HW_OUTPUT_COUNTERS, payload);
  }

  const hw_host_t* host_;
  const hw_log_t* log_;
};

/// The largest known standard deviation of a sensor along an axis, metres; NaN where none is known.
inline double largest_noise_m(const hw_sensor_info_t& sensor) {
  double largest = std::nan("");
  for (const double noise : sensor.noise_m) {
    if (std::isfinite(noise) && !(noise <= largest)) largest = noise;
  }
  return largest;
}

/// A body's outline and heights, kept beyond the activation; see hw_body_info_t.
struct Body {
  std::vector<std::array<double, 2>> corners;  ///< x and y, counter-clockwise; empty for a circle
  double radius_m = std::nan("");
  double bottom_m = std::nan("");
  double top_m = std::nan("");
};

/// A contact zone, kept beyond the activation; see hw_bump_zone_info_t.
struct BumpZone {
  std::string name;
  double middle_rad = std::nan("");
  double width_rad = std::nan("");
  double bottom_m = std::nan("");
  double top_m = std::nan("");
};

/// A copy of what is known of the robot's drive, for use after activate(); nothing where it is not known.
inline std::optional<hw_drive_info_t> copy_drive(const hw_activation_t& activation) {
  const hw_drive_info_t* drive = hw_drive_of(&activation);
  if (drive == nullptr) return std::nullopt;
  hw_drive_info_t copy = *drive;
  copy.size = sizeof copy;
  return copy;
}

/// Likewise of its body.
inline std::optional<Body> copy_body(const hw_activation_t& activation) {
  const hw_body_info_t* body = hw_body_of(&activation);
  if (body == nullptr) return std::nullopt;
  Body copy{{}, body->radius_m, body->bottom_m, body->top_m};
  for (std::uint32_t i = 0; i < body->n_corners; ++i) {
    const double* corner = hw_body_corner(body, i);
    copy.corners.push_back({corner[0], corner[1]});
  }
  return copy;
}

/// What is known of the wheels of a sensor of HW_SAMPLE_ENCODER, in the order of its readings; empty where nothing is.
inline std::vector<hw_encoder_wheel_t> copy_wheels(const hw_sensor_info_t& sensor) {
  std::vector<hw_encoder_wheel_t> wheels;
  const hw_encoder_info_t* encoder = hw_encoder_info_of(&sensor);
  for (std::uint64_t i = 0; encoder != nullptr && i < encoder->count; ++i)
    wheels.push_back(*hw_encoder_wheel_at(encoder, i));
  return wheels;
}

/// What is known of the zones of a sensor of HW_SAMPLE_BUMP, by their numbers; empty where nothing is.
inline std::vector<BumpZone> copy_bump_zones(const hw_sensor_info_t& sensor) {
  std::vector<BumpZone> zones;
  const hw_bump_info_t* bump = hw_bump_info_of(&sensor);
  for (std::uint64_t i = 0; bump != nullptr && i < bump->count; ++i) {
    const hw_bump_zone_info_t& zone = *hw_bump_zone_info_at(bump, i);
    zones.push_back({zone.name, zone.middle_rad, zone.width_rad, zone.bottom_m, zone.top_m});
  }
  return zones;
}

/// What is known of the scans of a sensor of HW_SAMPLE_RANGE_SCAN, for use after activate(); nothing where nothing is.
inline std::optional<hw_range_scan_info_t> copy_range_scan_info(const hw_sensor_info_t& sensor) {
  const hw_range_scan_info_t* scan = hw_range_scan_info_of(&sensor);
  if (scan == nullptr) return std::nullopt;
  hw_range_scan_info_t copy = *scan;
  copy.size = sizeof copy;
  return copy;
}

/// Likewise of the noise and limits of a sensor of HW_SAMPLE_IMU.
inline std::optional<hw_imu_info_t> copy_imu_info(const hw_sensor_info_t& sensor) {
  const hw_imu_info_t* imu = hw_imu_info_of(&sensor);
  if (imu == nullptr) return std::nullopt;
  hw_imu_info_t copy = *imu;
  copy.size = sizeof copy;
  return copy;
}

/// Likewise of where on Earth the frame of a sensor of HW_SAMPLE_GNSS is.
inline std::optional<hw_gnss_info_t> copy_gnss_info(const hw_sensor_info_t& sensor) {
  const hw_gnss_info_t* gnss = hw_gnss_info_of(&sensor);
  if (gnss == nullptr) return std::nullopt;
  hw_gnss_info_t copy = *gnss;
  copy.size = sizeof copy;
  return copy;
}

/// The rays of a sample of HW_SAMPLE_RANGE_SCAN; refers to the sample.
class RangeScan {
 public:
  explicit RangeScan(const hw_sample_t& sample)
      : sample_(&sample), scan_(static_cast<const hw_range_scan_t*>(sample.payload)) {}

  /// The C form.
  const hw_range_scan_t& c_scan() const { return *scan_; }
  /// Number of rays, in all layers.
  std::size_t size() const { return scan_->count; }
  const hw_ray_t& operator[](std::size_t i) const { return *hw_ray_at(scan_, i); }

  /// Whether its rays stand in rows and columns.
  bool is_organised() const { return scan_->width != 0; }
  std::uint32_t width() const { return scan_->width; }
  std::uint32_t height() const { return scan_->height; }
  std::uint32_t layers() const { return scan_->layers; }
  /// Index of a ray of an organised scan.
  std::size_t at(std::uint32_t row, std::uint32_t column, std::uint32_t layer = 0) const {
    return (std::size_t{layer} * scan_->height + row) * scan_->width + column;
  }

  /// What ray `i` met, sensor frame, metres; nothing where it met nothing or gave no answer.
  std::optional<hw_point3_t> point(std::size_t i) const {
    const hw_ray_t& ray = (*this)[i];
    if (!hw_ray_has_return(&ray)) return std::nullopt;
    return hw_ray_point(&ray);
  }
  /// When ray `i` was measured; the begin of the sample where it is not told.
  std::int64_t time_ns(std::size_t i) const { return hw_ray_time_ns(sample_, scan_, i); }
  /// Strength of the return of ray `i`; NaN where it is not told or there is none.
  float intensity(std::size_t i) const {
    return scan_->intensity != nullptr ? scan_->intensity[i] : std::nanf("");
  }
  /// Number of the ring that measured ray `i`; nothing where it is not told.
  std::optional<std::uint32_t> ring(std::size_t i) const {
    if (scan_->ring == nullptr) return std::nullopt;
    return scan_->ring[i];
  }

 private:
  const hw_sample_t* sample_;
  const hw_range_scan_t* scan_;
};

/// The scan that a sample is; nothing where it is of another kind. Refers to the sample.
inline std::optional<RangeScan> range_scan_in(const hw_sample_t& sample) {
  if (sample.kind != HW_SAMPLE_RANGE_SCAN) return std::nullopt;
  return RangeScan(sample);
}

/// The odometry that a sample is; null where it is of another kind.
inline const hw_odometry_t* odometry_in(const hw_sample_t& sample) {
  return sample.kind == HW_SAMPLE_ODOMETRY ? static_cast<const hw_odometry_t*>(sample.payload) : nullptr;
}

/// The reading of an IMU that a sample is; null where it is of another kind.
inline const hw_imu_t* imu_in(const hw_sample_t& sample) {
  return sample.kind == HW_SAMPLE_IMU ? static_cast<const hw_imu_t*>(sample.payload) : nullptr;
}

/// The position that a sample is; null where it is of another kind.
inline const hw_gnss_t* gnss_in(const hw_sample_t& sample) {
  return sample.kind == HW_SAMPLE_GNSS ? static_cast<const hw_gnss_t*>(sample.payload) : nullptr;
}

/// The heading that a sample is; null where it is of another kind.
inline const hw_magnetic_t* magnetic_in(const hw_sample_t& sample) {
  return sample.kind == HW_SAMPLE_MAGNETIC ? static_cast<const hw_magnetic_t*>(sample.payload) : nullptr;
}

/// What a plugin does with the file or folder that a parameter names.
enum class Access { kRead, kWrite };

/// The parameters of a plugin: variables of it that the host may set before activation. Their values when
/// they are added are the defaults.
class Parameters {
 public:
  Parameters() = default;
  Parameters(const Parameters&) = delete;
  Parameters& operator=(const Parameters&) = delete;

  /// Declares a number. `name` ends with the unit where it has one.
  void add(const char* name, double* variable, double minimum, double maximum, const char* unit,
           const char* help) {
    Row& row = add_row(name, variable, HW_PARAM_DOUBLE, unit, help);
    row.info.minimum = real_value(minimum);
    row.info.maximum = real_value(maximum);
  }
  /// Declares a whole number.
  void add(const char* name, int* variable, int minimum, int maximum, const char* unit, const char* help) {
    Row& row = add_row(name, variable, HW_PARAM_INT, unit, help);
    row.info.minimum = whole_value(HW_PARAM_INT, minimum);
    row.info.maximum = whole_value(HW_PARAM_INT, maximum);
  }
  /// Declares a switch.
  void add(const char* name, bool* variable, const char* help) {
    Row& row = add_row(name, variable, HW_PARAM_BOOL, "", help);
    row.info.maximum.as.integer = 1;
  }
  /// Declares a choice; `variable` is an index into `choices`, which must live as long as the plugin.
  template <std::size_t N>
  void add_choice(const char* name, int* variable, const char* const (&choices)[N], const char* help) {
    Row& row = add_row(name, variable, HW_PARAM_CHOICE, "", help);
    row.info.maximum.as.integer = static_cast<std::int64_t>(N) - 1;
    row.info.choices = choices;
    row.info.n_choices = static_cast<std::uint32_t>(N);
  }

  /// Declares a text.
  void add_text(const char* name, std::string* variable, const char* help) {
    add_text_row(name, variable, HW_PARAM_TEXT, Access::kRead, help);
  }
  /// Declares the path of a file, absolute; empty: none. With Access::kWrite the plugin may write to it, also where it is isolated.
  void add_file(const char* name, std::string* variable, Access access, const char* help) {
    add_text_row(name, variable, HW_PARAM_FILE, access, help);
  }
  /// Declares the path of a folder, likewise.
  void add_folder(const char* name, std::string* variable, Access access, const char* help) {
    add_text_row(name, variable, HW_PARAM_FOLDER, access, help);
  }

  /// In activate(): gives the number `name`, unless the host has set it, the value that a sensor's description has, at most
  /// its maximum and at least its minimum, until the plugin is deactivated. NaN leaves the default. Throws std::logic_error
  /// where there is no such number.
  /// @return whether it was taken
  bool take_from_sensor(const char* name, double value) {
    for (Row& row : rows_) {
      double* const* real = row.name == name ? std::get_if<double*>(&row.variable) : nullptr;
      if (real == nullptr) continue;
      if (row.origin == HW_PARAM_FROM_HOST || std::isnan(value)) return false;
      **real = std::fmin(std::fmax(value, row.info.minimum.as.real), row.info.maximum.as.real);
      row.origin = HW_PARAM_FROM_SENSOR;
      return true;
    }
    throw std::logic_error(std::string("take_from_sensor: no number is called ") + name);
  }

  /// Number of parameters.
  std::uint32_t count() const { return static_cast<std::uint32_t>(rows_.size()); }
  /// What parameter `index` is; null if there is none.
  const hw_param_info_t* describe(std::uint32_t index) const {
    return index < rows_.size() ? &rows_[index].info : nullptr;
  }
  /// The value of parameter `index`. Throws Failure.
  hw_param_value_t get(std::uint32_t index) const { return read(at(index)); }
  /// Sets parameter `index`. Throws Failure; the old value then stays.
  void set(std::uint32_t index, const hw_param_value_t& value) {
    Row& row = at(index);
    if (value.type != row.info.type || row.is_text())
      throw Failure(HW_ERROR_ARGUMENT, row.name + ": a value of another type");
    const bool allowed =
        row.info.type == HW_PARAM_DOUBLE
            ? value.as.real >= row.info.minimum.as.real && value.as.real <= row.info.maximum.as.real
            : value.as.integer >= row.info.minimum.as.integer &&
                  value.as.integer <= row.info.maximum.as.integer;
    if (!allowed) throw Failure(HW_ERROR_RANGE, row.name + ": outside of its range");
    if (double* const* real = std::get_if<double*>(&row.variable)) **real = value.as.real;
    if (int* const* whole = std::get_if<int*>(&row.variable)) **whole = static_cast<int>(value.as.integer);
    if (bool* const* flag = std::get_if<bool*>(&row.variable)) **flag = value.as.integer != 0;
    row.origin = HW_PARAM_FROM_HOST;
  }
  /// The value of parameter `index`, of a text type. Throws Failure.
  const char* get_text(std::uint32_t index) { return text_at(index).c_str(); }
  /// Sets parameter `index`, of a text type. Throws Failure; the old value then stays.
  void set_text(std::uint32_t index, const char* text) {
    std::string& variable = text_at(index);
    if (std::strlen(text) >= HW_PARAM_TEXT_BYTES)
      throw Failure(HW_ERROR_RANGE, at(index).name + ": too long");
    variable = text;
    at(index).origin = HW_PARAM_FROM_HOST;
  }
  /// Where the value of parameter `index` comes from, HW_PARAM_FROM_….
  std::uint32_t origin(std::uint32_t index) const {
    return index < rows_.size() ? rows_[index].origin : std::uint32_t{HW_PARAM_FROM_DEFAULT};
  }

 private:
  friend struct Border;
  using Variable = std::variant<double*, int*, bool*, std::string*>;
  struct Row {
    std::string name, unit, help;
    Variable variable;
    hw_param_info_t info{};
    std::string default_text{};
    std::uint32_t origin = HW_PARAM_FROM_DEFAULT;

    bool is_text() const { return std::holds_alternative<std::string*>(variable); }
  };

  /// Takes back what take_from_sensor() gave.
  void forget_sensors() {
    for (Row& row : rows_) {
      if (row.origin != HW_PARAM_FROM_SENSOR) continue;
      *std::get<double*>(row.variable) = row.info.default_value.as.real;
      row.origin = HW_PARAM_FROM_DEFAULT;
    }
  }

  static hw_param_value_t real_value(double value) {
    hw_param_value_t result{};
    result.type = HW_PARAM_DOUBLE;
    result.as.real = value;
    return result;
  }
  static hw_param_value_t whole_value(std::uint32_t type, std::int64_t value) {
    hw_param_value_t result{};
    result.type = type;
    result.as.integer = value;
    return result;
  }
  static hw_param_value_t read(const Row& row) {
    if (double* const* real = std::get_if<double*>(&row.variable)) return real_value(**real);
    if (int* const* whole = std::get_if<int*>(&row.variable)) return whole_value(row.info.type, **whole);
    bool* const* flag = std::get_if<bool*>(&row.variable);
    return whole_value(row.info.type, flag && **flag ? 1 : 0);
  }
  const Row& at(std::uint32_t index) const {
    if (index >= rows_.size()) throw Failure(HW_ERROR_NOT_FOUND, "no parameter has that index");
    return rows_[index];
  }
  Row& at(std::uint32_t index) { return const_cast<Row&>(std::as_const(*this).at(index)); }
  std::string& text_at(std::uint32_t index) {
    Row& row = at(index);
    if (!row.is_text()) throw Failure(HW_ERROR_ARGUMENT, row.name + ": is no text");
    return *std::get<std::string*>(row.variable);
  }
  void add_text_row(const char* name, std::string* variable, std::uint32_t type, Access access,
                    const char* help) {
    Row& row = add_row(name, variable, type, "", help);
    row.default_text = *variable;
    row.info.default_text = row.default_text.c_str();
    if (access == Access::kWrite) row.info.flags = HW_PARAM_WRITABLE;
  }
  Row& add_row(const char* name, Variable variable, std::uint32_t type, const char* unit, const char* help) {
    rows_.push_back(Row{name, unit, help, variable, {}, {}, HW_PARAM_FROM_DEFAULT});
    Row& row = rows_.back();
    row.info.size = sizeof(hw_param_info_t);
    row.info.type = type;
    row.info.name = row.name.c_str();
    row.info.unit = row.unit.c_str();
    row.info.help = row.help.c_str();
    row.info.default_value = read(row);
    row.info.minimum = row.info.maximum = whole_value(type, 0);
    return row;
  }

  std::deque<Row> rows_;  ///< rows keep their addresses, which `info` and the host point to
};

/// What a plugin is, for Plugin::info(). Everything given must live as long as the library: literals and
/// static arrays.
template <std::size_t N, std::size_t M>
constexpr hw_plugin_info_t plugin_info(const char* id, const char* name, const char* version,
                                       const char* vendor, const char* description,
                                       const std::uint32_t (&inputs)[N], const std::uint32_t (&outputs)[M]) {
  hw_plugin_info_t info{};
  info.size = sizeof info;
  info.id = id;
  info.name = name;
  info.version = version;
  info.vendor = vendor;
  info.description = description;
  info.inputs = inputs;
  info.n_inputs = static_cast<std::uint32_t>(N);
  info.outputs = outputs;
  info.n_outputs = static_cast<std::uint32_t>(M);
  return info;
}

/// The same of a plugin that also takes samples of the kinds `optional_inputs`, where there are any.
template <std::size_t N, std::size_t M, std::size_t K>
constexpr hw_plugin_info_t plugin_info(const char* id, const char* name, const char* version,
                                       const char* vendor, const char* description,
                                       const std::uint32_t (&inputs)[N], const std::uint32_t (&outputs)[M],
                                       const std::uint32_t (&optional_inputs)[K]) {
  hw_plugin_info_t info = plugin_info(id, name, version, vendor, description, inputs, outputs);
  info.optional_inputs = optional_inputs;
  info.n_optional_inputs = static_cast<std::uint32_t>(K);
  return info;
}

/// Base of a plugin's class. A derived class has, besides, a constructor from `const hw_host_t*` and
/// `static const hw_plugin_info_t* info()`. What these functions throw reaches the host as a status and a
/// message.
class Plugin {
 public:
  virtual ~Plugin() = default;
  Plugin(const Plugin&) = delete;
  Plugin& operator=(const Plugin&) = delete;

  /// Makes ready for frames; the parameters stand.
  virtual void activate(const hw_activation_t&) {}
  /// Ends what activate() began. Must not throw.
  virtual void deactivate() {}
  /// Forgets the map.
  virtual void reset() = 0;
  /// Takes a frame and puts the answers to it.
  virtual void process(const hw_frame_t& frame) = 0;
  /// Puts the map, as it stands or refined.
  virtual void report(bool refine) = 0;
  /// A further extension of the plugin, or null.
  virtual const void* get_extension(const char*) { return nullptr; }

 protected:
  explicit Plugin(const hw_host_t* host) : host_(host) {}
  const Host& host() const { return host_; }
  Parameters& parameters() { return parameters_; }

 private:
  friend struct Border;
  Host host_;
  Parameters parameters_;
  bool active_ = false;
};

/// The C functions in front of a Plugin: no exception passes, and calls out of order are refused.
struct Border {
  static Plugin& plugin(void* self) { return *static_cast<Plugin*>(self); }

  static void demand(bool condition, hw_status_t status, const char* message) {
    if (!condition) throw Failure(status, message);
  }

  static hw_status_t activate(void* self, const hw_activation_t* activation, hw_error_t* error) noexcept {
    return guard(error, [&] {
      demand(activation != nullptr, HW_ERROR_ARGUMENT, "activate: the activation is null");
      demand(!plugin(self).active_, HW_ERROR_STATE, "activate: the plugin is active");
      try {
        plugin(self).activate(*activation);
      } catch (...) {
        plugin(self).parameters_.forget_sensors();
        throw;
      }
      plugin(self).active_ = true;
    });
  }

  static void deactivate(void* self) noexcept {
    guard(nullptr, [&] {
      if (!std::exchange(plugin(self).active_, false)) return;
      plugin(self).deactivate();
      plugin(self).parameters_.forget_sensors();
    });
  }

  static hw_status_t reset(void* self, hw_error_t* error) noexcept {
    return guard(error, [&] {
      demand(plugin(self).active_, HW_ERROR_STATE, "reset: the plugin is not active");
      plugin(self).reset();
    });
  }

  static hw_status_t process(void* self, const hw_frame_t* frame, hw_error_t* error) noexcept {
    return guard(error, [&] {
      demand(frame != nullptr, HW_ERROR_ARGUMENT, "process: the frame is null");
      demand(plugin(self).active_, HW_ERROR_STATE, "process: the plugin is not active");
      plugin(self).process(*frame);
    });
  }

  static hw_status_t report(void* self, const hw_report_request_t* request, hw_error_t* error) noexcept {
    return guard(error, [&] {
      demand(request != nullptr, HW_ERROR_ARGUMENT, "report: the request is null");
      demand(plugin(self).active_, HW_ERROR_STATE, "report: the plugin is not active");
      plugin(self).report((request->flags & HW_REPORT_REFINE) != 0);
    });
  }

  static const void* get_extension(void* self, const char* id) noexcept {
    const void* extension = nullptr;
    guard(nullptr, [&] {
      if (!id) return;
      if (std::strcmp(id, HW_EXT_PARAMS) == 0) {
        extension = &kParams;
      } else if (std::strcmp(id, HW_EXT_PARAMS_2) == 0) {
        extension = &kParams2;
      } else {
        extension = plugin(self).get_extension(id);
      }
    });
    return extension;
  }

  static void destroy(void* self) noexcept { delete &plugin(self); }

  static std::uint32_t params_count(void* self) noexcept { return plugin(self).parameters_.count(); }

  static const hw_param_info_t* params_describe(void* self, std::uint32_t index) noexcept {
    return plugin(self).parameters_.describe(index);
  }

  static hw_status_t params_get(void* self, std::uint32_t index, hw_param_value_t* value,
                                hw_error_t* error) noexcept {
    return guard(error, [&] {
      demand(value != nullptr, HW_ERROR_ARGUMENT, "get: the value is null");
      *value = plugin(self).parameters_.get(index);
    });
  }

  static hw_status_t params_set(void* self, std::uint32_t index, const hw_param_value_t* value,
                                hw_error_t* error) noexcept {
    return guard(error, [&] {
      demand(value != nullptr, HW_ERROR_ARGUMENT, "set: the value is null");
      demand(!plugin(self).active_, HW_ERROR_STATE, "set: the plugin is active");
      plugin(self).parameters_.set(index, *value);
    });
  }

  static hw_status_t params_get_text(void* self, std::uint32_t index, const char** text,
                                     hw_error_t* error) noexcept {
    return guard(error, [&] {
      demand(text != nullptr, HW_ERROR_ARGUMENT, "get_text: the text is null");
      *text = plugin(self).parameters_.get_text(index);
    });
  }

  static hw_status_t params_set_text(void* self, std::uint32_t index, const char* text,
                                     hw_error_t* error) noexcept {
    return guard(error, [&] {
      demand(text != nullptr, HW_ERROR_ARGUMENT, "set_text: the text is null");
      demand(!plugin(self).active_, HW_ERROR_STATE, "set_text: the plugin is active");
      plugin(self).parameters_.set_text(index, text);
    });
  }

  static std::uint32_t params_origin(void* self, std::uint32_t index) noexcept {
    return plugin(self).parameters_.origin(index);
  }

  static constexpr hw_params_t kParams{&params_count, &params_describe, &params_get, &params_set};
  static constexpr hw_params_2_t kParams2{&params_get_text, &params_set_text, &params_origin};
  static constexpr hw_plugin_vtable_t kVtable{&activate, &deactivate,    &reset,  &process,
                                              &report,   &get_extension, &destroy};
};

/// The factory and entry of a library whose plugins are the classes `Plugins`.
template <typename... Plugins>
struct Factory {
  struct Row {
    const hw_plugin_info_t* (*info)();
    std::unique_ptr<Plugin> (*make)(const hw_host_t* host);
  };
  template <typename Class>
  static std::unique_ptr<Plugin> make(const hw_host_t* host) {
    return std::make_unique<Class>(host);
  }
  static constexpr Row kRows[] = {{&Plugins::info, &make<Plugins>}...};

  static std::uint32_t count() noexcept { return static_cast<std::uint32_t>(sizeof...(Plugins)); }

  static const hw_plugin_info_t* describe(std::uint32_t index) noexcept {
    const hw_plugin_info_t* info = nullptr;
    guard(nullptr, [&] { info = index < count() ? kRows[index].info() : nullptr; });
    return info;
  }

  static hw_status_t create(const hw_host_t* host, const char* id, hw_plugin_t* plugin,
                            hw_error_t* error) noexcept {
    return guard(error, [&] {
      Border::demand(host && id && plugin, HW_ERROR_ARGUMENT, "create: an argument is null");
      const Row* row = kRows;
      while (row != kRows + count() && std::strcmp(id, row->info()->id) != 0) ++row;
      Border::demand(row != kRows + count(), HW_ERROR_NOT_FOUND,
                     "create: no plugin of this library has that id");
      plugin->self = row->make(host).release();
      plugin->vtable = &Border::kVtable;
    });
  }

  static hw_status_t init(const char*, hw_error_t*) noexcept { return HW_OK; }
  static void deinit() noexcept {}

  static const void* get_factory(const char* id) noexcept {
    return id && std::strcmp(id, HW_PLUGIN_FACTORY_ID) == 0 ? &kFactory : nullptr;
  }

  static constexpr hw_plugin_factory_t kFactory{&count, &describe, &create};
  static constexpr hw_entry_t kEntry{{HW_ABI_MAJOR, HW_ABI_MINOR}, &init, &deinit, &get_factory};
};

}  // namespace hallway::sdk

/// Defines the exported symbol of a library whose plugins are the given classes. Once per library, outside of
/// namespaces.
#define HALLWAY_PLUGINS(...) \
  extern "C" HW_EXPORT constexpr hw_entry_t hw_entry = ::hallway::sdk::Factory<__VA_ARGS__>::kEntry
