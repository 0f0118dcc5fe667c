// STL files: any bytes are a closed surface with a volume, or an InputError.
#include <cstdint>
#include <string>

#include "outcome.hpp"
#include "scarp/input/stl.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string bytes(reinterpret_cast<const char*>(data), size);
  scarp::fuzz::expect_answer_or_error("hill.stl", [&] {
    if (!(scarp::input::parse_stl("hill.stl", std::move(bytes)).moments().volume > 0)) std::abort();
  });
  return 0;
}
