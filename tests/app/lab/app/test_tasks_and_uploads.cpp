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

TEST_CASE("task queue: while many reads wait there is a place for an upload, and for no more") {
  std::promise<void> begun, go_on;
  TaskQueue tasks([](const std::string&) {});
  tasks.add([&] {
    begun.set_value();
    go_on.get_future().wait();
  });
  begun.get_future().wait();
  std::size_t reads = 0, uploads = 0;
  while (tasks.add([] {}, false)) ++reads;
  while (tasks.add([] {})) ++uploads;
  go_on.set_value();
  CHECK(reads == TaskQueue::kMaxReads);
  CHECK(reads + uploads == TaskQueue::kMax);
  CHECK(uploads >= 4);
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
    CHECK(uploads.write(1, name, "ten bytes.") == uploads.path() / name);
  CHECK(names() == "a.stl b/c/d.stl e.stl ");
  uploads.write(1, "b/c/d.stl", "again");  // now it is the newest
  CHECK(names() == "a.stl b/c/d.stl e.stl ");
  uploads.write(1, "f.stl", "");
  CHECK(names() == "b/c/d.stl e.stl f.stl ");
  uploads.write(1, "f.stl", std::string(90, 'x'));  // 5 + 10 + 90 bytes are too many
  CHECK(names() == "b/c/d.stl f.stl ");
  uploads.write(1, "f.stl", std::string(96, 'x'));
  CHECK(names() == "f.stl ");
  CHECK_FALSE(std::filesystem::exists(uploads.path() / "b"));
}

TEST_CASE("uploads: a client does not displace files of one that has less") {
  const TemporaryFolder folder;
  UploadFolder uploads(folder.path() / "uploads", 10, 1000);
  const auto has = [&](const std::string& name) {
    return std::filesystem::exists(uploads.path() / name);
  };
  for (const char* name : {"a.stl", "b.stl"}) uploads.write(1, name, std::string(100, 'x'));
  for (int n = 0; n < 30; ++n)  // too many bytes
    uploads.write(2, std::to_string(n) + ".obj", std::string(300, 'x'));
  for (int n = 0; n < 30; ++n)  // too many files
    uploads.write(2, std::to_string(n) + ".png", "");
  CHECK(has("a.stl"));
  CHECK(has("b.stl"));
  CHECK(has("29.png"));
  CHECK_FALSE(has("21.png"));
  CHECK_FALSE(has("29.obj"));
  uploads.write(3, "large.stl", std::string(900, 'x'));  // one file, the largest share
  CHECK(has("large.stl"));
}

}  // namespace twinarm
