// Connected clients, the one in control, and what each subscribes to. Thread-safe.
//
// The first client gets control. Others request it, and get it when the controlling client grants
// it or leaves.
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/lab/parameters/gallery.h"
#include "app/lab/parameters/parameters.h"
#include "app/lab/server/lab_server.h"
#include "app/lab/session/lab_status.h"

namespace twinarm {

class Clients {
 public:
  struct Client {
    std::vector<std::string> layers{"bodies", "targets", "couplings", "contacts"};
    std::optional<long> inspected;  // body
    std::string address;
    // HTTP requests do not name their client: sent in its own state message.
    std::string secret = random_token();
  };
  struct View {
    ClientId controller = 0;        // 0: none
    std::vector<ClientId> waiting;  // for control, in order
    std::map<ClientId, Client> clients;
    std::vector<std::string> layers() const;  // of all clients, each once
  };

  void opened(ClientId client, const std::string& address = "");
  void closed(ClientId client);
  void take(ClientId client);  // requests control
  // False: `from` is not in control, or `to` is not connected.
  bool give(ClientId from, ClientId to);
  bool has_control(ClientId client) const;             // is in control
  ClientId controller(std::string_view secret) const;  // 0: it is another client's
  std::string name(ClientId client) const;             // "client 3 at 192.168.1.7"

  void want_layers(ClientId client, std::vector<std::string> names);
  void want_inspection(ClientId client, std::optional<long> body);

  View view() const {
    const std::lock_guard lock(mutex_);
    return now_;
  }

 private:
  mutable std::mutex mutex_;
  View now_;
};

// The message `state` of docs/reference/lab_protocol.md, without `you` and `secret`, which
// addressed() adds for each client.
std::string state_message(const LabStatus& status, const Clients::View& clients,
                          const std::vector<LabParameter>& parameters,
                          const std::vector<GalleryScene>& gallery);
std::string addressed(const std::string& state, ClientId you, const std::string& secret);

}  // namespace twinarm
