// SPDX-License-Identifier: MIT
#include "link/messages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace hallway::link {
namespace {

constexpr double kQuaternionTolerance = 1e-6;

enum AnswerFlag : std::uint32_t { kHasCommand = 1, kHasPose = 2, kPoseValid = 4 };

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
  std::uint64_t reserved = 0;
};
static_assert(sizeof(AnswerBytes) == 104);

bool sound_pose(const AnswerBytes& bytes) {
  double squared = 0;
  for (const double q : bytes.orientation) squared += q * q;
  const bool placed =
      std::all_of(bytes.position.begin(), bytes.position.end(), [](double x) { return std::isfinite(x); });
  return placed && std::isfinite(squared) && std::abs(std::sqrt(squared) - 1.0) <= kQuaternionTolerance;
}

}  // namespace

void write_answer(const Answer& answer, Bytes& payload) {
  AnswerBytes bytes;
  bytes.status = answer.status;
  bytes.number = answer.number;
  bytes.t_ns = answer.t_ns;
  if (answer.command) {
    bytes.flags |= kHasCommand;
    bytes.linear_m_s = answer.command->linear_m_s;
    bytes.angular_rad_s = answer.command->angular_rad_s;
  }
  if (answer.pose) bytes.flags |= kHasPose;
  if (answer.pose && answer.pose->valid) {
    bytes.flags |= kPoseValid;
    std::copy_n(answer.pose->T_map_body.position, 3, bytes.position.begin());
    std::copy_n(answer.pose->T_map_body.orientation, 4, bytes.orientation.begin());
  }
  payload.resize(sizeof bytes);
  std::memcpy(payload.data(), &bytes, sizeof bytes);
}

std::optional<Answer> read_answer(const Datagram& datagram) {
  AnswerBytes bytes;
  if (datagram.payload.size() != sizeof bytes) return std::nullopt;
  std::memcpy(&bytes, datagram.payload.data(), sizeof bytes);
  const bool sound = bytes.status <= HW_ANSWER_END && std::isfinite(bytes.linear_m_s) &&
                     std::isfinite(bytes.angular_rad_s) && sound_pose(bytes);
  if (!sound) return std::nullopt;
  Answer answer{.number = bytes.number,
                .status = bytes.status,
                .sequence = datagram.header.sequence,
                .t_ns = bytes.t_ns};
  if ((bytes.flags & kHasCommand) != 0) answer.command = {bytes.linear_m_s, bytes.angular_rad_s};
  if ((bytes.flags & kHasPose) != 0) {
    answer.pose.emplace();
    answer.pose->valid = (bytes.flags & kPoseValid) != 0;
    std::copy_n(bytes.position.begin(), 3, answer.pose->T_map_body.position);
    std::copy_n(bytes.orientation.begin(), 4, answer.pose->T_map_body.orientation);
  }
  return answer;
}

void write_missing(const std::vector<bool>& missing, Bytes& payload) {
  const auto fragments = static_cast<std::uint16_t>(missing.size());
  payload.assign(sizeof fragments, std::byte{0});
  std::memcpy(payload.data(), &fragments, sizeof fragments);
  if (std::find(missing.begin(), missing.end(), true) == missing.end()) return;
  payload.resize(sizeof fragments + (missing.size() + 7) / 8, std::byte{0});
  for (std::size_t i = 0; i < missing.size(); ++i) {
    if (missing[i]) payload[sizeof fragments + i / 8] |= std::byte{1} << (i % 8);
  }
}

std::optional<std::vector<bool>> read_missing(std::span<const std::byte> payload, std::size_t fragments) {
  std::uint16_t told = 0;
  if (payload.size() < sizeof told) return std::nullopt;
  std::memcpy(&told, payload.data(), sizeof told);
  const auto bits = payload.subspan(sizeof told);
  if (told != fragments || (!bits.empty() && bits.size() != (fragments + 7) / 8)) return std::nullopt;
  std::vector<bool> missing(fragments, false);
  for (std::size_t i = 0; i < fragments && !bits.empty(); ++i) {
    missing[i] = (bits[i / 8] >> (i % 8) & std::byte{1}) != std::byte{0};
  }
  return missing;
}

}  // namespace hallway::link
