// The newest value from one thread to another, without a lock and without waiting: three places, of
// which the writer has one, the reader one, and the third changes hands by one atomic exchange.
//
// A lock, or a sequence that the reader tries again, lets a thread of high priority wait for one
// that does not run. One writer and one reader; values in between are lost, never torn.
#pragma once

#include <array>
#include <atomic>

namespace twinarm {

template <class T>
class TripleBuffer {
 public:
  explicit TripleBuffer(const T& first) : place_{first, first, first} {}

  void write(const T& value) noexcept {  // the writer's thread
    place_[back_] = value;
    back_ = middle_.exchange(back_ | kFresh, std::memory_order_acq_rel) & ~kFresh;
  }
  const T& read() noexcept {  // the reader's thread; good until its next read
    if ((middle_.load(std::memory_order_relaxed) & kFresh) != 0)
      front_ = middle_.exchange(front_, std::memory_order_acq_rel) & ~kFresh;
    return place_[front_];
  }

 private:
  static constexpr unsigned kFresh = 4;
  std::array<T, 3> place_;
  unsigned back_ = 0, front_ = 1;     // the writer's, the reader's
  std::atomic<unsigned> middle_ = 2;  // with kFresh where it has not been read
};

}  // namespace twinarm
