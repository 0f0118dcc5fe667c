#include "command_line.hpp"

int main(int argc, char** argv) {
  return scarp_main(argc, argv);
}
