// Gmsh files: any bytes are a mesh of the plane, or of space, or an InputError.
#include <cstdint>
#include <string>

#include "outcome.hpp"
#include "scarp/mesh/gmsh.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  scarp::fuzz::expect_answer_or_error("mesh.msh", [&] { scarp::parse_gmsh<2>("mesh.msh", bytes); });
  scarp::fuzz::expect_answer_or_error("mesh.msh", [&] { scarp::parse_gmsh<3>("mesh.msh", bytes); });
  return 0;
}
