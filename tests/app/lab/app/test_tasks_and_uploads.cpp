// Task queue and uploaded files.
#include <doctest/doctest.h>

#include <future>
#include <stdexcept>

#include "app/lab/app/uploads.h"
#include "tests/app/scene/model/helpers.h"

namespace twinarm {

TEST_CASE("task queue: an exception is reported, and the next task is executed") {
  std::promise<std::string> reported, done;
  TaskQueue tasks([&](const std::string& why) { reported.set_value(why); });
  tasks.add([] { throw std::runtime_error("no room on the disk"); });
  tasks.add([&] { done.set_value("done"); });
  CHECK(reported.get_future().get() == "no room on the disk");
  CHECK(done.get_future().get() == "done");
}

TEST_CASE("uploads: the oldest files are removed beyond the limits of number and bytes") {
  const TemporaryFolder folder;
  UploadFolder uploads(folder.path() / "uploads", 3, 100);
  const auto names = [&] {
    std::string all;
    for (const char* name : {"a.stl", "b/c/d.stl", "e.stl", "f.stl"})
      if (std::filesystem::exists(uploads.path() / name)) all += std::string(name) + " ";
    return all;
  };
  for (const char* name : {"b/c/d.stl", "a.stl", "e.stl"})
    CHECK(uploads.write(name, "ten bytes.") == uploads.path() / name);
  CHECK(names() == "a.stl b/c/d.stl e.stl ");
  uploads.write("b/c/d.stl", "again");  // now it is the newest
  CHECK(names() == "a.stl b/c/d.stl e.stl ");
  uploads.write("f.stl", "");
  CHECK(names() == "b/c/d.stl e.stl f.stl ");
  uploads.write("f.stl", std::string(90, 'x'));  // 5 + 10 + 90 bytes are too many
  CHECK(names() == "b/c/d.stl f.stl ");
  uploads.write("f.stl", std::string(96, 'x'));
  CHECK(names() == "f.stl ");
  CHECK_FALSE(std::filesystem::exists(uploads.path() / "b"));
}

}  // namespace twinarm
