// The same scenes in every engine: how far each is from the truth, and what a step costs it. Prints
// JSON (docs/peers.md says what is in it); table and figure are scripts/peers'.
#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "benchmarks/peers/peer_progress.h"
#include "benchmarks/speed/options.h"

namespace twinarm::peers {
namespace {

using speed::positive, speed::split;

constexpr const char* usage =
    R"(Runs the same scenes in all engines of this build; prints JSON on stdout, progress on stderr.

  bench_peers [--cases A,B] [--engines A,B] [--work-precision]
              [--repetitions N] [--budget S] [--quick] [--list]

  --cases           names or groups; default: all (--list prints them, and the engines)
  --engines         default: all of this build
  --work-precision  instead of steps of 1 ms: many steps and tolerances, of the cases that are so marked
  --repetitions     default 3; in each, all engines run one after the other
  --budget          seconds of one run, default 20; what is not done by then is stopped, and said
  --quick           one repetition, budget 0.2 s: to see that it runs

Example: bench_peers --cases C2,E2-slide --engines twinarm,mujoco
Exit codes: 0 done; 2 bad option.
)";

struct Options {
  std::vector<std::string> cases, engines;  // empty: all
  bool work_precision = false;
  int repetitions = 3;
  double budget = 20;
  bool list = false, help = false;
};

std::vector<PeerCase> all_cases() {
  std::vector<PeerCase> all;
  for (auto* family : {&smooth_peer_cases, &contact_peer_cases, &engine_peer_cases})
    for (PeerCase& c : family()) all.push_back(std::move(c));
  return all;
}

bool chosen(const std::vector<std::string>& list, const std::string& name) {
  return list.empty() || std::ranges::find(list, name) != list.end();
}

void check(const Options& o) {
  const std::vector<PeerCase> cases = all_cases();
  for (const std::string& wanted : o.cases)
    if (std::ranges::none_of(
            cases, [&](const PeerCase& c) { return c.name == wanted || c.group == wanted; }))
      throw std::invalid_argument("no case or group " + wanted + "; see --list");
  std::vector<std::string> known = missing_peers();  // skipped, and said in the answer
  for (const auto& peer : all_peers()) known.push_back(peer->name());
  for (const std::string& wanted : o.engines)
    if (std::ranges::find(known, wanted) == known.end())
      throw std::invalid_argument("no engine " + wanted + "; see --list");
}

Options options_from(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    const auto value = [&]() -> std::string {
      if (i + 1 >= argc) throw std::invalid_argument(name + " needs a value");
      return argv[++i];
    };
    if (name == "--cases")
      o.cases = split(value());
    else if (name == "--engines")
      o.engines = split(value());
    else if (name == "--work-precision")
      o.work_precision = true;
    else if (name == "--repetitions")
      o.repetitions = positive<int>(value());
    else if (name == "--budget")
      o.budget = positive<double>(value());
    else if (name == "--quick")
      o.repetitions = 1, o.budget = 0.2;
    else if (name == "--list")
      o.list = true;
    else if (name == "--help" || name == "-h")
      o.help = true;
    else
      throw std::invalid_argument("unknown option " + name);
  }
  check(o);
  return o;
}

std::vector<Row> rows_of(const PeerCase& c, Peers& peers, const Options& options) {
  std::vector<Row> rows;
  for (const auto& peer : peers) {
    if (!chosen(options.engines, peer->name())) continue;
    for (const Scheme& scheme : peer->schemes(c.scene)) {
      if (!options.work_precision) {
        rows.push_back({peer.get(), &c, scheme, scheme.adaptive ? 1e-10 : c.step});
        continue;
      }
      for (int k = 0; k < 9; ++k)
        rows.push_back({peer.get(), &c, scheme,
                        scheme.adaptive ? std::pow(10.0, -3 - k) : std::ldexp(0.01, -k)});
    }
  }
  return rows;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n') continue;
    out += c;
  }
  return out + '"';
}
std::string number(double x) {  // JSON has neither infinity nor NaN
  if (!std::isfinite(x)) return "null";
  std::ostringstream out;
  out.precision(17);
  out << x;
  return out.str();
}

// Objects as the items of a list.
class List {
 public:
  explicit List(const char* name) {
    std::cout << (first_of_all_ ? "{" : ",\n ") << quoted(name) << ": [";
    first_of_all_ = false;
  }
  ~List() { std::cout << "]"; }
  List(const List&) = delete;
  List& operator=(const List&) = delete;
  void add(const std::string& object) {
    std::cout << separator_ << object << std::flush;
    separator_ = ",\n  ";
  }

