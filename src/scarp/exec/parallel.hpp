// Loops over many threads whose results do not depend on their number: work is cut into chunks of fixed size, and sums
// over chunks are taken in the order of the chunks. The only place with OpenMP.
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

/// Σ f(first, last) over chunks [first, last) of 0 ≤ i < count, added in order with Sum::operator+=. An exception of f
/// is thrown on after the loop, that of the first chunk in order.
template <class Sum, class F>
Sum sum_over_chunks(int count, int chunk, F&& f) {
  const int chunks = (count + chunk - 1) / chunk;
  std::vector<Sum> partial(static_cast<std::size_t>(chunks));
  std::vector<std::exception_ptr> thrown(static_cast<std::size_t>(chunks));
#pragma omp parallel for schedule(dynamic, 1) if (chunks > 1)
  for (int c = 0; c < chunks; ++c) {
    try {
      partial[c] = f(c * chunk, std::min(count, (c + 1) * chunk));
    } catch (...) {
      thrown[c] = std::current_exception();
    }
  }
  Sum sum{};
  for (int c = 0; c < chunks; ++c) {
    if (thrown[c]) std::rethrow_exception(thrown[c]);
    sum += partial[c];
  }
  return sum;
}

}  // namespace scarp::exec
