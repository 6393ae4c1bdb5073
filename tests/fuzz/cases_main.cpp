// Without libFuzzer: a target over all of its cases.
//
//   test_fuzz FOLDER TARGET...     FOLDER/seeds/TARGET/*, FOLDER/found/TARGET/*, and the files and
//                                  folders of the repository that FOLDER/seeds/elsewhere.txt names
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/fuzz/targets.h"

namespace {

namespace fs = std::filesystem;
constexpr unsigned kCaseSeconds = 60;  // of one case [s]; a sanitized build is slow

std::vector<fs::path> cases_of(const fs::path& folder, const std::string& target) {
  std::vector<fs::path> files, folders{folder / "seeds" / target, folder / "found" / target};
  std::ifstream elsewhere(folder / "seeds" / "elsewhere.txt");
  for (std::string name, place; elsewhere >> name >> place;)
    if (const fs::path path = folder.parent_path().parent_path() / place; name == target)
      (fs::is_directory(path) ? folders : files).push_back(path);
  std::error_code ignored;
  for (const fs::path& seeds : folders)
    for (const auto& entry : fs::directory_iterator(seeds, ignored))
      if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

// The name goes out before the case is tried: where it ends the process, it is the last one.
int run_target(const fs::path& folder, const std::string& name) {
  const auto& all = twinarm::fuzz::kTargets;
  const auto target =
      std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.name == name; });
  const std::vector<fs::path> files = cases_of(folder, name);
  if (target == all.end() || files.empty()) {
    std::cerr << "there is no target '" << name << "', or it has no seeds\n";
    return 1;
  }
  for (const fs::path& file : files) {
    std::cout << name << ": " << fs::relative(file, folder).string() << std::endl;
    std::ostringstream bytes;
    bytes << std::ifstream(file, std::ios::binary).rdbuf();
    ::alarm(kCaseSeconds);
    target->run(bytes.str());
  }
  ::alarm(0);
  return 0;
}

}  // namespace

int main(int count, char** words) {
  int failed = count < 3 ? 1 : 0;
  for (int i = 2; i < count; ++i) failed += run_target(words[1], words[i]);
  return failed;
}
