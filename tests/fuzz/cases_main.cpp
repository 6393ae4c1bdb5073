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

struct Case {
  fs::path file;
  std::string before;  // a byte in front of the file's own: the format of a mesh
};

std::vector<Case> cases_of(const fs::path& folder, const std::string& target) {
  std::vector<Case> cases;
  std::vector<fs::path> folders{folder / "seeds" / target, folder / "found" / target};
  std::ifstream elsewhere(folder / "seeds" / "elsewhere.txt");
  for (std::string line; std::getline(elsewhere, line);) {
    std::istringstream words(line);
    std::string name, place;
    int byte = 0;
    words >> name >> place;
    if (name != target) continue;
    const fs::path path = folder.parent_path().parent_path() / place;
    if (fs::is_directory(path))
      folders.push_back(path);
    else
      cases.push_back({path, words >> byte ? std::string(1, static_cast<char>(byte)) : ""});
  }
  std::error_code ignored;
  for (const fs::path& seeds : folders)
    for (const auto& entry : fs::directory_iterator(seeds, ignored))
      if (entry.is_regular_file()) cases.push_back({entry.path(), ""});
  std::sort(cases.begin(), cases.end(),
            [](const Case& a, const Case& b) { return a.file < b.file; });
  return cases;
}

// The name goes out before the case is tried: where it ends the process, it is the last one.
int run_target(const fs::path& folder, const std::string& name) {
  const auto& all = twinarm::fuzz::kTargets;
  const auto target =
      std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.name == name; });
  const std::vector<Case> cases = cases_of(folder, name);
  if (target == all.end() || cases.empty()) {
    std::cerr << "there is no target '" << name << "', or it has no seeds\n";
    return 1;
  }
  for (const auto& [file, before] : cases) {
    std::cout << name << ": " << fs::relative(file, folder).string() << std::endl;
    std::ostringstream bytes;
    bytes << before << std::ifstream(file, std::ios::binary).rdbuf();
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
