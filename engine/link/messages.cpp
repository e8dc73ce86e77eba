// SPDX-License-Identifier: MIT
#include "link/messages.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/bytes.hpp"
#include "base/unit_quaternion.hpp"

namespace hallway::link {
namespace {

enum AnswerFlag : std::uint32_t { kHasCommand = 1, kHasPose = 2, kPoseValid = 4, kHasPoseTime = 8 };

/// An answer as it stands in a datagram.
struct AnswerBytes {
  std::uint32_t status = 0;
  std::uint32_t flags = 0;
  std::uint64_t number = 0;
  std::int64_t t_ns = 0;
  double linear_m_s = 0;
  double angular_rad_s = 0;
  std::array<double, 3> position{};
  std::array<double, 4> orientation{1, 0, 0, 0};
  double lateral_m_s = 0;  // reserved before ABI 1.4, and written as 0
};
static_assert(sizeof(AnswerBytes) == 104);

/// The time that the pose of an answer is of; empty where it is none.
std::optional<std::int64_t> pose_time(const Datagram& datagram, const AnswerBytes& bytes) {
  if (datagram.header.version == kFirstVersion || (bytes.flags & kHasPoseTime) == 0) return 0;
  if (datagram.payload.size() < sizeof bytes + sizeof(std::int64_t)) return std::nullopt;
  const auto t_ns = load<std::int64_t>(datagram.payload.data() + sizeof bytes);
  if (t_ns < 0 || t_ns > bytes.t_ns) return std::nullopt;
  return t_ns;
}

}  // namespace

void write_answer(const Answer& answer, Bytes& payload, std::uint8_t version) {
  AnswerBytes bytes;
  bytes.status = answer.status;
  bytes.number = answer.number;
  bytes.t_ns = answer.t_ns;
  if (answer.command) {
    bytes.flags |= kHasCommand;
    bytes.linear_m_s = answer.command->linear_m_s;
    bytes.angular_rad_s = answer.command->angular_rad_s;
    bytes.lateral_m_s = answer.command->lateral_m_s;
  }
  if (answer.pose) bytes.flags |= kHasPose;
  if (answer.pose && answer.pose->valid) {
    bytes.flags |= kPoseValid;
    std::copy_n(answer.pose->T_map_body.position, 3, bytes.position.begin());
    std::copy_n(answer.pose->T_map_body.orientation, 4, bytes.orientation.begin());
  }
  const bool has_pose_time =
      version != kFirstVersion && answer.pose && answer.pose->valid && answer.pose->t_ns != 0;
  if (has_pose_time) bytes.flags |= kHasPoseTime;
  payload.resize(sizeof bytes + (has_pose_time ? sizeof(std::int64_t) : 0));
  store(payload.data(), bytes);
  if (has_pose_time) store(payload.data() + sizeof bytes, answer.pose->t_ns);
}

std::optional<Answer> read_answer(const Datagram& datagram) {
  const std::size_t size = datagram.payload.size();
  if (datagram.header.version == kFirstVersion ? size != sizeof(AnswerBytes) : size < sizeof(AnswerBytes)) {
    return std::nullopt;
  }
  const auto bytes = load<AnswerBytes>(datagram.payload.data());
  const bool sound = bytes.status <= HW_ANSWER_END && std::isfinite(bytes.linear_m_s) &&
                     std::isfinite(bytes.angular_rad_s) && std::isfinite(bytes.lateral_m_s) &&
                     is_pose(bytes.position, bytes.orientation);
  const std::optional<std::int64_t> pose_t_ns = pose_time(datagram, bytes);
  if (!sound || !pose_t_ns) return std::nullopt;
  Answer answer{.number = bytes.number,
                .status = bytes.status,
                .sequence = datagram.header.sequence,
                .t_ns = bytes.t_ns};
  if ((bytes.flags & kHasCommand) != 0)
    answer.command = {bytes.linear_m_s, bytes.angular_rad_s, bytes.lateral_m_s};
  if ((bytes.flags & kHasPose) != 0) {
    answer.pose.emplace();
    answer.pose->valid = (bytes.flags & kPoseValid) != 0;
    if (answer.pose->valid) answer.pose->t_ns = *pose_t_ns;
    std::copy_n(bytes.position.begin(), 3, answer.pose->T_map_body.position);
    std::copy_n(bytes.orientation.begin(), 4, answer.pose->T_map_body.orientation);
  }
  return answer;
}

void write_missing(const std::vector<bool>& missing, Bytes& payload) {
  const auto fragments = static_cast<std::uint16_t>(missing.size());
  payload.resize(sizeof fragments);
  store(payload.data(), fragments);
  if (std::ranges::find(missing, true) == missing.end()) return;
  payload.resize(sizeof fragments + (missing.size() + 7) / 8, std::byte{0});
  for (std::size_t i = 0; i < missing.size(); ++i) {
    if (missing[i]) payload[sizeof fragments + i / 8] |= std::byte{1} << (i % 8);
  }
}

std::optional<std::vector<bool>> read_missing(std::span<const std::byte> payload, std::size_t fragments) {
  if (payload.size() < sizeof(std::uint16_t)) return std::nullopt;
  const auto told = load<std::uint16_t>(payload.data());
  const auto bits = payload.subspan(sizeof told);
  if (told != fragments || (!bits.empty() && bits.size() != (fragments + 7) / 8)) return std::nullopt;
  std::vector<bool> missing(fragments, false);
  for (std::size_t i = 0; i < fragments && !bits.empty(); ++i) {
    missing[i] = (bits[i / 8] >> (i % 8) & std::byte{1}) != std::byte{0};
  }
  return missing;
}

}  // namespace hallway::link
