// Triple buffer: wait-free transfer of the newest value from one writer thread to one reader
// thread. Writer and reader own one buffer each; the third is exchanged atomically. Values in
// between are lost, never torn.
#pragma once

#include <array>
#include <atomic>

namespace twinarm {

template <class T>
class TripleBuffer {
 public:
  explicit TripleBuffer(const T& first) : buffers_{first, first, first} {}

  void write(const T& value) noexcept {  // the writer's thread
    buffers_[back_] = value;
    back_ = middle_.exchange(back_ | kFresh, std::memory_order_acq_rel) & ~kFresh;
  }
  const T& read() noexcept {  // the reader's thread; valid until its next read
    if ((middle_.load(std::memory_order_relaxed) & kFresh) != 0)
      front_ = middle_.exchange(front_, std::memory_order_acq_rel) & ~kFresh;
    return buffers_[front_];
  }

 private:
  static constexpr unsigned kFresh = 4;
  std::array<T, 3> buffers_;
  unsigned back_ = 0, front_ = 1;     // the writer's, the reader's
  std::atomic<unsigned> middle_ = 2;  // with kFresh until it is read
};

}  // namespace twinarm
