#include "collision/import/robot/file_search.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "solver/support/text.h"

namespace twinarm {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

// The folders of an environment variable such as PATH.
std::vector<fs::path> folders_in(const char* variable) {
  const char* value = std::getenv(variable);
  std::vector<std::string> folders = split(value ? value : "", ':');
  std::erase(folders, "");
  return {folders.begin(), folders.end()};
}

// `rest` in the package below a folder of packages, with at most one level of repositories between.
fs::path find_below(const fs::path& packages, const fs::path& package, const fs::path& rest) {
  if (packages.filename() == package && is_file(packages / rest)) return packages / rest;
  if (is_file(packages / package / rest)) return packages / package / rest;
  std::error_code error;
  for (fs::directory_iterator i(packages, error), end; !error && i != end; i.increment(error))
    if (is_file(i->path() / package / rest)) return i->path() / package / rest;
  return {};
}

fs::path find_in_package(const fs::path& package, const fs::path& rest, const fs::path& folder) {
  for (fs::path up = folder;; up = up.parent_path()) {
    if (up.filename() == package && is_file(up / rest)) return up / rest;
    if (is_file(up / package / rest)) return up / package / rest;
    if (up == up.parent_path()) break;
  }
  for (const fs::path& packages : folders_in("ROS_PACKAGE_PATH"))
    if (const fs::path found = find_below(packages, package, rest); !found.empty()) return found;
  for (const fs::path& prefix : folders_in("AMENT_PREFIX_PATH"))
    if (is_file(prefix / "share" / package / rest)) return prefix / "share" / package / rest;
  return is_file(folder / rest) ? folder / rest : fs::path();
}

}  // namespace

bool may_name(const FileRoots& roots, const fs::path& file) {
  if (!roots) return true;
  std::error_code error;
  const fs::path path = fs::weakly_canonical(file, error);
  return !error && std::any_of(roots->begin(), roots->end(), [&](const fs::path& root) {
    const fs::path top = fs::weakly_canonical(root, error);
    return !error &&
           std::mismatch(top.begin(), top.end(), path.begin(), path.end()).first == top.end();
  });
}

FilePlace find_named_file(const std::string& kind, const std::string& name, const fs::path& folder,
                          const FileRoots& roots) {
  FilePlace place;
  const std::size_t scheme = name.find("://");
  if (scheme == std::string::npos || name.starts_with("file://")) {
    const fs::path expected =  // an absolute path replaces the folder
        (folder / (scheme == std::string::npos ? name : name.substr(7))).lexically_normal();
    if (!may_name(roots, expected))  // does not reveal whether it exists
      return {{},
              kind + " file '" + name + "' is outside the allowed folders",
              "upload it with the URDF, with a path relative to the URDF",
              "file.missing"};
    if (is_file(expected)) return {expected, "", "", ""};
    place.fix = "expected at " + expected.string();
  } else {
    const std::size_t slash = name.find('/', scheme + 3);
    const bool is_package = name.starts_with("package://") || name.starts_with("model://");
    if (!is_package || slash == std::string::npos || slash == scheme + 3)
      return {{},
              kind + " '" + name + "' has an unknown scheme",
              "give a path relative to the URDF, or package://NAME/PATH, or file://",
              "file.scheme-unknown"};
    const fs::path found = find_in_package(name.substr(scheme + 3, slash - scheme - 3),
                                           name.substr(slash + 1), folder);
    if (!found.empty() && may_name(roots, found))
      return {fs::absolute(found).lexically_normal(), "", "", ""};
    place.fix = "the package was searched above and beside " + folder.string() +
                " and in ROS_PACKAGE_PATH; put it there, or give a path relative to the URDF";
  }
  place.problem = kind + " file '" + name + "' does not exist";
  place.code = "file.missing";
  return place;
}

}  // namespace twinarm
