// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hallway::render {

/// A text as coverage, 0 to 255 per pixel, rows from top to bottom.
struct TextBitmap {
  int left = 0;  ///< column of the first pixel, from the text's origin
  int top = 0;   ///< row of the first pixel, from the base line (negative is above)
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> coverage;
};

/// A TrueType font. Texts are UTF-8; invalid bytes show as the replacement character.
class Font {
 public:
  enum class Weight { kRegular, kBold };

  /// Opens DejaVu Sans. Throws Error{kIo} if its file is not there or no font.
  explicit Font(Weight weight);
  Font(Font&&) noexcept;
  Font& operator=(Font&&) noexcept;
  ~Font();

  /// Width of the text at a size (height of an em), in pixels.
  double width_px(std::string_view text, double size_px) const;
  /// The text, or as much of its beginning as fits into `most_px` with an ellipsis behind it; empty if nothing fits.
  std::string shortened(std::string_view text, double size_px, double most_px) const;
  /// The text's pixels.
  TextBitmap render(std::string_view text, double size_px) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace hallway::render
