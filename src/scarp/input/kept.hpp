// The case that a folder of results keeps.
#pragma once

#include <string>

namespace scarp::input {

/// The text of a case that was read from `case_path`, so that it can be run from `folder`: relative names of meshes,
/// STL files and libraries start at the folder of the case file, and would lead nowhere from there. They become
/// relative to `folder` where that lies within the folder of the case, so that both may be moved together, and absolute
/// where it lies elsewhere. A text without such names, or of a case in `folder`, stays as it is.
std::string kept_text(const std::string& text, const std::string& case_path, const std::string& folder);

}  // namespace scarp::input
