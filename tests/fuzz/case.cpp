// Cases: any text is a case or an InputError. Of a case memory and points are counted, and nothing of it is built.
#include <cmath>
#include <cstdint>
#include <string>
#include <variant>

#include "outcome.hpp"
#include "scarp/input/case.hpp"
#include "scarp/run/memory_need.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  scarp::fuzz::expect_answer_or_error("none/case.toml", [&] {
    const auto input = scarp::input::read_case_text(text, "none/case.toml");
    std::visit(
        [](const auto& its) {
          const auto need = scarp::run::memory_need(its);
          if (std::isnan(need.grid) || std::isnan(need.points) || std::isnan(need.addresses)) std::abort();
        },
        input);
  });
  return 0;
}
