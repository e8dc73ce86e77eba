// SPDX-License-Identifier: MIT
#include "record/failure.hpp"

#include "base/error.hpp"

namespace hallway::record {

std::optional<host::Verdict> verdict_of(const std::function<void()>& work) {
  try {
    work();
    return std::nullopt;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kPluginFault) throw;
    const auto* failure = dynamic_cast<const host::PluginFailure*>(&error);
    host::Verdict verdict = failure != nullptr ? failure->verdict() : host::Verdict{};
    verdict.message = error.what();
    return verdict;
  }
}

std::vector<Failure> start_plugins(host::Pipeline& pipeline, host::OnFailure policy) {
  const std::uint32_t attempts = policy == host::OnFailure::kRestart ? kStartAttempts : 1;
  std::vector<Failure> failures;
  while (failures.size() < attempts) {
    auto verdict = verdict_of([&] { pipeline.restart(); });
    if (!verdict) break;
    failures.push_back({std::move(*verdict), std::nullopt});
  }
  return failures;
}

}  // namespace hallway::record
