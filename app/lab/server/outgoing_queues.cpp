#include "app/lab/server/outgoing_queues.h"

#include <utility>

namespace twinarm {

void OutgoingQueues::open(ClientId client) {
  const std::lock_guard lock(mutex_);
  queues_[client];
}

void OutgoingQueues::close(ClientId client) {
  const std::lock_guard lock(mutex_);
  queues_.erase(client);
}

bool OutgoingQueues::put(ClientId client, int channel, const Message& message) {
  const std::lock_guard lock(mutex_);
  const auto found = queues_.find(client);
  if (found == queues_.end()) return false;  // just disconnected
  Queue& queue = found->second;
  const auto index = static_cast<std::size_t>(channel);
  if (index >= queue.size()) queue.resize(index + 1);
  Slot& slot = queue[index];
  if (slot.since == 0) slot.since = ++turn_;
  slot.message = message;
  return !std::exchange(woken_, true);
}

void OutgoingQueues::clear_wakeup() {
  const std::lock_guard lock(mutex_);
  woken_ = false;
}

std::optional<OutgoingQueues::Message> OutgoingQueues::take(ClientId client) {
  const std::lock_guard lock(mutex_);
  const auto found = queues_.find(client);
  if (found == queues_.end()) return {};
  Queue& queue = found->second;
  Slot* next = nullptr;
  for (Slot& slot : queue) {
    if (slot.since == 0) continue;
    const bool is_first = &slot == queue.data();
    if (!next || is_first || slot.since < next->since) next = &slot;
    if (is_first) break;
  }
  if (!next) return {};
  next->since = 0;
  return std::exchange(next->message, {});
}

}  // namespace twinarm
