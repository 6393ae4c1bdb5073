// From one thread to another without a lock: a ring that one writes and one reads. A full ring
// refuses, it never waits.
#pragma once

#include <atomic>
#include <vector>

namespace twinarm {

template <class T>
class SpscRing {
 public:
  explicit SpscRing(std::size_t room) : slots_(room) {}
  // By the writer alone. False: there is no room, and the value is not taken.
  bool push(const T& value) noexcept {
    const std::size_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) == slots_.size()) return false;
    slots_[end % slots_.size()] = value;
    end_.store(end + 1, std::memory_order_release);
    return true;
  }
  // By the reader alone. False: there is nothing.
  bool pop(T& value) noexcept {
    const std::size_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_.load(std::memory_order_acquire)) return false;
    value = slots_[begin % slots_.size()];
    begin_.store(begin + 1, std::memory_order_release);
    return true;
  }

 private:
  std::vector<T> slots_;
  std::atomic<std::size_t> begin_{0}, end_{0};  // of all that were ever pushed
};

}  // namespace twinarm
