// Laboratory tests: any text is a test or an InputError.
#include <cstdint>
#include <string>

#include "outcome.hpp"
#include "scarp/input/lab_test.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  scarp::fuzz::expect_answer_or_error("none/test.toml", [&] { scarp::input::parse_lab_test("none/test.toml", text); });
  return 0;
}
