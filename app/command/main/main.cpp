#include "app/command/program.h"

int main(int argc, char** argv) {
  return twinarm::run_program(argc, argv);
}
