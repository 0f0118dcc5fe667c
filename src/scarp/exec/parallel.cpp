#include "scarp/exec/parallel.hpp"

#include <omp.h>
#include <unistd.h>

#include <cstdlib>

namespace scarp::exec {

int set_threads(int count) {
  if (count > 0) omp_set_num_threads(count);
  return omp_get_max_threads();
}

int thread_count() {
  return omp_get_max_threads();
}

int thread_number() {
  return omp_get_thread_num();
}

void wait_politely(char** argv) {
  for (const char* name : {"OMP_WAIT_POLICY", "GOMP_SPINCOUNT"}) {
    if (std::getenv(name)) return;
  }
  setenv("GOMP_SPINCOUNT", "20000", 1);
  execv("/proc/self/exe", argv);  // returns only where that is not possible; then all goes on without
}

}  // namespace scarp::exec
