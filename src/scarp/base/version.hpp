// The version of the program, from the project's CMake file.
#pragma once

namespace scarp {

inline constexpr const char* version = SCARP_VERSION;

}  // namespace scarp
