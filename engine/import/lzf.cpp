// SPDX-License-Identifier: MIT
#include "import/lzf.hpp"

#include "base/error.hpp"

namespace hallway::import {
namespace {

[[noreturn]] void refuse(const char* cause) {
  throw Error(ErrorCode::kBadInput, std::string("the compressed data ") + cause);
}

class Decoder {
 public:
  Decoder(std::string_view data, std::size_t size) : rest_(data), size_(size) { out_.reserve(size); }

  std::string run() {
    while (!rest_.empty()) {
      const unsigned control = next();
      if (control < kMaxLiterals) {
        copy_literals(control + 1);
      } else {
        repeat(control);
      }
    }
    if (out_.size() != size_) refuse("ends before all points are there");
    return std::move(out_);
  }

 private:
  static constexpr unsigned kMaxLiterals = 32;  ///< of one run; higher controls are repetitions

  unsigned next() {
    if (rest_.empty()) refuse("ends in the middle of a step");
    const auto byte = static_cast<unsigned char>(rest_.front());
    rest_.remove_prefix(1);
    return byte;
  }
  void make_room(std::size_t count) {
    if (count > size_ - out_.size()) refuse("gives more than the points need");
  }
  void copy_literals(std::size_t count) {
    if (count > rest_.size()) refuse("ends in the middle of a run");
    make_room(count);
    out_.append(rest_.substr(0, count));
    rest_.remove_prefix(count);
  }
  /// Length in the upper three bits, 7: more in the next byte; distance in the other five and one more byte.
  void repeat(unsigned control) {
    constexpr unsigned kLong = 7;
    std::size_t length = (control >> 5) + 2;
    if (control >> 5 == kLong) length += next();
    const std::size_t distance = ((control & 0x1Fu) << 8 | next()) + 1;
    if (distance > out_.size()) refuse("repeats what stands before its beginning");
    make_room(length);
    // Byte by byte: what is repeated may overlap what is written.
    for (std::size_t i = 0; i < length; ++i) out_.push_back(out_[out_.size() - distance]);
  }

  std::string_view rest_;
  std::size_t size_;
  std::string out_;
};

}  // namespace

std::string decompress_lzf(std::string_view data, std::uint64_t size) {
  if (size / kMaxLzfRatio > data.size()) refuse("is too short for its points");
  return Decoder(data, static_cast<std::size_t>(size)).run();
}

}  // namespace hallway::import
