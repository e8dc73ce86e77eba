// SPDX-License-Identifier: MIT
#include "host/output/outputs_bytes.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace hallway::host {
namespace {

enum PoseState : std::uint64_t { kNoPose, kLost, kValid };

/// One output as a plugin hands it over; `payload` has its `size` set.
void put(OutputCollector& collector, std::uint32_t kind, const void* payload) {
  hw_output_t output{};
  output.size = sizeof output;
  output.kind = kind;
  output.payload = payload;
  collector.put(&output);  // finish() tells what was wrong
}

template <typename Payload>
Payload sized() {
  Payload payload{};
  payload.size = sizeof payload;
  return payload;
}

void read_pose(AlignedByteReader& reader, OutputCollector& collector) {
  const auto state = reader.get<std::uint64_t>();
  if (state == kNoPose) return;
  if (state > kValid) throw BadBytes{"a pose of no known state"};
  auto pose = sized<hw_pose_output_t>();
  pose.status = state == kValid ? HW_POSE_VALID : HW_POSE_LOST;
  pose.T_map_body = reader.get<hw_pose_t>();
  pose.t_ns = reader.get<std::int64_t>();
  const auto told = reader.get<std::uint64_t>();
  if (told > 1) throw BadBytes{"more than one covariance"};
  std::array<double, 36> covariance{};
  if (told == 1) {
    covariance = reader.get<std::array<double, 36>>();
    pose.covariance = covariance.data();
  }
  put(collector, HW_OUTPUT_POSE, &pose);
}

void read_drive_command(AlignedByteReader& reader, OutputCollector& collector) {
  const auto commands = reader.get<std::uint64_t>();
  if (commands == 0) return;
  if (commands != 1) throw BadBytes{"more than one drive command"};
  auto command = sized<hw_drive_command_t>();
  command.linear_m_s = reader.get<double>();
  command.angular_rad_s = reader.get<double>();
  command.lateral_m_s = reader.get<double>();
  put(collector, HW_OUTPUT_DRIVE_COMMAND, &command);
}

void read_landmarks(AlignedByteReader& reader, OutputCollector& collector) {
  const auto list = reader.get_list<hw_landmark_t>();
  auto landmarks = sized<hw_landmarks_t>();
  landmarks.stride = sizeof(hw_landmark_t);
  landmarks.count = list.count;
  landmarks.landmarks = list.first;
  const auto covariances = reader.copy_list<LandmarkCovariance>();
  if (!covariances.empty() && covariances.size() != list.count)
    throw BadBytes{"covariances of other landmarks"};
  landmarks.covariances = covariances.empty() ? nullptr : covariances.front().data();
  if (list.count != 0) put(collector, HW_OUTPUT_LANDMARKS, &landmarks);
}

void read_associations(AlignedByteReader& reader, OutputCollector& collector) {
  const std::size_t n = reader.get_count();
  for (std::size_t i = 0; i < n; ++i) {
    auto associations = sized<hw_associations_t>();
    associations.sample = reader.get<std::uint32_t>();
    const auto list = reader.get_list<std::uint64_t>();
    associations.count = list.count;
    associations.landmark_ids = static_cast<const std::uint64_t*>(list.first);
    put(collector, HW_OUTPUT_ASSOCIATIONS, &associations);
  }
}

void read_planes(AlignedByteReader& reader, OutputCollector& collector) {
  const std::size_t n = reader.get_count();
  for (std::size_t i = 0; i < n; ++i) {
    auto planes = sized<hw_planes_t>();
    planes.sample = reader.get<std::uint32_t>();
    planes.stride = sizeof(hw_plane_t);
    planes.hull_stride = sizeof(hw_point3_t);
    const auto list = reader.get_list<hw_plane_t>();
    const auto hull_points = reader.get_list<hw_point3_t>();
    const auto members = reader.get_list<std::uint32_t>();
    planes.count = list.count;
    planes.planes = list.first;
    planes.n_hull_points = hull_points.count;
    planes.hull_points = hull_points.first;
    planes.n_members = members.count;
    planes.members = static_cast<const std::uint32_t*>(members.first);
    put(collector, HW_OUTPUT_PLANES, &planes);
  }
}

void read_plane_landmarks(AlignedByteReader& reader, OutputCollector& collector) {
  const auto list = reader.get_list<hw_mapped_plane_t>();
  const auto corners = reader.get_list<hw_mapped_corner_t>();
  auto planes = sized<hw_mapped_planes_t>();
  planes.stride = sizeof(hw_mapped_plane_t);
  planes.count = list.count;
  planes.planes = list.first;
  planes.corner_stride = sizeof(hw_mapped_corner_t);
  planes.n_corners = corners.count;
  planes.corners = corners.first;
  if (list.count != 0 || corners.count != 0) put(collector, HW_OUTPUT_MAPPED_PLANES, &planes);
}

void read_topology(AlignedByteReader& reader, OutputCollector& collector) {
  const auto topologies = reader.get<std::uint64_t>();
  if (topologies == 0) return;
  if (topologies != 1) throw BadBytes{"more than one topology"};
  auto topology = sized<hw_topology_t>();
  topology.node_stride = sizeof(hw_topology_node_t);
  topology.edge_stride = sizeof(hw_topology_edge_t);
  topology.loop = reader.get<std::uint32_t>();
  const auto nodes = reader.get_list<hw_topology_node_t>();
  const auto edges = reader.get_list<hw_topology_edge_t>();
  const std::string note = reader.get_text();
  topology.n_nodes = nodes.count;
  topology.nodes = nodes.first;
  topology.n_edges = edges.count;
  topology.edges = edges.first;
  topology.note = note.c_str();
  put(collector, HW_OUTPUT_TOPOLOGY, &topology);
}

/// Its texts are copied before they are checked.
void read_drawing(AlignedByteReader& reader, OutputCollector& collector) {
  const auto drawings = reader.get<std::uint64_t>();
  if (drawings == 0) return;
  if (drawings != 1) throw BadBytes{"more than one drawing"};
  auto drawing = sized<hw_drawing_t>();
  drawing.stride = sizeof(hw_drawing_item_t);
  drawing.point_stride = sizeof(hw_drawing_point_t);
  const auto points = reader.get_list<hw_drawing_point_t>();
  drawing.n_points = points.count;
  drawing.points = points.first;
  std::vector<hw_drawing_item_t> items(reader.get_count(sizeof(hw_drawing_item_t)));
  std::vector<std::string> texts(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    items[i] = reader.get<hw_drawing_item_t>();
    texts[i] = reader.get_text();
    items[i].text = texts[i].c_str();
  }
  drawing.count = items.size();
  drawing.items = items.data();
  put(collector, HW_OUTPUT_DRAWING, &drawing);
}

void read_submaps(AlignedByteReader& reader, OutputCollector& collector) {
  const auto list = reader.get_list<hw_submap_t>();
  const auto members = reader.get_list<std::uint64_t>();
  auto submaps = sized<hw_submaps_t>();
  submaps.stride = sizeof(hw_submap_t);
  submaps.count = list.count;
  submaps.submaps = list.first;
  submaps.n_members = members.count;
  submaps.members = static_cast<const std::uint64_t*>(members.first);
  if (list.count != 0 || members.count != 0) put(collector, HW_OUTPUT_SUBMAPS, &submaps);
}

/// Their names are copied before they are checked.
void read_counters(AlignedByteReader& reader, OutputCollector& collector) {
  const std::size_t n = reader.get_count();
  for (std::size_t i = 0; i < n; ++i) {
    const std::string name = reader.get_text();
    const hw_counter_t counter{name.c_str(), reader.get<double>()};
    auto counters = sized<hw_counters_t>();
    counters.stride = sizeof counter;
    counters.count = 1;
    counters.counters = &counter;
    put(collector, HW_OUTPUT_COUNTERS, &counters);
  }
}

void write_associations(AlignedByteWriter& writer, const Outputs& outputs, std::uint32_t n_samples) {
  std::uint64_t n = 0;
  for (std::uint32_t sample = 0; sample < n_samples; ++sample) n += outputs.associations(sample) ? 1u : 0u;
  writer.put(n);
  for (std::uint32_t sample = 0; sample < n_samples; ++sample) {
    const auto ids = outputs.associations(sample);
    if (!ids) continue;
    writer.put(sample);
    writer.put_list(*ids);
  }
}

void write_planes(AlignedByteWriter& writer, const Outputs& outputs, std::uint32_t n_samples) {
  std::uint64_t n = 0;
  for (std::uint32_t sample = 0; sample < n_samples; ++sample) n += outputs.planes(sample) ? 1u : 0u;
  writer.put(n);
  for (std::uint32_t sample = 0; sample < n_samples; ++sample) {
    const auto list = outputs.planes(sample);
    if (!list) continue;
    writer.put(sample);
    writer.put_list(list->planes);
    writer.put_list(list->hull_points);
    writer.put_list(list->members);
  }
}

void write_topology(AlignedByteWriter& writer, const Topology* topology) {
  writer.put<std::uint64_t>(topology != nullptr ? 1u : 0u);
  if (topology == nullptr) return;
  writer.put(topology->loop());
  writer.put_list(topology->nodes());
  writer.put_list(topology->edges());
  writer.put_text(topology->note());
}

void write_drawing(AlignedByteWriter& writer, const Drawing* drawing) {
  writer.put<std::uint64_t>(drawing != nullptr ? 1u : 0u);
  if (drawing == nullptr) return;
  writer.put_list(drawing->points());
  writer.put<std::uint64_t>(drawing->items().size());
  for (const DrawingItem& item : drawing->items()) {
    hw_drawing_item_t bare{};
    bare.kind = item.kind;
    bare.colour = item.colour;
    bare.flags = item.closed ? HW_DRAWING_CLOSED : 0u;
    bare.radius_m = item.radius_m;
    bare.first_point = item.first_point;
    bare.n_points = item.n_points;
    writer.put(bare);
    writer.put_text(item.text);
  }
}

}  // namespace

