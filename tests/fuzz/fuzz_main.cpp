// Under libFuzzer: one program for all targets. fuzz --target=NAME [options of libFuzzer] ..
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

#include "tests/fuzz/targets.h"

namespace {

const twinarm::fuzz::Target* chosen = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** words) {
  for (int i = 1; i < *count; ++i)
    for (const auto& target : twinarm::fuzz::kTargets)
      if (std::string("--target=") + target.name == (*words)[i]) chosen = &target;
  if (chosen) return 0;
  std::cerr << "give --target=NAME, one of:";
  for (const auto& target : twinarm::fuzz::kTargets) std::cerr << ' ' << target.name;
  std::cerr << '\n';
  std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  chosen->run({reinterpret_cast<const char*>(data), size});
  return 0;
}
