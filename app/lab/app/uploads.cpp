#include "app/lab/app/uploads.h"

#include <algorithm>
#include <array>
#include <map>

#include "solver/support/atomic_file.h"
#include "solver/support/text.h"

namespace twinarm {
namespace {

constexpr std::array kOpened{".toml", ".urdf", ".twinrec"};
constexpr std::array kKept{".stl", ".obj", ".ply", ".dae", ".gltf", ".glb",
                           ".mtl", ".bin", ".png", ".jpg", ".jpeg"};

// Name of the first element; empty: none.
std::string root_of(const std::string& xml) {
  for (std::size_t at = 0; (at = xml.find('<', at)) != xml.npos;) {
    const char next = at + 1 < xml.size() ? xml[at + 1] : ' ';
    if (next != '?' && next != '!') {
      const std::size_t end = std::min(xml.find_first_of(" \t\r\n/>", at + 1), xml.size());
      return xml.substr(at + 1, end - at - 1);
    }
    const bool is_comment = xml.compare(at, 4, "<!--") == 0;
    at = xml.find(is_comment ? "-->" : ">", at);
    if (at == xml.npos) break;
  }
  return "";
}

std::string why_no_robot(const std::string& root) {
  if (root == "mujoco") return "a MuJoCo MJCF file, not a URDF; convert it to URDF first";
  if (root == "sdf") return "an SDFormat file, not a URDF; convert it to URDF first";
  if (root.empty()) return "not an XML file; expected a URDF (root element <robot>)";
  return "root element <" + root.substr(0, 40) + ">; expected a URDF (root element <robot>)";
}

}  // namespace

std::filesystem::path UploadFolder::write(ClientId client, const std::string& name,
                                          const std::string& bytes) {
  const std::filesystem::path file = (folder_ / name).lexically_normal();
  const auto same =
      std::ranges::find_if(uploads_, [&](const Upload& upload) { return upload.file == file; });
  if (same != uploads_.end()) {
    bytes_ -= same->bytes;
    uploads_.erase(same);
  }
  while (!uploads_.empty() && (uploads_.size() >= max_files_ || bytes_ + bytes.size() > max_bytes_))
    remove_one({client, file, bytes.size()});
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  write_whole_file(file, bytes);
  uploads_.push_back({client, file, bytes.size()});
  bytes_ += bytes.size();
  return file;
}

// To make room for `next`; with folders that become empty.
void UploadFolder::remove_one(const Upload& next) {
  std::map<ClientId, std::size_t> shares{{next.client, next.bytes}};
  for (const Upload& one : uploads_) shares[one.client] += one.bytes + max_bytes_ / max_files_;
  using Share = std::pair<const ClientId, std::size_t>;
  const ClientId largest = std::ranges::max_element(shares, {}, &Share::second)->first;
  auto oldest = std::ranges::find(uploads_, largest, &Upload::client);
  if (oldest == uploads_.end()) oldest = uploads_.begin();  // `next` alone
  bytes_ -= oldest->bytes;
  std::error_code error;
  for (std::filesystem::path path = oldest->file; path != folder_ && !error;
       path = path.parent_path())
    std::filesystem::remove(path, error);
  uploads_.erase(oldest);
}

UploadedFile classify_upload(const std::string& name, const std::string& bytes) {
  std::filesystem::path path = name;
  std::string end = lower_case(path.extension().string());
  UploadedFile file{name, false, ""};
  const auto is_one_of = [&](const auto& all) { return std::ranges::find(all, end) != all.end(); };
  if (end == ".xml" || end == ".xacro") {
    const std::string root = root_of(bytes);
    if (root != "robot") {
      file.fault = why_no_robot(root);
      return file;
    }
    end = ".urdf";  // the importer refuses unexpanded xacro macros
  }
  file.opens = is_one_of(kOpened);
  if (file.opens)
    file.path = path.replace_extension(end).string();
  else if (!is_one_of(kKept))
    file.fault =
        "unknown file type; the lab opens robots (.urdf, .xml), scenes (.toml) and recordings "
        "(.twinrec), with meshes (.stl .obj .ply .dae .gltf .glb) and textures (.png .jpg)";
  return file;
}

}  // namespace twinarm
