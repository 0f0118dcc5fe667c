// Integration of many increments at once, one in each lane of a batch, each with its own substeps.
#pragma once

#include <array>
#include <cstddef>

#include "scarp/material/integrate/embedded.hpp"
#include "scarp/tensor/batch.hpp"

namespace scarp {

/// What a point is integrated from, and over.
template <class Model, int N>
struct Task {
  typename Model::template State<double, N> state;
  Increment<double, N> whole;
};

/// The states and increments of as many tasks as a batch has lanes.
template <class Model, int N>
class TaskLanes {
 public:
  using Point = typename Model::template State<double, N>;
  using Points = typename Model::template State<Batch, N>;

  Points state;
  Increment<Batch, N> whole;

  explicit TaskLanes(const Task<Model, N>& task) {
    for_each_component([](Batch& x, const double& y) { x = Batch(y); }, state, task.state);
    for (int c = 0; c < N; ++c) whole.deps[c] = Batch(task.whole.deps[c]);
    whole.dt = Batch(task.whole.dt);
  }

  void put(std::size_t lane, const Task<Model, N>& task) {
    for_each_component([&](Batch& x, const double& y) { put(x, lane, y); }, state, task.state);
    for (int c = 0; c < N; ++c) put(whole.deps[c], lane, task.whole.deps[c]);
    put(whole.dt, lane, task.whole.dt);
  }

  Task<Model, N> get(std::size_t lane) const {
    Task<Model, N> task;
    for_each_component([&](double& x, const Batch& y) { x = y.get(lane); }, task.state, state);
    for (int c = 0; c < N; ++c) task.whole.deps[c] = whole.deps[c].get(lane);
    task.whole.dt = whole.dt.get(lane);
    return task;
  }

 private:
  static void put(Batch& x, std::size_t lane, double value) {
    std::array<double, batch_lanes> values;
    x.store_unaligned(values.data());
    values[lane] = value;
    x = Batch::load_unaligned(values.data());
  }
};

/// The notes of one lane.
inline UpdateFlags<double> lane_of(const UpdateFlags<Batch>& flags, std::size_t lane) {
  return {flags.corrected.get(lane), flags.on_floor.get(lane), flags.separated.get(lane), flags.sound.get(lane)};
}

/// integrate() for `count` tasks, task(i) each; done(i, end state, report) in the order in which they end. A lane that
/// is done takes the next task, so that lanes stay busy however unequal the tasks. No lane sees another one: what comes
/// out for a task does not depend on its neighbours.
template <class Pair, class Model, int N, class GetTask, class Done>
void integrate_lanes(const Model& model, int count, GetTask&& task, Done&& done, const IntegrationSettings& settings,
                     double start) {
  static_assert(!Pair::doubts, "lanes do not confirm doubted substeps");
  if (count == 0) return;
  constexpr double order = error_order<Pair, Model, typename TaskLanes<Model, N>::Points, Increment<Batch, N>>();
  std::array<int, batch_lanes> who;
  std::array<StepControl, batch_lanes> control;
  std::array<double, batch_lanes> share;
  TaskLanes<Model, N> lanes(task(0));
  int next = 0, busy = 0;
  auto take_next = [&](std::size_t l) {
    who[l] = -1;  // a lane without a task goes through the motions of its last one
    while (next < count && who[l] < 0) {
      auto taken = task(next);
      if (is_idle(model, taken.whole)) {
        const auto report = integrate<Pair>(model, taken.state, taken.whole, settings);
        done(next, taken.state, report);
      } else {
        lanes.put(l, taken);
        control[l] = StepControl(start);
        who[l] = next;
        ++busy;
      }
      ++next;
    }
  };
  for (std::size_t l = 0; l < batch_lanes; ++l) take_next(l);
  while (busy > 0) {
    for (std::size_t l = 0; l < batch_lanes; ++l) share[l] = who[l] < 0 ? 0.0 : control[l].next();
    const auto part = Batch::load_unaligned(share.data()) * lanes.whole;
    const auto trial = attempt<Pair>(model, lanes.state, part, settings.tolerance);
    const auto good = trial.flags.sound && (trial.error <= Batch(settings.tolerance));
    lanes.state = select_state(good, trial.state, lanes.state);
    for (std::size_t l = 0; l < batch_lanes; ++l) {
      if (who[l] < 0) continue;
      control[l].judge(trial.error.get(l), lane_of(trial.flags, l), settings.tolerance, order);
      const bool stuck = control[l].stuck(settings);
      if (!control[l].finished() && !stuck) continue;
      const auto end = lanes.get(l);
      if (stuck) control[l].report.end = failure(model, end.state, share[l] * end.whole, settings.tolerance);
      done(who[l], end.state, control[l].report);
      --busy;
      take_next(l);
    }
  }
}

}  // namespace scarp
