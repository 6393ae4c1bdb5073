// Log of who changed what.
#include <doctest/doctest.h>

#include <vector>

#include "app/lab/app/audit_log.h"
#include "app/lab/session/lab_command.h"

namespace twinarm {
namespace {

using std::chrono::milliseconds;

struct Printed {
  std::vector<std::string> lines;
  AuditLog log;
  AuditLog::Time now{std::chrono::hours(1)};

  void add(const std::string& change, bool is_movement = false, const char* client = "client 3") {
    const std::string line = log.line(client, change, is_movement, now);
    if (!line.empty()) lines.push_back(line);
  }
  bool has_last(const std::string& words) const {
    return !lines.empty() && lines.back().find(words) != std::string::npos;
  }
};

TEST_CASE("audit log: a line has the time, the client and the change, in printable characters") {
  Printed printed;
  printed.add("scene name = \"a\x1b[2J\nfake line\xe2\x80\xae\"");
  REQUIRE(printed.lines.size() == 1);
  const std::string& line = printed.lines[0];
  CHECK(line.find("Z client 3: scene name = \"a\\x1b[2J\\x0afake line\\xe2\\x80\\xae\"\n") == 19);
  CHECK(line[10] == 'T');
  printed.add(std::string(70000, 'x'));
  CHECK(printed.lines[1].size() < 400);
  CHECK(printed.has_last(".. (70000 bytes)\n"));
}

TEST_CASE("audit log: a flood is limited to one line a second, and what is left out is counted") {
  Printed printed;
  for (int n = 0; n < 100'000; ++n, printed.now += milliseconds(1)) printed.add("reset");
  CHECK(printed.lines.size() >= 118);
  CHECK(printed.lines.size() <= 120);
  CHECK(printed.has_last(" left out)\n"));
  printed.now += std::chrono::seconds(10);
  printed.add("play on = false");
  CHECK(printed.has_last(" before it left out)\n"));
  printed.add("play on = true");
  CHECK(printed.has_last("true\n"));
}

TEST_CASE("audit log: a drag is one line a minute of each client") {
  Printed printed;
  for (int n = 0; n < 90'000; ++n, printed.now += milliseconds(1)) printed.add("axes", true);
  CHECK(printed.lines.size() == 2);
  printed.add("axes", true, "client 4");
  CHECK(printed.has_last("client 4: axes\n"));
  printed.add("joint", true, "client 4");
  CHECK(printed.has_last("client 4: joint\n"));
}

TEST_CASE("text of a command: its described keys, whatever else the client sends") {
  CHECK(text_of_command(R"({"do": "set", "x": "long", "changes": ["a=1", "b.c=2"], "y": {}})") ==
        "set changes = [\"a=1\", \"b.c=2\"] ");
  CHECK(text_of_command(R"({"do": "drag_stylus", "goal": [1, 2, 3]})") == "drag_stylus");
  CHECK(text_of_command(R"({"do": "reset"})") == "reset ");
  CHECK_FALSE(text_of_command(R"({"do": "branch", "at": null, "changes": []})").empty());
}

}  // namespace
}  // namespace twinarm
