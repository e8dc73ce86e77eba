// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "render/image.hpp"

namespace hallway::render {

/// The image as the bytes of a PNG file, without loss; the same image gives the same bytes (no time stamp, no text).
/// Throws Error{kBadInput} if the image has no pixels or its size and its bytes do not agree.
std::string encode_png(const Image& image);

}  // namespace hallway::render
