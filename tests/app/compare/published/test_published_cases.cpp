// Cases of assets/published/: what a case file must say, and that a wrong number fails.
#include <doctest/doctest.h>

#include <fstream>

#include "app/compare/published/published_cases.h"
#include "app/support/files.h"

using namespace twinarm;

namespace {

const std::string kHead =
    "title = \"a mass on a spring\"\nsource = \"a book\"\naddress = \"https://example.org\"\n"
    "model = \"scene.toml\"\n";
const std::string kScene =
    "integrator = \"rk4\"\nstep = 0.001\n[[body]]\nname = \"mass\"\nmass = 1\n"
    "shape = { sphere = { radius = 0.1 } }\n";

std::string number(const std::string& quantity, const std::string& unit,
                   const std::string& published, const std::string& more = "time = 1\n") {
  return "[[number]]\nquantity = \"" + quantity + "\"\nunit = \"" + unit + "\"\npublished = \"" +
         published + "\"\n" + more;
}

class CaseFolder {
 public:
  explicit CaseFolder(const std::string& text, const std::string& scene = kScene) {
    std::ofstream(file()) << text;
    std::ofstream(files_.folder() / "scene.toml") << scene;
  }
  std::filesystem::path file() const { return files_.folder() / "case.toml"; }

 private:
  TemporaryFiles files_{"twinarm-published"};
};

// In units of the last digit.
double error_of(const std::string& numbers) {
  const CaseFolder folder(kHead + numbers);
  return case_of(read_published_case(folder.file(), "case")).run().error;
}

// The code of the first diagnostic, or "" if the case is accepted.
std::string code_of(const std::string& text) {
  const CaseFolder folder(text);
  try {
    answers_of(read_published_case(folder.file(), "case"));
  } catch (const InputError& error) {
    return std::string(error.faults().front().code);
  }
  return "";
}

}  // namespace

TEST_CASE("a published number is as exact as its digits") {
  // A mass falls by g/2 = 4.905 m in 1 s.
  CHECK(error_of(number("links/mass/z", "m", "-4.9050")) < 1e-8);
  CHECK(error_of(number("links/mass/z", "m", "-4.9")) == doctest::Approx(0.05));
  CHECK(error_of(number("links/mass/z", "m", "-4.91")) == doctest::Approx(0.5));
  CHECK(error_of(number("links/mass/z", "m", "-4907e-3")) == doctest::Approx(2));
  CHECK(error_of(number("links/mass/az", "m/s^2", "-9.81") +
                 number("kinetic_energy", "J", "48.1", "time = 1\n")) == doctest::Approx(0.1805));
}

TEST_CASE("a case file without source, or with a wrong unit, digits, quantity or key is refused") {
  const std::string good = number("links/mass/z", "m", "-4.905");
  CHECK(code_of(kHead + good) == "");
  CHECK(code_of("title = \"x\"\nmodel = \"scene.toml\"\n" + good) == "scene.missing");
  CHECK(code_of(kHead) == "scene.missing");
  CHECK(code_of(kHead + number("links/mass/z", "mm", "-4905")) == "published.unit");
  CHECK(code_of(kHead + number("links/mass/z", "m", "-4.905 m")) == "published.digits");
  CHECK(code_of(kHead + number("links/mass/z", "m", "1e999")) == "published.digits");
  CHECK(code_of(kHead + number("links/mas/z", "m", "-4.905")) == "published.quantity");
  // No tolerance can be wider than the digits: there is none.
  CHECK(code_of(kHead + number("links/mass/z", "m", "-4.905", "tolerance = 0.1\n")) ==
        "scene.unknown-key");
}

TEST_CASE("a run that diverges before a published time fails the case") {
  const std::string start = number("links/mass/z", "m", "0.0", "time = 0\n");  // passes
  const CaseFolder folder(
      kHead + "integrator = \"euler\"\n" + number("links/mass/z", "m", "1", "time = 9\n") + start,
      kScene + "[[spring]]\na = \"mass\"\nb = \"world\"\npoint_b = [0, 0, 1]\nstiffness = 1e9\n");
  const AnalyticCase diverged = case_of(read_published_case(folder.file(), "case"));
  CHECK_FALSE(passes(diverged, diverged.run()));
}

TEST_CASE("every published case passes") {
  REQUIRE(published_cases().size() > 1);
  for (const AnalyticCase& c : published_cases()) {
    CAPTURE(c.name);
    CHECK(passes(c, c.run()));
  }
}
