#include "app/lab/session/inbox.h"

#include <utility>

namespace twinarm {
namespace {

constexpr std::size_t kMaxCommands = 4096;

}  // namespace

void Inbox::push(LabCommand command) {
  locked([&] {
    if (contents_.commands.size() < kMaxCommands) contents_.commands.push_back(std::move(command));
  });
}

void Inbox::push(Built built) {
  locked([&] { contents_.built.push_back(std::move(built)); });
}

void Inbox::push_refused(long number) {
  locked([&] { contents_.refused = number; });
}

void Inbox::note(const std::string& level, const std::string& text) {
  locked([&] {
    if (notes_.size() == kMaxNotes) notes_.pop_front();
    notes_.push_back({0, level, text});
  });
}

bool Inbox::stop() {
  bool was_stopped = false;
  locked([&] { was_stopped = std::exchange(stop_, true); });
  return !was_stopped;
}

Inbox::Contents Inbox::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(contents_, {});
}

std::deque<LabNote> Inbox::take_notes() {
  const std::lock_guard lock(mutex_);
  return std::exchange(notes_, {});
}

bool Inbox::is_stopped() const {
  const std::lock_guard lock(mutex_);
  return stop_;
}

void Inbox::sleep_until(std::chrono::steady_clock::time_point time) {
  std::unique_lock lock(mutex_);
  came_.wait_until(lock, time, [this] {
    return stop_ || contents_.refused || !contents_.commands.empty() || !contents_.built.empty() ||
           !notes_.empty();
  });
}

}  // namespace twinarm
