// The files that pages have uploaded. Their number and bytes are limited: the oldest are removed.
#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <string>

namespace twinarm {

class UploadFolder {
 public:
  explicit UploadFolder(std::filesystem::path folder, std::size_t most_files = 256,
                        std::size_t most_bytes = std::size_t{256} << 20)
      : folder_(std::move(folder)), most_files_(most_files), most_bytes_(most_bytes) {}

  const std::filesystem::path& path() const { return folder_; }
  // A relative name without "..". Returns the whole path. Throws InputError.
  std::filesystem::path write(const std::string& name, const std::string& bytes);

 private:
  struct Upload {
    std::filesystem::path file;
    std::size_t bytes = 0;
  };
  void remove(const Upload& upload);

  std::filesystem::path folder_;
  std::size_t most_files_, most_bytes_, bytes_ = 0;
  std::deque<Upload> uploads_;  // the oldest first
};

// What a page brings: a robot, a scene or a recording is opened; meshes and textures wait for the
// robot that names them; all else is refused with a word of what it is.
struct BroughtFile {
  std::string path;    // that it is written to: of a robot in .xml or .xacro, .urdf
  bool opens = false;  // else it is kept
  std::string fault;   // empty: none
};

BroughtFile brought_file(const std::string& name, const std::string& bytes);

}  // namespace twinarm
