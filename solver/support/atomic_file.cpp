#include "solver/support/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <utility>

#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

// A lock on the whole file, which ends with the open file (fcntl(2)).
struct flock whole_file() {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  return lock;
}

// Whether another program writes this file now.
bool is_locked(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return false;
  struct flock lock = whole_file();
  const bool locked = ::fcntl(descriptor, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  ::close(descriptor);
  return locked;
}

// Brings the folder's list of files to the disk.
void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

// Who has set the owner to kClaimed may use the path.
struct Place {
  std::atomic<pid_t> owner{kFree};  // process; a forked one removes nothing of its parent
  std::array<char, 4096> path{};
  static constexpr pid_t kFree = 0, kClaimed = -1;

  bool claim(pid_t from) { return owner.compare_exchange_strong(from, kClaimed); }
};
std::array<Place, 64> places;

}  // namespace

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

TemporaryPath::TemporaryPath(const std::filesystem::path& path) {
  const std::string& name = path.native();
  if (name.size() >= Place().path.size()) place_ = places.size();
  while (place_ < places.size() && !places[place_].claim(Place::kFree)) ++place_;
  if (place_ >= places.size()) return;  // too long or too many: stays after a signal
  Place& mine = places[place_];
  mine.path[name.copy(mine.path.data(), name.size())] = '\0';
  mine.owner = ::getpid();
}

TemporaryPath::~TemporaryPath() {
  if (place_ < places.size() && places[place_].claim(::getpid()))
    places[place_].owner = Place::kFree;
}

void remove_temporary_paths() noexcept {
  for (Place& place : places) {
    if (!place.claim(::getpid()) || ::unlink(place.path.data()) == 0 || errno != EISDIR) continue;
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) continue;
    if (::_Fork() == 0) {
      ::execl("/bin/rm", "rm", "-rf", "--", place.path.data(), nullptr);
      ::_exit(1);
    }
    ::close(ends[1]);
    char none = 0;
    [[maybe_unused]] const ssize_t closed = ::read(ends[0], &none, 1);  // when rm has ended
  }
}

UnfinishedFile::UnfinishedFile(std::filesystem::path file, std::filesystem::path temporary)
    : file_(std::move(file)), temporary_(std::move(temporary)) {
  std::error_code ignored;
  if (std::filesystem::is_other(std::filesystem::status(file_, ignored))) fail(ENODEV);
  if (is_locked(temporary_)) fail(EBUSY);
  ::unlink(temporary_.c_str());
  constexpr int kNew = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
  descriptor_ = ::open(temporary_.c_str(), kNew, 0666);
  if (descriptor_ < 0) fail(errno);
  const struct flock lock = whole_file();
  ::fcntl(descriptor_, F_OFD_SETLK, &lock);
  listed_.emplace(temporary_);
}

UnfinishedFile::~UnfinishedFile() {
  if (listed_) ::unlink(temporary_.c_str());
  ::close(descriptor_);
}

void UnfinishedFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t wrote = ::write(descriptor_, bytes.data(), bytes.size());
    if (wrote < 0 && errno != EINTR) fail(errno);
    if (wrote > 0) bytes.remove_prefix(static_cast<std::size_t>(wrote));
  }
}

void UnfinishedFile::keep() {
  listed_.reset();
}

void UnfinishedFile::finish() {
  const bool synced = ::fsync(descriptor_) == 0 || errno == EINVAL || errno == ENOTSUP;
  if (!synced || std::rename(temporary_.c_str(), file_.c_str()) != 0) fail(errno);
  keep();
  sync_folder(folder_of(file_));
}

void UnfinishedFile::fail(int error) const {
  const std::string why = error == EBUSY ? "another program is writing it" : std::strerror(error);
  throw InputError({{file_.string(), 0, "", "the file cannot be written: " + why,
                     error == EBUSY ? "wait for its end, or give another name"
                                    : "choose an existing, writable folder with free space",
                     "file.unwritable"}});
}

void write_whole_file(const std::filesystem::path& file, const std::string& bytes) {
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);  // opening reports a failure
  // The process id makes the temporary name unique among programs that write the same file, the
  // lock among the threads of this one.
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  UnfinishedFile out(file, file.string() + "." + std::to_string(::getpid()) + ".tmp");
  out.write(bytes);
  out.finish();
}

}  // namespace twinarm
