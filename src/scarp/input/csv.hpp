// Reading columns of numbers from a CSV file.
#pragma once

#include <string>
#include <vector>

namespace scarp::input {

/// Rows of the named columns, in the order of the names. The file's first line names its columns, in any order and
/// others among them; a file of numbers alone has just these, in order. Empty lines and lines that start with # are
/// passed over. Throws InputError with line and column for what is no finite number, for missing columns and for a file
/// without rows.
std::vector<std::vector<double>> read_columns(const std::string& path, const std::vector<std::string>& names);

/// The same from the text of such a file; `name` stands for it in errors.
std::vector<std::vector<double>> parse_columns(const std::string& name, std::string text,
                                               const std::vector<std::string>& names);

}  // namespace scarp::input
