// SPDX-License-Identifier: MIT
#pragma once

#include "loaders/gltf_document.hpp"
#include "loaders/image_decoder.hpp"
#include "loaders/scene.hpp"

namespace hallway::loaders::gltf {

/// The scene that a document shows: the one it names, else the first, else all nodes that have no parent. Not recursive;
/// nodes must form trees. Morph targets, skins, vertex colours, points and lines are left out. Images that are missing or
/// broken become warnings.
/// Throws Error{kBadInput} naming node, mesh, accessor or image and what is wrong.
Scene convert(const Document& document, const mesh::ModelLimits& limits);

}  // namespace hallway::loaders::gltf
