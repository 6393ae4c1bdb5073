// The file in which a map grows.
#include "app/map/map_results.h"
#include "tests/fuzz/fuzz_input.h"

namespace twinarm::fuzz {

void tile(Bytes bytes) {
  goes_through([&] {
    const std::filesystem::path file = folder().write("work.map", std::string(bytes));
    TileFile all;
    add_cells(read_tile_file(file), {40, 20}, file, "", all);
  });
}

}  // namespace twinarm::fuzz
