// The points of one region in a checkpoint. For body_state.cpp.
#pragma once

#include "scarp/run/body_state.hpp"

namespace scarp::run {

template <int Dim>
void save_block(const Saver& save, const Block<Dim>& block);

/// Into a block of the same name, model and length, without points yet. Throws InputError where it does not fit.
template <int Dim>
void load_block(const Loader& load, Elements elements, const Body<Dim>& body, Block<Dim>& block);

/// Throws InputError: region, what does not fit, and what the file has in its place.
[[noreturn]] void refuse_region(const Loader& load, const std::string& region, const std::string& what,
                                const std::string& value);

}  // namespace scarp::run
