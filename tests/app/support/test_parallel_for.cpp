#include "app/support/parallel_for.h"

#include <doctest/doctest.h>

#include <atomic>
#include <stdexcept>
#include <thread>

namespace twinarm {

TEST_CASE(
    "parallel results are in the order of their work, an exception in place of its own only") {
  std::size_t finished = 0;
  auto results = parallel_results(
      100,
      [](std::size_t k) {
        if (k == 30) throw std::runtime_error("thirty");
        return k * k;
      },
      [&](std::size_t done) { finished = done; });
  REQUIRE(results.size() == 100);
  CHECK(finished <= 100);
  for (std::size_t k = 0; k < 100; ++k) {
    if (k == 30)
      CHECK_THROWS_WITH(results[k].get(), "thirty");
    else
      CHECK(results[k].get() == k * k);
  }
}

TEST_CASE("an exception of the tick, as after Ctrl-C, is that of the parallel work") {
  std::atomic<bool> has_ticked = false;
  const auto work = [&](std::size_t k) {
    while (!has_ticked) std::this_thread::yield();
    return k;
  };
  const auto stop = [&](std::size_t) {
    has_ticked = true;
    throw std::runtime_error("interrupted");
  };
  CHECK_THROWS_WITH(parallel_results(5, work, stop), "interrupted");
}

}  // namespace twinarm