void write_outputs(AlignedByteWriter& writer, const Outputs& outputs, std::uint32_t n_samples) {
  const std::optional<PoseOutput>& pose = outputs.pose();
  writer.put<std::uint64_t>(!pose ? kNoPose : pose->valid ? kValid : kLost);
  if (pose) {
    writer.put(pose->T_map_body);
    writer.put(pose->t_ns);
    writer.put<std::uint64_t>(pose->covariance ? 1u : 0u);
    if (pose->covariance) writer.put(*pose->covariance);
  }
  const std::optional<DriveCommand>& command = outputs.drive_command();
  writer.put<std::uint64_t>(command ? 1u : 0u);
  if (command) {
    writer.put(command->linear_m_s);
    writer.put(command->angular_rad_s);
    writer.put(command->lateral_m_s);
  }
  writer.put_list(outputs.landmarks());
  writer.put_list(outputs.landmark_covariances());
  write_associations(writer, outputs, n_samples);
  write_planes(writer, outputs, n_samples);
  writer.put_list(outputs.plane_landmarks().planes());
  writer.put_list(outputs.plane_landmarks().corners());
  write_topology(writer, outputs.topology());
  write_drawing(writer, outputs.drawing());
  writer.put_list(outputs.submaps());
  writer.put_list(outputs.all_members());
  writer.put<std::uint64_t>(outputs.counters().size());
  for (const Counter& counter : outputs.counters()) {
    writer.put_text(counter.name);
    writer.put(counter.value);
  }
}

void read_outputs(AlignedByteReader& reader, OutputCollector& collector) {
  read_pose(reader, collector);
  read_drive_command(reader, collector);
  read_landmarks(reader, collector);
  read_associations(reader, collector);
  read_planes(reader, collector);
  read_plane_landmarks(reader, collector);
  read_topology(reader, collector);
  read_drawing(reader, collector);
  read_submaps(reader, collector);
  read_counters(reader, collector);
}

}  // namespace hallway::host
