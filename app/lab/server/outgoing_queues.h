// Outgoing messages of each client: the newest of each channel. Thread-safe.
//
// Channel 0 is taken first (the others refer to its content), then the channel that has waited
// longest. A replaced message keeps its position, so no channel starves.
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "app/lab/server/lab_server.h"

namespace twinarm {

class OutgoingQueues {
 public:
  struct Message {
    Bytes bytes;
    bool is_binary = false;
  };
  void open(ClientId client);
  void close(ClientId client);
  // True: the server's thread must be woken; it was not since clear_wakeup().
  bool put(ClientId client, int channel, const Message& message);
  void clear_wakeup();
  std::optional<Message> take(ClientId client);

 private:
  struct Slot {
    Message message;
    std::uint64_t since = 0;  // order of arrival; 0: empty
  };
  using Queue = std::vector<Slot>;  // by channel

  mutable std::mutex mutex_;
  std::map<ClientId, Queue> queues_;
  std::uint64_t turn_ = 0;
  bool woken_ = false;
};

}  // namespace twinarm
