// The command line: words, separated by zero bytes, to what is main() in the program. It runs in a
// folder of its own, which words cannot leave, and its work is bounded.
#include <csignal>
#include <nlohmann/json.hpp>
#include <set>

#include "app/command/command.h"
#include "app/support/progress.h"
#include "app/support/text.h"
#include "tests/fuzz/fuzz_input.h"

int program_main(int count, char** words);  // CMakeLists.txt

namespace twinarm {
namespace {

bool is_pressed = false;  // Ctrl-C, by bounded_commands()

}  // namespace

// In place of the program's: commands that serve, open devices or compute for long are parsed
// only; others that may take long find Ctrl-C pressed when they begin.
const std::vector<Command>& bounded_commands() {
  static const std::set<std::string> parsed{"lab", "hand", "trial", "study", "compare"},
      interrupted{"simulate", "replay", "map", "render", "zwidth", "trace"};
  static const std::vector<Command> all = [] {
    std::vector<Command> bounded = commands();
    for (Command& command : bounded) {
      const bool is_parsed = parsed.contains(command.name);
      if (!is_parsed && !interrupted.contains(command.name)) continue;
      command.prepare = [is_parsed, prepare = command.prepare](CLI::App& app) {
        return [is_parsed, run = prepare(app)](const Words& words) {
          if (is_parsed) return 0;
          std::raise(SIGINT);
          is_pressed = is_interrupted();  // and no timer ends the process
          return run(words);
        };
      };
    }
    return bounded;
  }();
  return all;
}

namespace fuzz {
namespace {

using Json = nlohmann::ordered_json;

// What f prints on a stream.
template <class F>
std::string printed(FILE*& stream, F f) {
  char* bytes = nullptr;
  std::size_t size = 0;
  FILE* const old = std::exchange(stream, ::open_memstream(&bytes, &size));
  f();
  std::fclose(std::exchange(stream, old));
  std::string text(bytes, size);
  std::free(bytes);
  return text;
}

bool is_one_json(const std::string& text) {
  return text.starts_with('{') && Json::accept(text);
}

// Each error is one line with what to do, or what must be.
void check_errors(const std::string& err, const std::string* json) {
  std::size_t count = 0;
  for (const std::string& line : split(err, '\n')) {
    if (!line.starts_with("twinarm: ") || line.starts_with("twinarm: warning: ")) continue;
    ++count;
    require(line.find("; ") != line.npos || line.find(" must ") != line.npos,
            ("no remedy: " + line).c_str());
  }
  require(count > 0, "no error is reported");
  if (!json) return;
  require(is_one_json(*json), "stdout is not one JSON object");
  require(Json::parse(*json).at("errors").size() == count, "stdout and stderr differ in errors");
}

}  // namespace

void command_line(Bytes bytes) {
  namespace fs = std::filesystem;
  enum { kDone = 0, kFailed = 1, kBadInput = 2, kStopped = 3, kInterrupted = 130 };
  if (is_interrupted()) std::_Exit(kInterrupted);  // by the user
  const fs::path source = TWINARM_SOURCE_DIR, all = folder().path() / "line", here = all / "here",
                 temporary = all / "temporary";
  fs::remove_all(all);
  for (const fs::path& made : {here, temporary}) fs::create_directories(made);
  for (const char* file : {"tests/fuzz/seeds/scene/lab.toml", "tests/fuzz/seeds/state/short.json",
                           "tests/fuzz/seeds/recording/bouncing_ball.twinrec",
                           "assets/robots/teaching/double_pendulum.urdf"})
    fs::copy(source / file, here);
  fs::current_path(here);
  ::setenv("TMPDIR", temporary.c_str(), 1);

  std::vector<std::string> words =
      split("twinarm" + std::string(1, '\0') + std::string(bytes), '\0');
  std::vector<char*> pointers;
  for (std::string& word : words) {
    word = replace_all(replace_all(word, "/", "_"), "..", "._");  // it stays in the folder
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  const auto count = static_cast<int>(words.size());
  int code = kDone;
  std::string errors;
  const std::string said = printed(stdout, [&] {
    errors = printed(stderr, [&] { code = program_main(count, pointers.data()); });
  });
  if (std::exchange(is_pressed, false)) forget_interrupt();

  require(fs::is_empty(temporary), "a temporary file is left");
  for (const auto& entry : fs::directory_iterator(all))
    require(entry.path() == here || entry.path() == temporary, "a file outside the folder");
  require(std::set<int>{kDone, kFailed, kBadInput, kStopped, kInterrupted}.contains(code),
          errors.c_str());
  const auto has = [&](const char* word) { return std::ranges::find(words, word) != words.end(); };
  if (code == kBadInput)
    check_errors(errors, has("--json") ? &said : nullptr);
  else if (has("--json") && code != kInterrupted && !said.empty())  // empty: parsed only
    require(is_one_json(said) || has("help") || has("--help") || has("--version") ||
                std::ranges::any_of(words, [](const auto& word) { return word.starts_with("-h"); }),
            "stdout is not one JSON object");
}

}  // namespace fuzz
}  // namespace twinarm
