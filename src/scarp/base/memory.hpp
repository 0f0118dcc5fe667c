// How much memory there is, asked before much of it is taken.
#pragma once

#include <string>

namespace scarp {

/// What this process may still take [bytes], in memory and in address space: of what the machine has free, the limit of
/// its control group and that of the shell (`ulimit -v`). Very large where the system does not tell.
struct FreeMemory {
  double memory, addresses;
};
FreeMemory free_memory();

/// "1.5 GB": bytes in decimal units, two digits.
std::string as_bytes(double bytes);

}  // namespace scarp
