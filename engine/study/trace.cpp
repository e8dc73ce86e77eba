// SPDX-License-Identifier: MIT
#include "study/trace.hpp"

#include <algorithm>
#include <unordered_map>

#include "eval/evaluator.hpp"
#include "eval/point_error.hpp"
#include "record/failures.hpp"
#include "record/final_map.hpp"
#include "run/feed/frame_feed.hpp"
#include "run/feed/map_epoch.hpp"
#include "run/scoring/iteration_maker.hpp"
#include "run/scoring/truth_of.hpp"

namespace hallway::study {
namespace {

using record::FinalMap;

/// Takes down a run while it goes on.
class Tracer {
 public:
  explicit Tracer(const run::Source& source) : iterations_(source), evaluator_(run::truth_of(source)) {
    if (!source.true_landmarks()) return;
    for (const log::Landmark& landmark : *source.true_landmarks()) {
      if (!landmark.moving) true_place_.emplace(landmark.id, Vec3(landmark.position_m.data()));
    }
  }

  void add(const run::FrameAnswer& answer) {
    if (answer.outputs == nullptr) return;
    const run::SourceFrame& frame = answer.frame;
    eval::Iteration iteration = iterations_.make(answer);
    iteration.map_epoch = answer.outputs->map_epoch();
    evaluator_.add(iteration);
    const std::optional<Pose>& estimate = iteration.T_map_body;
    if (!trace_.T_world_map && estimate && frame.T_world_body && frame.orientation_known)
      trace_.T_world_map = *frame.T_world_body * estimate->inverse();
    TraceStep step{.visible = static_cast<std::uint32_t>(frame.n_elements()), .cpu_ms = *iteration.cpu_ms};
    if (frame.T_world_body) step.truth = frame.T_world_body->t;
    if (estimate) step.estimate = estimate->t;
    trace_.steps.push_back(step);
    for (const host::Counter& counter : answer.outputs->counters()) count(counter);
  }

  void sample(const host::Outputs* report) {
    const FinalMap map = record::copy_map(report);
    MapSample sample{.iterations = static_cast<std::uint32_t>(trace_.steps.size())};
    std::vector<Vec3> truth, places;
    const auto owner = evaluator_.associations().ownership().owner;
    for (const log::MapLandmark& landmark : map.landmarks) {
      if (landmark.status != log::LandmarkStatus::kMapped) continue;
      ++sample.mapped;
      const auto owned = owner.find(landmark.id);
      if (owned == owner.end()) continue;
      const auto place = true_place_.find(owned->second);
      if (place == true_place_.end()) continue;
      truth.push_back(place->second);
      places.emplace_back(landmark.position_m.data());
    }
    sample.rmse_aligned_m = eval::aligned_rmse(truth, places);
    if (trace_.T_world_map && !truth.empty()) {
      sample.rmse_first_pose_m = eval::rmse(truth, places, *trace_.T_world_map);
      double sum = 0.0;
      for (std::size_t i = 0; i < truth.size(); ++i)
        sum += (*trace_.T_world_map * places[i] - truth[i]).norm();
      sample.error_sum_m = sum;
    }
    trace_.samples.push_back(sample);
  }

  Trace finish(const host::Outputs* online, const std::function<const host::Outputs*()>& refine) {
    const FinalMap before = record::copy_map(online);
    const std::vector<eval::JoinedEpoch> joined = run::joined_epochs_of(online);
    const host::Outputs* refined = refine();
    trace_.map = refined != nullptr ? record::copy_map(refined).landmarks : before.landmarks;
    trace_.metrics = evaluator_.metrics(before.landmarks, trace_.map, joined);
    for (CounterMean& counter : trace_.counters) counter.mean /= static_cast<double>(counted_[counter.name]);
    return std::move(trace_);
  }

 private:
  void count(const host::Counter& counter) {
    auto at = std::find_if(trace_.counters.begin(), trace_.counters.end(),
                           [&](const CounterMean& known) { return known.name == counter.name; });
    if (at == trace_.counters.end()) at = trace_.counters.insert(at, {.name = counter.name});
    at->mean += counter.value;  // a sum until the end
    at->last = counter.value;
    ++counted_[counter.name];
  }

  run::IterationMaker iterations_;
  eval::Evaluator evaluator_;
  std::unordered_map<log::LandmarkId, Vec3> true_place_;
  std::unordered_map<std::string, std::uint64_t> counted_;
  Trace trace_;
};

}  // namespace

std::optional<Vec3> Trace::position_error(std::size_t iteration) const {
  const TraceStep& step = steps[iteration];
  if (!T_world_map || !step.truth || !step.estimate) return std::nullopt;
  return *T_world_map * *step.estimate - *step.truth;
}

Trace trace_run(run::Source& source, host::Pipeline& pipeline, std::uint32_t sample_every,
                const TraceHooks& hooks) {
  run::RunPlan plan;
  plan.on_failure = sim::OnFailure::kStop;
  plan.start_failures = record::start_plugins(pipeline, plan.on_failure);
  run::FrameFeed feed(source, pipeline, plan);
  Tracer tracer(source);
  bool stopped = false;
  std::uint32_t sampled = 0;
  while (feed.has_next() && !stopped) {
    feed.next(
        false, [](const run::SourceFrame&) {}, [&](const run::FrameAnswer& answer) { tracer.add(answer); });
    if (hooks.progress) hooks.progress();
    stopped = hooks.stop && hooks.stop();
    if (feed.done() % sample_every == 0) {
      tracer.sample(feed.report(false));
      sampled = feed.done();
    }
  }
  const host::Outputs* online = feed.report(false);
  if (sampled != feed.done()) tracer.sample(online);
  Trace trace = tracer.finish(online, [&] { return feed.report(true); });
  feed.close();
  trace.stopped = stopped;
  if (!feed.failures().verdicts.empty()) trace.failure = feed.failures().verdicts.front().verdict.message;
  return trace;
}

}  // namespace hallway::study
