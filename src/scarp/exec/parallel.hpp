// Loops over many threads whose results do not depend on their number: work is cut into pieces that are the same for
// any number of threads, and sums over them are taken in their order, or exact. The only place with OpenMP.
#pragma once

#include <algorithm>
#include <exception>
#include <vector>

namespace scarp::exec {

/// Number of threads that loops use from now on; 0 leaves it to the system. Returns the number in use.
int set_threads(int count);

/// Lets threads that wait for each other sleep soon, instead of holding a core that others may need: on a machine
/// shared with other work that makes a step many times faster. The OpenMP library reads this from the environment
/// before main(), so the program starts itself once more with it; a user's own settings are kept. Call first in main().
void wait_politely(char** argv);

/// f(i) for 0 ≤ i < count, in any order.
template <class F>
void for_each(int count, F&& f) {
#pragma omp parallel for schedule(static) if (count > 1000)
  for (int i = 0; i < count; ++i) f(i);
}

/// The number of threads that a loop may use, and the number of the calling one among them.
int thread_count();
int thread_number();

/// f(i) for pieces of work 0 ≤ i < count that are worth a thread each, dealt out in the same way each time: neighbours
/// to the same thread. An exception of f is thrown on after the loop, that of the first piece.
template <class F>
void for_each_piece(int count, F&& f) {
  int first_thrown = count;
  std::exception_ptr thrown;
#pragma omp parallel for schedule(static) if (count > 1)
  for (int i = 0; i < count; ++i) {
    try {
      f(i);
    } catch (...) {
#pragma omp critical
      if (i < first_thrown) {
        first_thrown = i;
        thrown = std::current_exception();
      }
    }
  }
  if (thrown) std::rethrow_exception(thrown);
}

/// f(first, last, sum) for pieces [first, last) of 0 ≤ i < count, each with a sum of its own; total += those sums, in
/// order. `partial` keeps them, so that nothing is allocated in a step.
template <class Sum, class F>
void sum_over_chunks(int count, int chunk, std::vector<Sum>& partial, Sum& total, F&& f) {
  const int chunks = (count + chunk - 1) / chunk;
  if (partial.size() < static_cast<std::size_t>(chunks)) partial.resize(static_cast<std::size_t>(chunks));
  for_each_piece(chunks, [&](int c) {
    partial[c] = Sum{};
    f(c * chunk, std::min(count, (c + 1) * chunk), partial[c]);
  });
  for (int c = 0; c < chunks; ++c) total += partial[c];
}

}  // namespace scarp::exec
