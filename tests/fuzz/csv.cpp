// Tables of numbers: any text is rows of as many finite numbers as were asked for, or an InputError.
#include <cmath>
#include <cstdint>
#include <string>

#include "outcome.hpp"
#include "scarp/input/csv.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string text(reinterpret_cast<const char*>(data), size);
  scarp::fuzz::expect_answer_or_error("strains.csv", [&] {
    const auto rows = scarp::input::parse_columns("strains.csv", std::move(text), {"eps_xx", "eps_yy"});
    if (rows.empty()) std::abort();
    for (const auto& row : rows) {
      if (row.size() != 2 || !std::isfinite(row[0]) || !std::isfinite(row[1])) std::abort();
    }
  });
  return 0;
}
