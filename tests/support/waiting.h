// Waiting for another thread or process, like waiting.py.
#pragma once

#include <chrono>
#include <cstdlib>
#include <functional>
#include <thread>

// Timeout of hanging tests [s]; TWINARM_TEST_TIMEOUT is a factor for slow machines.
inline double longest_wait() {
  const char* factor = std::getenv("TWINARM_TEST_TIMEOUT");
  return 900 * (factor ? std::atof(factor) : 1);
}

inline bool comes_true(const std::function<bool()>& is_so, int period_ms = 5) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(longest_wait());
  while (!is_so()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(period_ms));
  }
  return true;
}
