// Who looks on, who has the hand, and what each wants to see. From any thread.
//
// One client has the hand; the first who comes gets it. Others ask, and get it when the holder
// gives it or leaves.
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
  struct View {
    ClientId holder = 0;          // 0: nobody
    std::vector<ClientId> asked;  // in their order
    std::vector<ClientId> clients;
  };

  void opened(ClientId client);
  void closed(ClientId client);
  void take(ClientId client);
  // False where `from` has nothing to give, or `to` is not there.
  bool give(ClientId from, ClientId to);
  bool has_hand(ClientId client) const;
  // Over HTTP all clients look alike: each has a secret, which only its own state message carries.
  std::string secret(ClientId client) const;  // empty: it is not there
  bool has_hand(std::string_view secret) const;

  void want_layers(ClientId client, std::vector<std::string> names);
  void want_glass(ClientId client, std::optional<long> body);
  std::vector<std::string> layers() const;  // of all clients together, each once
  std::map<ClientId, long> glass() const;   // the body that each looks into

  View view() const;

 private:
  struct Client {
    std::vector<std::string> layers{"bodies", "ghost", "couplings", "contacts"};
    std::optional<long> glass;
    std::string secret = random_token();
  };
  mutable std::mutex mutex_;
  std::map<ClientId, Client> clients_;
  ClientId holder_ = 0;
  std::vector<ClientId> asked_;
};

// The message `state` of docs/reference/lab_protocol.md.

// For all clients alike, but for `you` and `secret`: addressed() puts them in.
std::string state_message(const LabStatus& status, const Clients::View& audience,
                          const std::vector<LabParameter>& knobs,
                          const std::vector<GalleryScene>& gallery);
std::string addressed(const std::string& state, ClientId you, const std::string& secret);

}  // namespace twinarm
