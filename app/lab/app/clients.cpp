#include "app/lab/app/clients.h"

#include <algorithm>
#include <set>

#include "app/lab/server/http_text.h"

namespace twinarm {

void Audience::opened(ClientId client) {
  const std::lock_guard lock(mutex_);
  clients_.try_emplace(client);
  if (holder_ == 0) holder_ = client;
}

void Audience::closed(ClientId client) {
  const std::lock_guard lock(mutex_);
  clients_.erase(client);
  std::erase(asked_, client);
  if (holder_ != client) return;
  holder_ = 0;
  if (!asked_.empty()) {
    holder_ = asked_.front();
    asked_.erase(asked_.begin());
  } else if (clients_.size() == 1) {
    holder_ = clients_.begin()->first;
  }
}

void Audience::take(ClientId client) {
  const std::lock_guard lock(mutex_);
  if (!clients_.contains(client) || holder_ == client) return;
  if (holder_ == 0)
    holder_ = client;
  else if (std::ranges::find(asked_, client) == asked_.end())
    asked_.push_back(client);
}

bool Audience::give(ClientId from, ClientId to) {
  const std::lock_guard lock(mutex_);
  if (holder_ != from || !clients_.contains(to)) return false;
  holder_ = to;
  std::erase(asked_, to);
  return true;
}

bool Audience::has_hand(ClientId client) const {
  const std::lock_guard lock(mutex_);
  return holder_ == client;
}

std::string Audience::secret(ClientId client) const {
  const std::lock_guard lock(mutex_);
  const auto found = clients_.find(client);
  return found == clients_.end() ? "" : found->second.secret;
}

bool Audience::has_hand(std::string_view secret) const {
  const std::lock_guard lock(mutex_);
  const auto found = clients_.find(holder_);
  return found != clients_.end() && is_secret(secret, found->second.secret);
}

void Audience::want_layers(ClientId client, std::vector<std::string> names) {
  const std::lock_guard lock(mutex_);
  if (const auto found = clients_.find(client); found != clients_.end())
    found->second.layers = std::move(names);
}

void Audience::want_glass(ClientId client, std::optional<long> body) {
  const std::lock_guard lock(mutex_);
  if (const auto found = clients_.find(client); found != clients_.end()) found->second.glass = body;
}

std::vector<std::string> Audience::layers() const {
  const std::lock_guard lock(mutex_);
  std::set<std::string> all;
  for (const auto& [id, client] : clients_) all.insert(client.layers.begin(), client.layers.end());
  return {all.begin(), all.end()};
}

std::map<ClientId, long> Audience::glass() const {
  const std::lock_guard lock(mutex_);
  std::map<ClientId, long> all;
  for (const auto& [id, client] : clients_)
    if (client.glass) all[id] = *client.glass;
  return all;
}

Audience::View Audience::view() const {
  const std::lock_guard lock(mutex_);
  View view{holder_, asked_, {}};
  for (const auto& [id, client] : clients_) view.clients.push_back(id);
  return view;
}

}  // namespace twinarm
