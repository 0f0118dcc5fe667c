// Closed triangle surfaces from STL files.
#pragma once

#include <string>

#include "scarp/base/surface.hpp"

namespace scarp::input {

/// Reads the solid inside a closed surface from an STL file, ASCII or binary, in metres. Normals in the file are not
/// looked at: the order of each triangle's corners counts. Throws InputError, with the line of an ASCII file or the
/// byte of a binary one, when the file is missing, cut short or damaged, or the surface is not that of a solid.
Surface read_stl(const std::string& path);

/// The same from the bytes of such a file; `name` stands for it in errors.
Surface parse_stl(const std::string& name, std::string bytes);

}  // namespace scarp::input
