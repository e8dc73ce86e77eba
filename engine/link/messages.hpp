// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/driver.h>

#include <optional>
#include <span>
#include <vector>

#include "host/output/outputs.hpp"
#include "link/datagram.hpp"

namespace hallway::link {

/// What the host answers to a frame, as far as it travels.
struct Answer {
  std::uint64_t number = 0;    ///< counts the answers of a session, from 0
  std::uint32_t status = 0;    ///< HW_ANSWER_…
  std::uint64_t sequence = 0;  ///< of the frame
  std::int64_t t_ns = 0;       ///< of the frame
  std::optional<host::DriveCommand> command{};
  std::optional<host::PoseOutput> pose{};
};

/// Payload of an answer, 104 bytes; from version 2 on 112 where its pose is of another time than its frame's. The frame's sequence stands in the header.
/// @param version  of the session
void write_answer(const Answer& answer, Bytes& payload, std::uint8_t version);
/// Reads it; empty if it is not as long as it must be, has an unknown status, or numbers that are not finite or no rotation. From version 2 on it may be
/// longer, with members that are not known here.
std::optional<Answer> read_answer(const Datagram& datagram);

/// Payload of kMissing: u16 how many fragments the frame has, then one bit for each, the lowest of the first byte for the first: 1 is
/// missing. Nothing follows where none is missing.
/// @param missing  of each fragment
void write_missing(const std::vector<bool>& missing, Bytes& payload);
/// Reads it, for a frame of `fragments`; empty if it does not fit.
std::optional<std::vector<bool>> read_missing(std::span<const std::byte> payload, std::size_t fragments);

}  // namespace hallway::link
