// Sweeps over the chunks of a field. Not for use outside step/.
#pragma once

#include <vector>

#include "scarp/exec/parallel.hpp"
#include "scarp/step/velocity_field.hpp"

namespace scarp::step {

/// f(chunk) for each that has active elements, on all threads.
template <int Dim, class F>
void for_each_chunk(const VelocityField<Dim>& field, F&& f) {
  exec::for_each_piece(field.assembly.chunks(), [&](int c) { f(field.assembly.chunk(c)); });
}

/// f(chunk, part), with a part of the thread's books for each chunk.
template <int Dim, class F>
void for_each_chunk(const VelocityField<Dim>& field, std::vector<BodyTotals<Dim>>& of_threads, F&& f) {
  for_each_chunk(field, [&](const exec::Chunk& chunk) {
    auto& totals = of_threads[exec::thread_number()];
    f(chunk, totals.part());
    totals.close_part();
  });
}

/// Step 2, once all elements have added to their accumulators: the sums of the nodes, n numbers each, over those of all
/// chunks, and of the other processes.
template <int n, int Dim>
void gather(VelocityField<Dim>& field, Column& numbers) {
  field.halo.start(numbers, n);
  field.halo.finish(numbers);
  const exec::Assembly& assembly = field.assembly;
  exec::for_each_piece(assembly.chunks(), [&](int c) { assembly.gather_chunk<n>(c, numbers.data()); });
}

/// A count of the step so far, of a field in this process.
template <int Dim>
std::int64_t counted(const VelocityField<Dim>& field, std::int64_t StepTotals<Dim>::*count) {
  std::int64_t sum = 0;
  for (const auto& totals : field.buffers.totals) sum += totals.part().*count;
  return sum;
}

/// What all threads have booked.
template <int Dim>
StepTotals<Dim> total_of(const std::vector<BodyTotals<Dim>>& of_threads) {
  BodyTotals<Dim> all;
  for (const auto& totals : of_threads) all += totals;
  return all.total();
}

}  // namespace scarp::step
