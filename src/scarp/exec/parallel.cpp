#include "scarp/exec/parallel.hpp"

#include <omp.h>

namespace scarp::exec {

int set_threads(int count) {
  if (count > 0) omp_set_num_threads(count);
  return omp_get_max_threads();
}

}  // namespace scarp::exec
