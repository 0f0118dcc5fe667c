// The whole program but main().
#pragma once

/// Runs the command line; returns the exit status. With the language linkage of C, so that it has one name in libscarp.
extern "C" int scarp_main(int argc, char** argv);
