// SPDX-License-Identifier: MIT
#include "host/isolate/isolated_list.hpp"

#include <system_error>

#include "base/bytes.hpp"
#include "base/text.hpp"
#include "host/isolate/plugin_messages.hpp"
#include "host/isolate/plugin_process.hpp"

namespace hallway::host {
namespace {

namespace fs = std::filesystem;

/// Calls that a process which describes a library is asked for.
class Describer {
 public:
  Describer(const fs::path& file, const Isolation& isolation)
      : file_(file), isolation_(isolation), process_(isolation, {}, file.filename().string()) {}

  std::vector<PluginInfo> describe() {
    const StartRequest request{.wanted = file_.string(),
                               .folders = {},
                               .data_bytes = data_limit(isolation_),
                               .file_bytes = isolation_.file_bytes,
                               .scratch = process_.scratch().string()};
    AlignedByteWriter writer(process_.room());
    write_start(writer, request);
    if (!writer.fits()) throw Error(ErrorCode::kPluginLoad, "has a name that is too long");
    std::vector<PluginInfo> infos;
    call(Request::kDescribe, writer.size(), [&](AlignedByteReader& reader) { infos = read_infos(reader); });
    return infos;
  }

  void close() {
    call(Request::kClose, 0, [](AlignedByteReader& reader) { reader.expect_end(); });
  }

 private:
  template <typename Read>
  void call(Request request, std::size_t size, Read&& read) {
    process_.submit(request, size);
    const HostChannel::Answer answer = process_.await(request);
    AlignedByteReader reader(answer.bytes);
    try {
      if (answer.reply == Reply::kError) throw_error(reader, file_.filename().string());
      read(reader);
    } catch (const BadBytes& bad) {
      process_.fail_protocol(request, bad.what);
    }
  }

  const fs::path& file_;
  const Isolation& isolation_;
  PluginProcess process_;
};

Listed describe(const fs::path& file, const Isolation& isolation) {
  Listed listed{.file = file};
  Describer describer(file, isolation);
  try {
    listed.plugins = describer.describe();
    describer.close();
  } catch (const PluginFailure& failure) {
    listed.verdict = failure.verdict();
    listed.problem = Error(failure.code(), failure.message(), {.file = file.string()}).what();
  } catch (const Error& error) {
    listed.problem = error.what();
  }
  return listed;
}

}  // namespace

std::vector<Listed> list_plugins_isolated(std::span<const fs::path> folders, const Isolation& isolation) {
  std::vector<Listed> listed;
  for (const fs::path& file : library_files(folders)) listed.push_back(describe(file, isolation));
  return listed;
}

std::string find_plugin_file(const std::string& wanted, std::span<const fs::path> folders,
                             const Isolation& isolation) {
  if (is_library_file(wanted)) return wanted;
  for (const fs::path& folder : folders) {
    std::error_code problem;
    if (!wanted.empty() && fs::exists(folder / (wanted + ".so"), problem)) return wanted;
  }
  const std::vector<Listed> listed = list_plugins_isolated(folders, isolation);
  for (const Listed& file : listed) {
    for (const PluginInfo& info : file.plugins) {
      if (info.id == wanted) return file.file.string() + ":" + wanted;
    }
  }
  fail_not_found(wanted, folders, listed);
}

}  // namespace hallway::host
