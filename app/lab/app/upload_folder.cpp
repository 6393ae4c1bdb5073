#include "app/lab/app/upload_folder.h"

#include <algorithm>

#include "solver/support/atomic_file.h"

namespace twinarm {

std::filesystem::path UploadFolder::write(const std::string& name, const std::string& bytes) {
  const std::filesystem::path file = (folder_ / name).lexically_normal();
  const auto same = std::find_if(uploads_.begin(), uploads_.end(),
                                 [&](const Upload& upload) { return upload.file == file; });
  if (same != uploads_.end()) {
    bytes_ -= same->bytes;
    uploads_.erase(same);
  }
  while (!uploads_.empty() &&
         (uploads_.size() >= most_files_ || bytes_ + bytes.size() > most_bytes_)) {
    remove(uploads_.front());
    uploads_.pop_front();
  }
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  write_whole_file(file, bytes);
  uploads_.push_back({file, bytes.size()});
  bytes_ += bytes.size();
  return file;
}

// With the folders that are empty then.
void UploadFolder::remove(const Upload& upload) {
  bytes_ -= upload.bytes;
  std::error_code error;
  for (std::filesystem::path path = upload.file; path != folder_ && !error;
       path = path.parent_path())
    std::filesystem::remove(path, error);
}

}  // namespace twinarm
