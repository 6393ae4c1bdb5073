// The file in which a map grows. Check sums are made right, so that what they guard is reached.
#include <cstring>

#include "app/map/tile_file.h"
#include "app/record/recording.h"
#include "tests/fuzz/fuzz_input.h"

namespace twinarm::fuzz {
namespace {

std::string with_sums(std::string bytes) {
  const std::size_t head = bytes.find("\n\n");
  for (std::size_t at = head + 2; head != bytes.npos && bytes.size() - at >= 16;) {
    std::uint32_t doubles = 0;
    std::memcpy(&doubles, bytes.data() + at + 4, 4);
    const std::size_t size = 8 + 8 * std::size_t{doubles};
    if (size + 8 > bytes.size() - at) break;
    const std::uint64_t sum = hash_of(bytes.substr(at, size));
    std::memcpy(bytes.data() + at + size, &sum, 8);
    at += size + 8;
  }
  return bytes;
}

void read_tile(const std::string& bytes) {
  goes_through([&] {
    const std::filesystem::path file = folder().write("work.map", bytes);
    const TileFile tile = read_tile_file(file);
    FaultList faults;
    TileFile all;
    check_same_map(tile, all, file, "", faults);
    add_blocks(tile, {40, 20}, file, all, faults);
    faults.check();
  });
}

}  // namespace

void tile(Bytes bytes) {
  read_tile(std::string(bytes));
  read_tile(with_sums(std::string(bytes)));
}

}  // namespace twinarm::fuzz
