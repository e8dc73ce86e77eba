// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

namespace hallway::link {

// Every datagram begins with the same 32 bytes, little-endian (docs/formats.md):
//
//     0   "HWUD"
//     4   u8 version of the protocol (1 or 2), u8 type
//     6   u16 flags: 1 a reply is wanted, 2 the host is ready for frames, 4 the host offers version 2
//     8   u32 session
//     12  u32 CRC-32 (that of zlib) of the whole datagram with these four bytes 0
//     16  u64 sequence
//     24  u16 number of this fragment, u16 how many there are
//     28  u16 bytes that follow, u16 0

using Bytes = std::vector<std::byte>;

/// The versions of the protocol. A hello always has the first one, so that every robot reads it; all other datagrams of a session have the version of the
/// robot's description, which is above the first only where the hello offers it.
inline constexpr std::uint8_t kFirstVersion = 1;
inline constexpr std::uint8_t kNewestVersion = 2;
inline constexpr std::size_t kHeaderBytes = 32;
inline constexpr std::size_t kMaxDatagramBytes = 1400;
/// What every fragment but the last of a message holds.
inline constexpr std::size_t kFragmentBytes = kMaxDatagramBytes - kHeaderBytes;
/// Of a frame: 11 206 656 bytes at most.
inline constexpr std::uint16_t kMaxFrameFragments = 8192;
inline constexpr std::size_t kMaxFrameMessageBytes = kMaxFrameFragments * kFragmentBytes;
/// Of a description.
inline constexpr std::uint16_t kMaxDescriptionFragments = 20;

/// What a datagram is.
enum class Type : std::uint8_t {
  kHello = 1,        ///< host: who are you, or are you there; `sequence` is the host's nonce
  kDescription = 2,  ///< robot: who it is; `sequence` is the nonce of the hello
  kFrame = 3,        ///< robot: a fragment of a frame; `sequence` is the frame's, here and in the next two
  kMissing = 4,      ///< host: which fragments of a frame are missing
  kAnswer = 5,       ///< host: what it answers to a frame
  kBye = 6,          ///< either: the session is over
};

/// Flag: the sender waits for the state of this message.
inline constexpr std::uint16_t kReplyWanted = 1;
/// Flag of a hello: frames may come from now on.
inline constexpr std::uint16_t kReady = 2;
/// Flag of a hello: the host speaks version 2 too.
inline constexpr std::uint16_t kOffersVersion2 = 4;

/// What stands in a datagram's head.
struct Header {
  Type type = Type::kHello;
  std::uint16_t flags = 0;
  std::uint32_t session = 0;
  std::uint64_t sequence = 0;
  std::uint16_t fragment = 0;
  std::uint16_t fragments = 1;
  std::uint8_t version = kFirstVersion;

  bool wants_reply() const { return (flags & kReplyWanted) != 0; }
};

/// A datagram that was found to be whole.
struct Datagram {
  Header header;
  std::span<const std::byte> payload;  ///< in the bytes that it was read from
};

/// Why bytes are no datagram of this protocol.
enum class Refusal {
  kSize,      ///< too short, too long, or not as long as it says
  kMagic,     ///< not of this protocol
  kVersion,   ///< of a version of it that is not known
  kChecksum,  ///< damaged
  kContent,   ///< whole, and what it says makes no sense
};

/// Writes a datagram over `out`. Throws Error{kInternal} if the payload is too long for one.
void write_datagram(const Header& header, std::span<const std::byte> payload, Bytes& out);

/// Reads bytes that nobody vouches for. What it returns has a known type, a fragment number below the number of fragments, no more of
/// these than its type may have, and a payload that is as long as its place in the message says.
std::variant<Datagram, Refusal> read_datagram(std::span<const std::byte> bytes);

/// How many fragments a message of that many bytes has, at least one.
std::size_t fragments_of(std::size_t bytes);
/// The bytes of one of its fragments.
std::span<const std::byte> fragment_of(std::span<const std::byte> message, std::size_t fragment);

}  // namespace hallway::link
