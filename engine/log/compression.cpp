// SPDX-License-Identifier: MIT
#include "log/compression.hpp"

#include <fmt/format.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <memory>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::log {
namespace {

constexpr int kLevel = 1;
/// A frame that asks for a larger window is refused: the window is memory that a few bytes could claim.
constexpr int kMaxWindowLog = 27;
/// Output grows by at most this much before it is seen to be filled.
constexpr std::uint64_t kStep = 4u << 20;

struct FreeStream {
  void operator()(ZSTD_DStream* stream) const { ZSTD_freeDStream(stream); }
};

}  // namespace

std::uint32_t crc32(std::string_view bytes, std::uint32_t before) {
  const auto* data = static_cast<const Bytef*>(static_cast<const void*>(bytes.data()));
  return static_cast<std::uint32_t>(::crc32_z(before, data, bytes.size()));
}

std::string compress_zstd(std::string_view bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size = ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), kLevel);
  if (ZSTD_isError(size)) throw Error(ErrorCode::kInternal, ZSTD_getErrorName(size));
  out.resize(size);
  return out;
}

std::string decompress_zstd(std::string_view bytes, std::uint64_t size) {
  const std::unique_ptr<ZSTD_DStream, FreeStream> stream(ZSTD_createDStream());
  if (!stream) throw std::bad_alloc();
  ZSTD_DCtx_setParameter(stream.get(), ZSTD_d_windowLogMax, kMaxWindowLog);
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  std::string out;
  std::uint64_t done = 0;
  std::size_t hint = 0;
  for (;;) {
    // One byte more than promised: what is longer shows itself there.
    out.resize(std::min(size + 1, done + kStep));
    ZSTD_outBuffer room{out.data(), out.size(), done};
    hint = ZSTD_decompressStream(stream.get(), &room, &in);
    if (ZSTD_isError(hint)) {
      throw Error(ErrorCode::kBadInput, fmt::format("zstd: {}", printable(ZSTD_getErrorName(hint))));
    }
    const bool stuck = room.pos == done && in.pos == in.size;
    done = room.pos;
    if (done > size || (in.pos == in.size && (hint == 0 || stuck))) break;
  }
  if (done != size || hint != 0) {
    throw Error(ErrorCode::kBadInput, done > size ? fmt::format("zstd: more than {} bytes", size)
                                                  : fmt::format("zstd: {} bytes instead of {}", done, size));
  }
  out.resize(size);
  return out;
}

}  // namespace hallway::log
