// SPDX-License-Identifier: MIT
#include "mesh/load.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/protocol.hpp"

namespace hallway::mesh {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHelper = "hallway-mesh-loader";

/// The reply of the helper program. Throws Error{kBadInput} if it did not end as it should.
std::string ask_helper(const fs::path& program, const LoadRequest& request, const ChildLimits& limits) {
  Child child(program, {}, limits);
  std::string reply = child.exchange(encode_request(request));
  const ChildEnd end = child.wait();
  if (!end.good()) {
    throw Error(ErrorCode::kBadInput, "cannot be read: the mesh loader " + describe(end, limits));
  }
  return reply;
}

}  // namespace

Model load_model(const fs::path& file, const fs::path& root_folder, const LoadLimits& limits) {
  return load_model_by(find_helper(kHelper), file, root_folder, limits);
}

Model load_model_by(const fs::path& program, const fs::path& file, const fs::path& root_folder,
                    const LoadLimits& limits) {
  LoadRequest request;
  request.file = fs::absolute(file).string();
  request.root = fs::absolute(root_folder.empty() ? fs::path(".") : root_folder).string();
  request.limits = limits.model;
  try {
    return decode_reply(ask_helper(program, request, limits.child), limits.model);
  } catch (const Error& error) {
    std::string element = error.where().element;
    if (!error.where().file.empty()) element = error.where().file + (element.empty() ? "" : ": " + element);
    throw Error(error.code(), error.message(),
                {.file = printable(file.string(), kMaxNameBytes), .element = element});
  }
}

}  // namespace hallway::mesh
