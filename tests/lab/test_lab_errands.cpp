// What the lab does for requests over HTTP beside its run.
#include <doctest/doctest.h>

#include <future>
#include <stdexcept>

#include "app/lab/app/task_queue.h"

namespace twinarm {

TEST_CASE("errands: one that throws is reported, and the next one is done") {
  std::promise<std::string> reported, done;
  Errands errands([&](const std::string& why) { reported.set_value(why); });
  errands.add([] { throw std::runtime_error("no room on the disk"); });
  errands.add([&] { done.set_value("done"); });
  CHECK(reported.get_future().get() == "no room on the disk");
  CHECK(done.get_future().get() == "done");
}

}  // namespace twinarm
