#include "app/lab/server/lab_server.h"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/random.h>

#include <thread>

#include "app/lab/server/connection_live.inl"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace lab_server {

Bytes Core::packed(const Bytes& body) {
  if (plain_.lock() != body) {
    packed_ = shared_bytes(gzipped(*body));
    plain_ = body;
  }
  return packed_;
}

}  // namespace lab_server

namespace {

using namespace lab_server;
constexpr std::chrono::milliseconds kTimeoutCheck{200};
// A browser opens several connections for a page.
constexpr std::size_t kConnectionsPerClient = 8;
constexpr std::size_t kMaxStrangers = 64;  // connections that have not shown the token

[[noreturn]] void refuse_address(const ServerOptions& options, const std::string& why) {
  const bool is_port = options.port != 0;
  throw InputError(
      {Diagnostic{{},
                  0,
                  is_port ? "--port " + std::to_string(options.port) : "--listen",
                  "cannot listen on address " + options.address + ": " + why,
                  is_port ? "another program may use this port: omit --port to take a free one"
                          : "give a numeric address of this machine, such as 127.0.0.1",
                  "lab.address"}});
}

}  // namespace

struct LabServer::Impl {
  Impl(const ServerOptions& options, ServerHandlers handlers)
      : core(std::make_shared<Core>(options, std::move(handlers))),
        acceptor(core->io),
        timer(core->io) {
    listen();
    accept();
    check_timeouts();
    thread = std::thread([this] { work(); });
    pthread_setname_np(thread.native_handle(), "lab server");
  }
  ~Impl() {
    core->io.stop();
    thread.join();
    core->connections.clear();
  }

  void listen() {
    const ServerOptions& options = core->options;
    error_code error;
    const net::ip::address address = net::ip::make_address(
        options.address == "localhost" ? "127.0.0.1" : options.address, error);
    if (error) refuse_address(options, "not a numeric address");
    const net::ip::tcp::endpoint place(address, options.port);
    acceptor.open(place.protocol(), error);
    if (!error) acceptor.set_option(Acceptor::reuse_address(true), error);
    if (!error) acceptor.bind(place, error);
    if (!error) acceptor.listen(Acceptor::max_listen_connections, error);
    if (error) refuse_address(options, error.message());
    port = acceptor.local_endpoint().port();
    core->hosts.emplace(address.to_string(), port, address.is_loopback(), address.is_unspecified());
    core->cookie = "twinarm_" + std::to_string(port);
    const std::string name = address.is_unspecified() ? "127.0.0.1" : address.to_string();
    url = "http://" + (name.find(':') == name.npos ? name : "[" + name + "]") + ":" +
          std::to_string(port) + "/?token=" + options.token;
  }

  void accept() {
    acceptor.async_accept(core->io, [this](error_code error, Socket socket) {
      // check_timeouts() tries again: without free file descriptors, and after an exception.
      needs_accept = true;
      error_code unknown;
      const std::string address = socket.remote_endpoint(unknown).address().to_string();
      if (!error && has_place(address)) {
        socket.set_option(net::ip::tcp::no_delay(true), error);
        const auto connection = std::make_shared<Connection>(*core, std::move(socket), address);
        core->connections.insert(connection);
        connection->start();
      }
      if (!error) accept();
    });
    needs_accept = false;
  }

  // Strangers have places of their own; the one that has waited longest gives up its place.
  bool has_place(const std::string& address) {
    std::shared_ptr<Connection> oldest;
    std::size_t strangers = 0;
    for (const auto& connection : core->connections) {
      if (!connection->is_stranger()) continue;
      ++strangers;
      if (!oldest || connection->opened_at() < oldest->opened_at()) oldest = connection;
    }
    const std::size_t known = core->connections.size() - strangers;
    if (strangers >= kMaxStrangers) oldest->drop();
    return known < kConnectionsPerClient * core->options.max_clients &&
           std::ranges::count(core->connections, address, &Connection::address) <
               static_cast<long>(kConnectionsPerClient) * core->options.max_of_address;
  }

  void check_timeouts() {
    timer.expires_after(kTimeoutCheck);
    timer.async_wait([this](error_code) {
      check_timeouts();  // also after an exception
      const Clock::time_point now = Clock::now();
      const auto all = core->connections;  // drop() removes them from it
      for (const auto& connection : all) connection->check_timeouts(now);
      if (needs_accept) accept();
    });
  }

  void work() {
    while (!core->io.stopped()) succeeds("server", [this] { core->io.run(); });
  }

  std::shared_ptr<Core> core;
  Acceptor acceptor;
  net::steady_timer timer;
  bool needs_accept = false;
  std::uint16_t port = 0;
  std::string url;
  std::thread thread;
};

LabServer::LabServer(const ServerOptions& options, ServerHandlers handlers)
    : impl_(std::make_unique<Impl>(options, std::move(handlers))) {}
LabServer::~LabServer() = default;

std::uint16_t LabServer::port() const {
  return impl_->port;
}
std::string LabServer::url() const {
  return impl_->url;
}

void LabServer::send(ClientId client, int channel, Bytes message, bool is_binary) {
  net::post(impl_->core->io, [core = impl_->core.get(), client,
                              next = OutgoingMessage{channel, std::move(message), is_binary}] {
    const auto found = std::ranges::find(core->connections, client, &Connection::client);
    if (found != core->connections.end()) (*found)->send(next);
  });
}

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("getrandom: no random bytes");
  return fmt::format("{:02x}", fmt::join(bytes, ""));
}

}  // namespace twinarm
