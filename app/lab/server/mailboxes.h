// What waits for each client: of each channel the newest message, and never more.
//
// Put from any thread, taken by the server's. Channel 0 is taken before all others (it is for what
// the others refer to); of these, the one that has waited longest: its content may be newer than
// its place, so that no channel keeps another from being sent.
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
  // True: the server's thread is to be woken, and has not been since awake().
  bool put(ClientId client, int channel, const Message& message);
  bool put_all(int channel, const Message& message);
  void awake();
  std::optional<Message> take(ClientId client);  // counts it as sent
  void count_received(ClientId client);
  LabServer::Traffic traffic(ClientId client) const;

 private:
  struct Place {
    Message message;
    std::uint64_t since = 0;  // its turn; 0: nothing waits
  };
  struct Box {
    std::vector<Place> places;  // by channel
    LabServer::Traffic traffic;
  };
  void put_in(Box& box, int channel, const Message& message);
  bool wake();

  mutable std::mutex mutex_;
  std::map<ClientId, Box> boxes_;
  std::uint64_t turn_ = 0;
  bool woken_ = false;
};

}  // namespace twinarm
