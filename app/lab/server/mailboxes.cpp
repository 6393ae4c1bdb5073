#include "app/lab/server/mailboxes.h"

#include <utility>

namespace twinarm {

void OutgoingQueues::open(ClientId client) {
  const std::lock_guard lock(mutex_);
  boxes_[client];
}

void OutgoingQueues::close(ClientId client) {
  const std::lock_guard lock(mutex_);
  boxes_.erase(client);
}

bool OutgoingQueues::put(ClientId client, int channel, const Message& message) {
  const std::lock_guard lock(mutex_);
  const auto found = boxes_.find(client);
  if (found == boxes_.end()) return false;  // it has just left
  put_in(found->second, channel, message);
  return wake();
}

bool OutgoingQueues::put_all(int channel, const Message& message) {
  const std::lock_guard lock(mutex_);
  for (auto& [client, box] : boxes_) put_in(box, channel, message);
  return !boxes_.empty() && wake();
}

void OutgoingQueues::put_in(Box& box, int channel, const Message& message) {
  const auto index = static_cast<std::size_t>(channel);
  if (index >= box.places.size()) box.places.resize(index + 1);
  Place& place = box.places[index];
  if (place.since != 0)
    ++box.traffic.replaced;
  else
    place.since = ++turn_;
  place.message = message;
}

bool OutgoingQueues::wake() {
  return !std::exchange(woken_, true);
}

void OutgoingQueues::awake() {
  const std::lock_guard lock(mutex_);
  woken_ = false;
}

std::optional<OutgoingQueues::Message> OutgoingQueues::take(ClientId client) {
  const std::lock_guard lock(mutex_);
  const auto found = boxes_.find(client);
  if (found == boxes_.end()) return {};
  Box& box = found->second;
  Place* next = nullptr;
  for (Place& place : box.places) {
    if (place.since == 0) continue;
    const bool is_first = &place == box.places.data();
    if (!next || is_first || place.since < next->since) next = &place;
    if (is_first) break;
  }
  if (!next) return {};
  next->since = 0;
  ++box.traffic.sent;
  box.traffic.bytes += next->message.bytes->size();
  return std::exchange(next->message, {});
}

void OutgoingQueues::count_received(ClientId client) {
  const std::lock_guard lock(mutex_);
  const auto found = boxes_.find(client);
  if (found != boxes_.end()) ++found->second.traffic.received;
}

LabServer::Traffic OutgoingQueues::traffic(ClientId client) const {
  const std::lock_guard lock(mutex_);
  const auto found = boxes_.find(client);
  return found == boxes_.end() ? LabServer::Traffic{} : found->second.traffic;
}

}  // namespace twinarm
