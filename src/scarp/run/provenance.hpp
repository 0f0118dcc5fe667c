// Where results come from: who computed them, with what, from which files (provenance.json).
#pragma once

#include <string>
#include <vector>

#include "scarp/run/checkpoint.hpp"
#include "scarp/run/run.hpp"

namespace scarp::run {

/// "scarp 0.1.0 (AVX-512)"
std::string program_name();

/// The case that a folder of results keeps.
std::string case_in(const std::string& folder);

/// The files that the text of a case names, with their fingerprints; `path` is that of the case.
std::vector<FileRead> files_read(const std::string& case_text, const std::string& path);

/// Throws InputError where the case that the folder keeps is not that of the checkpoint any more, or a file that it
/// reads is another one.
void check_case_unchanged(const CheckpointFile& from, const std::string& kept_case);

/// Adds this process to the record of the runs that have written into the folder. `threads` is their number.
void write_provenance(const std::string& folder, const Options& options, int threads, const CheckpointHead& head);

}  // namespace scarp::run
