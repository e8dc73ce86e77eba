// SPDX-License-Identifier: MIT
#include "record/failures.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.hpp"
#include "record/plugin_json.hpp"

namespace hallway::record {

void Failures::note(host::Verdict verdict, std::optional<std::uint32_t> iteration) {
  ++count;
  if (verdicts.size() < kMaxVerdicts) verdicts.push_back({std::move(verdict), iteration});
}

std::optional<host::Verdict> catch_failure(const std::function<void()>& work) {
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
    auto verdict = catch_failure([&] { pipeline.restart(); });
    if (!verdict) break;
    failures.push_back({std::move(*verdict), std::nullopt});
  }
  return failures;
}

void describe_failures(host::OnFailure policy, const Failures& failures, nlohmann::ordered_json& manifest) {
  const auto print = [](const Failure& failure) { return print_verdict(failure.verdict, failure.iteration); };
  manifest["on_failure"] = host::on_failure_name(policy);
  manifest["failures"] = failures.count;
  manifest["restarts"] = failures.restarts;
  manifest["verdict"] =
      failures.verdicts.empty() ? nlohmann::ordered_json() : print(failures.verdicts.front());
  if (failures.verdicts.size() < 2) return;
  for (const Failure& failure : failures.verdicts) manifest["verdicts"].push_back(print(failure));
}

}  // namespace hallway::record
