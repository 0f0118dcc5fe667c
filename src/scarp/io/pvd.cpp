#include "scarp/io/pvd.hpp"

#include <fmt/format.h>

#include "scarp/io/file.hpp"

namespace scarp::io {

void PvdWriter::write() const {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const auto& [when, name] : frames_) {
    text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", when, name);
  }
  write_whole(path_, text + "</Collection>\n</VTKFile>\n");
}

}  // namespace scarp::io