 private:
  static inline bool first_of_all_ = true;
  const char* separator_ = "\n  ";
};

std::string object(const Row& row) {
  const double median = median_of(row.seconds), spread = spread_of(row.seconds);
  std::ostringstream out;
  out << "{\"case\": " << quoted(row.test->name) << ", \"group\": " << quoted(row.test->group)
      << ", \"engine\": " << quoted(row.peer->name()) << ", \"scheme\": " << quoted(row.scheme.name)
      << ", \"step\": " << number(row.scheme.adaptive ? NAN : row.h)
      << ", \"tolerance\": " << number(row.scheme.adaptive ? row.h : NAN)
      << ", \"error\": " << number(row.error) << ", \"unit\": " << quoted(row.test->unit)
      << ", \"seconds\": " << number(median) << ", \"spread\": " << number(spread)
      << ", \"ns_per_step\": "
      << number(row.steps > 0 ? 1e9 * median / static_cast<double>(row.steps) : NAN)
      << ", \"stopped\": " << (row.stopped.empty() ? "null" : quoted(row.stopped)) << "}";
  return out.str();
}

std::vector<PeerCase> chosen_cases(const Options& options) {
  std::vector<PeerCase> cases = all_cases();
  std::erase_if(cases, [&](const PeerCase& c) {
    return (options.work_precision && !c.work_precision) ||
           !(chosen(options.cases, c.name) || chosen(options.cases, c.group));
  });
  return cases;
}

void print_cases(const std::vector<PeerCase>& cases, const Peers& peers) {
  {
    List list("cases");
    for (const PeerCase& c : cases) {
      std::string published;
      for (const auto& [who, error] : c.published)
        published += (published.empty() ? "" : ", ") + quoted(who) + ": " + number(error);
      list.add("{\"name\": " + quoted(c.name) + ", \"group\": " + quoted(c.group) +
               ", \"what\": " + quoted(c.what) + ", \"unit\": " + quoted(c.unit) +
               ", \"duration\": " + number(c.duration) + ", \"published\": {" + published + "}}");
    }
  }
  List refused("refused");
  for (const PeerCase& c : cases)
    for (const auto& peer : peers)
      if (const std::string why = peer->refusal(c.scene); !why.empty())
        refused.add("{\"case\": " + quoted(c.name) + ", \"engine\": " + quoted(peer->name()) +
                    ", \"why\": " + quoted(why) + "}");
}

int run(const Options& options) {
  if (options.help) {
    std::cout << usage;
    return 0;
  }
  Peers peers = all_peers();
  const std::vector<PeerCase> cases = chosen_cases(options);
  if (options.list) {
    for (const PeerCase& c : cases)
      std::cout << c.name << "  " << c.group << "  " << c.what << '\n';
    for (const auto& peer : peers) std::cout << peer->name() << '\n';
    return 0;
  }
  print_cases(cases, peers);
  {
    List missing("missing");
    for (const std::string& name : missing_peers()) {
      std::cerr << "bench_peers: " << name << " is not in this build: skipped\n";
      missing.add(quoted(name));
    }
  }
  Progress progress(options.repetitions, options.budget);
  std::vector<std::vector<Row>> rows;  // by case
  for (const PeerCase& c : cases) {
    rows.push_back(rows_of(c, peers, options));
    for (const Row& row : rows.back()) progress.expect(row);
  }
  {
    List list(options.work_precision ? "work_precision" : "rows");
    for (auto& of_case : rows) {
      measure(of_case, options.repetitions, options.budget, progress);
      for (const Row& row : of_case) list.add(object(row));
    }
  }
  std::cout << "}\n";
  return 0;
}

}  // namespace
}  // namespace twinarm::peers

int main(int argc, char** argv) {
  std::optional<twinarm::peers::Options> options;
  try {
    options = twinarm::peers::options_from(argc, argv);
  } catch (const std::exception& fault) {
    std::cerr << "bench_peers: " << fault.what() << "; see --help\n";
    return 2;
  }
  try {
    return twinarm::peers::run(*options);
  } catch (const std::exception& fault) {
    std::cerr << "bench_peers: " << fault.what() << '\n';
    return 4;
  }
}
