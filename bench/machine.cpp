// What the machine can do: the bandwidth of its memory and the rate of its arithmetic. Answers each line on standard
// input with one line of JSON.
//
//     machine THREADS
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scarp/exec/parallel.hpp"
#include "scarp/tensor/batch.hpp"

namespace {

using scarp::Batch;
using Clock = std::chrono::steady_clock;

/// Sums over chunks, for the loops of exec/.
struct Sum {
  double value = 0;
  Sum& operator+=(const Sum& other) {
    value += other.value;
    return *this;
  }
};

/// Arrays of four times the last cache each, at least 128 MB.
class Triad {
 public:
  Triad() {
    const long cache = sysconf(_SC_LEVEL3_CACHE_SIZE);
    size_ = static_cast<int>(std::max(128L << 20, 4 * cache) / 8);
    for (auto* array : {&a_, &b_, &c_}) array->reset(new double[static_cast<std::size_t>(size_)]);  // not touched yet
    run();
  }

  /// a = b + s c once; seconds.
  double run() {
    double *a = a_.get(), *b = b_.get(), *c = c_.get();
    const bool first = first_;
    const auto start = Clock::now();
    Sum none;
    scarp::exec::sum_over_chunks(size_, 1 << 16, partial_, none, [a, b, c, first](int from, int to, Sum&) {
      if (first) {
        std::fill(b + from, b + to, 1.0);
        std::fill(c + from, c + to, 2.0);
      }
      for (int i = from; i < to; ++i) a[i] = b[i] + 3.0 * c[i];
    });
    first_ = false;
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  /// Each pass reads b and c, and reads the lines of a before it writes them: 32 bytes an entry.
  double bytes() const { return 32.0 * size_; }

 private:
  int size_ = 0;
  bool first_ = true;
  std::unique_ptr<double[]> a_, b_, c_;
  std::vector<Sum> partial_;
};

/// Chains of a = a x + y that do not depend on each other, enough to keep two units of four cycles' latency busy;
/// floating-point operations per second.
double arithmetic_peak(int threads) {
  constexpr int chains = 12, rounds = 4'000'000;
  std::vector<Sum> partial;
  Sum total;
  const auto start = Clock::now();
  scarp::exec::sum_over_chunks(threads, 1, partial, total, [](int, int, Sum& sum) {
    const Batch x(0.999999), y(1e-6);
    std::array<Batch, chains> a;
    for (int k = 0; k < chains; ++k) a[k] = Batch(1.0 + k);
    for (int r = 0; r < rounds; ++r)
      for (auto& value : a) value = xsimd::fma(value, x, y);
    for (const auto& value : a) sum.value += xsimd::hadd(value);
  });
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (!(total.value > 0)) std::abort();  // keeps the loop
  return 2.0 * chains * rounds * threads * static_cast<double>(Batch::size) / seconds;
}

}  // namespace

int main(int argc, char** argv) {
  scarp::exec::wait_politely(argv);
  if (argc != 2) {
    std::cerr << "usage: machine THREADS\n";
    return 2;
  }
  const int threads = scarp::exec::set_threads(std::atoi(argv[1]));
  Triad triad;
  for (std::string line; std::getline(std::cin, line);) {
    const double seconds = triad.run();
    std::cout << nlohmann::ordered_json{{"bytes_per_second", triad.bytes() / seconds},
                                        {"flops_per_second", arithmetic_peak(threads)},
                                        {"lanes", Batch::size}}
              << std::endl;
  }
}
