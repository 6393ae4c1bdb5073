// Unsent messages of one client: the newest of each channel.
//
// Channel 0 is taken first (the others refer to its content), then the channel that has waited
// longest. A replaced message keeps its position, so no channel starves.
#pragma once

#include <algorithm>
#include <vector>

#include "app/lab/server/lab_server.h"

namespace twinarm {

struct OutgoingMessage {
  int channel = 0;
  Bytes bytes;
  bool is_binary = false;
};

class OutgoingQueue {
 public:
  void put(OutgoingMessage message) {
    const auto older = std::ranges::find(waiting_, message.channel, &OutgoingMessage::channel);
    if (older == waiting_.end())
      waiting_.push_back(std::move(message));
    else
      *older = std::move(message);
  }
  std::optional<OutgoingMessage> take() {
    if (waiting_.empty()) return {};
    auto next = std::ranges::find(waiting_, 0, &OutgoingMessage::channel);
    if (next == waiting_.end()) next = waiting_.begin();
    OutgoingMessage taken = std::move(*next);
    waiting_.erase(next);
    return taken;
  }

 private:
  std::vector<OutgoingMessage> waiting_;  // the oldest channel first
};

}  // namespace twinarm
