// The processes that a run is shared by, and what they send each other: here one, which has nothing to send. Called
// where several would have to, by all of them alike; what each call is for: docs/architecture.md, "What crosses
// processes".
#pragma once

#include <cstdint>
#include <optional>

#include "scarp/base/column.hpp"
#include "scarp/comm/tally.hpp"

namespace scarp::comm {

/// Makes the numbers of a tally those of all processes; what lies between the two calls goes on meanwhile.
inline void start(const Tally&) {}
inline void finish(const Tally&) {}

/// Throws on all processes the failure of the lowest place, if there is any.
inline void agree(const std::optional<Failure>& here) {
  if (here) throw here->error;
}

/// The least and the largest of all processes' numbers, and the sums of them.
inline double least_of_all(double here) {
  const Tally tally{.sums = {}, .least = {&here, 1}, .most = {}, .counts = {}};
  start(tally);
  finish(tally);
  return here;
}
inline double most_of_all(double here) {
  const Tally tally{.sums = {}, .least = {}, .most = {&here, 1}, .counts = {}};
  start(tally);
  finish(tally);
  return here;
}
inline double sum_of_all(ExactSum here) {
  const Tally tally{.sums = {&here, 1}, .least = {}, .most = {}, .counts = {}};
  start(tally);
  finish(tally);
  return here.value();
}
inline std::int64_t sum_of_all(std::int64_t here) {
  const Tally tally{.sums = {}, .least = {}, .most = {}, .counts = {&here, 1}};
  start(tally);
  finish(tally);
  return here;
}

/// Sums at nodes that several processes touch: each gets the others' parts, and adds all of them in the order of the
/// chunks.
class Halo {
 public:
  /// So many `numbers` of each place of `values`, once the chunks at a border have summed up theirs; those inside may
  /// go on.
  void start(const Column& /*values*/, int /*numbers*/) {}
  void finish(Column& /*values*/) {}
};

}  // namespace scarp::comm
