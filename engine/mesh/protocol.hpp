// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "mesh/model.hpp"

namespace hallway::mesh {

/// What the mesh loader is asked to do.
struct LoadRequest {
  std::string file{};  ///< absolute path of the model
  std::string root{};  ///< absolute path of the folder that it may read from
  ModelLimits limits{};
};

/// Takes bytes of a message, in order.
using ByteSink = std::function<void(std::string_view bytes)>;

/// Messages between load_model() and its helper program: a mark, then numbers in the byte order of the machine, and arrays
/// and texts each after their count. Both ends are of one build.
std::string encode_request(const LoadRequest& request);
/// Throws Error{kBadInput}.
LoadRequest decode_request(std::string_view message);

/// A model as the reply. The pieces together are the message; large arrays are not copied.
void encode_model(const Model& model, const ByteSink& sink);
/// A failure as the reply.
std::string encode_failure(const Error& failure);

/// The model of a reply. Trusts nothing in it: every count is compared with the bytes that are there and with `limits`
/// before anything is allocated, and the model is checked by check_model(); names become printable().
/// Throws the Error that the reply carries, or Error{kBadInput} for a reply that is none.
Model decode_reply(std::string_view message, const ModelLimits& limits);

}  // namespace hallway::mesh
