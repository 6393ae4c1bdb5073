// Recorded traces: round trip, interpolation, and all errors of an invalid file at once.
#include <doctest/doctest.h>

#include <cmath>

#include "coupling/target/recorded_trace.h"
#include "coupling/target/synthetic_operator.h"
#include "solver/support/diagnostics.h"
#include "tests/support/temporary_folder.h"

using namespace twinarm;
namespace fs = std::filesystem;

namespace {

const std::string kHeader =
    "t[s],theta1[rad],theta2[rad],theta3[rad],theta4[rad],theta5[rad],theta6[rad],button\n";

std::vector<Diagnostic> faults_of(const fs::path& file) {
  try {
    RecordedTrace trace(file);
  } catch (const InputError& error) {
    for (const Diagnostic& fault : error.faults()) {
      CHECK(fault.file == file.string());
      CHECK_FALSE(fault.problem.empty());
    }
    return error.faults();
  }
  return {};
}
bool names(const std::vector<Diagnostic>& faults, int line, const std::string& word) {
  for (const Diagnostic& fault : faults)
    if (fault.line == line && to_string(fault).find(word) != std::string::npos) return true;
  return false;
}

}  // namespace

TEST_CASE("a trace that was written is read with six decimals, angles and button") {
  const TemporaryFolder folder;
  const SyntheticOperator hand(3, 4.0);
  write_trace(hand, 200, (folder.path() / "hand.csv"));
  CHECK_FALSE(fs::exists(folder.path() / "hand.csv.tmp"));
  const RecordedTrace trace(folder.path() / "hand.csv");
  CHECK(trace.duration() == doctest::Approx(4.0));
  for (int n = 0; n <= 800; ++n) {
    const double t = n / 200.0;
    const OperatorSample x = hand.sample(t, t + 1), y = trace.sample(t, t + 1);
    for (std::size_t j = 0; j < 6; ++j) CHECK_UNARY(std::abs(x.theta[j] - y.theta[j]) < 1e-6);
    CHECK_UNARY(x.button == y.button);
  }
}

TEST_CASE("between samples a trace is linear; at a sample the rate is one-sided") {
  const TemporaryFolder folder;
  // Columns in another order, comments, blanks, another start time, Windows line ends.
  const RecordedTrace trace(folder.write(
      "trace.csv",
      "# made by hand\r\n"
      "button, theta6[rad], theta5[rad],theta4[rad],theta3[rad],theta2[rad],theta1[rad],t[s]\r\n"
      "0, 0,0,0,0,0, 1.0, 10\r\n# a pause\r\n\n1, 0,0,0,0,0, 2.0, 10.5\r\n"
      "0, 6,0,0,0,0, -1.0, 12.5\r\n"));
  CHECK(trace.duration() == doctest::Approx(2.5));
  const auto angle = [&](double t) { return trace.sample(t, t + 0.01).theta[0]; };
  CHECK(angle(0) == doctest::Approx(1));
  CHECK(angle(0.25) == doctest::Approx(1.5));
  CHECK(angle(0.5) == doctest::Approx(2));
  CHECK(angle(1.5) == doctest::Approx(0.5));
  CHECK(angle(9) == doctest::Approx(-1));  // the last sample, held
  CHECK(trace.sample(1.5, 2).theta[5] == doctest::Approx(3));
  const auto rate = [&](double t, double toward) { return trace.sample(t, toward).theta_dot[0]; };
  CHECK(rate(0, 0.1) == doctest::Approx(2));
  CHECK(rate(0.5, 0.4) == doctest::Approx(2));
  CHECK(rate(0.5, 0.6) == doctest::Approx(-1.5));
  CHECK(rate(2.5, 2.4) == doctest::Approx(-1.5));
  CHECK(rate(2.5, 2.6) == 0);
  CHECK(rate(9, 9.1) == 0);
  CHECK_FALSE(trace.sample(0.49, 0.5).button);
  CHECK(trace.sample(0.5, 0.6).button);
  CHECK(trace.sample(2.4, 2.5).button);
}

TEST_CASE("a trace without a button column is read, its button never pressed") {
  const TemporaryFolder folder;
  const RecordedTrace trace(folder.write("trace.csv", kHeader.substr(0, kHeader.find(",button")) +
                                                          "\n0,1,2,3,4,5,6\n1,1,2,3,4,5,6\n"));
  CHECK_FALSE(trace.sample(0.5, 1).button);
  CHECK(trace.sample(0.5, 1).theta[5] == 6);
}

TEST_CASE("a trace is read that begins with a byte order mark, as Excel writes it") {
  const TemporaryFolder folder;
  const std::string lines = kHeader + "0,1,2,3,4,5,6,0\n1,1,2,3,4,5,6,1\n";
  CHECK(RecordedTrace(folder.write("trace.csv", "\xEF\xBB\xBF" + lines)).sample(1, 1.1).button);
}

TEST_CASE("a trace file that does not exist, or is a folder, is rejected by name") {
  const TemporaryFolder folder;
  CHECK(faults_of(folder.path() / "nowhere.csv").size() == 1);
  CHECK_FALSE(faults_of(folder.path()).empty());
}

TEST_CASE("all missing columns of a trace are reported at once") {
  const TemporaryFolder folder;
  const auto faults = faults_of(
      folder.write("trace.csv", "# x\ntime,theta1,theta2[rad],theta3[deg],theta4[rad],button\n"));
  for (const char* column : {"t[s]", "theta1[rad]", "theta5[rad]", "theta6[rad]"})
    CHECK(names(faults, 2, column));
  CHECK(faults.size() == 4);
}

TEST_CASE(
    "all invalid lines of a trace are reported at once: text, nan, inf, missing cells, time") {
  const TemporaryFolder folder;
  const auto faults =
      faults_of(folder.write("trace.csv", kHeader + "0,0,0,0,0,0,0,0\n"     // 2
                                                    "1,0,oops,0,0,0,0,0\n"  // 3
                                                    "2,0,0,nan,0,inf,0,0\n"
                                                    "3,0,0,0,0,0,0,0\n"    // 5
                                                    "2.5,0,0,0,0,0,0,0\n"  // 6
                                                    "4,0,0,0\n"            // 7
                                                    "5,0,0,0,0,0,1e999,0\n"
                                                    "6,0,0,0,0,0,1.5x,0\n"
                                                    "3,0,0,0,0,0,0,0\n"  // 10: equal time
                                                    "7,0,0,0,0,0,0,yes\n"
                                                    "8,0,0,0,0,0,0,7\n"));
  CHECK(names(faults, 3, "theta2"));
  CHECK(names(faults, 3, "oops"));
  CHECK(names(faults, 4, "theta3"));
  CHECK(names(faults, 4, "theta5"));
  CHECK(names(faults, 6, "2.5"));
  CHECK(names(faults, 7, "theta4"));
  CHECK(names(faults, 8, "1e999"));
  CHECK(names(faults, 9, "1.5x"));
  CHECK(names(faults, 10, "time"));
  CHECK(names(faults, 11, "button"));
  CHECK(names(faults, 12, "'7' is neither 0 nor 1"));
  for (const int good : {1, 2, 5}) CHECK_FALSE(names(faults, good, ""));
}

TEST_CASE("an invalid number of a trace does not hide that time runs back") {
  const TemporaryFolder folder;
  const auto faults = faults_of(folder.write("trace.csv", kHeader + "0,0,0,0,0,0,0,0\n"
                                                                    "0.2,nan,0,0,0,0,0,0\n"   // 3
                                                                    "0.1,0,0,0,0,0,0,0\n"     // 4
                                                                    "0.2,0,0,0,oops,0,0,0\n"  // 5
                                                                    "0.3,0,0,0,0,0,0,0\n"));
  CHECK(names(faults, 3, "theta1[rad]"));
  CHECK(names(faults, 4, "t[s]"));
  CHECK(names(faults, 5, "t[s]"));
  CHECK(names(faults, 5, "theta4[rad]"));
  CHECK(faults.size() == 4);
}

TEST_CASE("a trace with fewer than two samples is rejected") {
  const TemporaryFolder folder;
  for (const std::string& body :
       {std::string(), kHeader, kHeader + "0,0,0,0,0,0,0,0\n", std::string("# only a comment\n")})
    CHECK_FALSE(faults_of(folder.write("trace.csv", body)).empty());
}

TEST_CASE("a trace with a hundred invalid lines reports the first twenty and counts the others") {
  const TemporaryFolder folder;
  std::string body = kHeader;
  for (int n = 0; n < 100; ++n) body += "x,0,0,0,0,0,0,0\n";
  const auto faults = faults_of(folder.write("trace.csv", body));
  CHECK(faults.size() == 21);
  CHECK(faults.back().problem.find("80") != std::string::npos);
}

TEST_CASE("a trace that cannot be written is an error and leaves nothing behind") {
  const TemporaryFolder folder;
  const fs::path below_a_file = folder.write("trace.csv", "x") / "trace.csv";
  CHECK_THROWS_AS(write_trace(SyntheticOperator(1, 1), 10, below_a_file), InputError);
  fs::create_directories((folder.path() / "taken.csv") / "inside");
  CHECK_THROWS_AS(write_trace(SyntheticOperator(1, 1), 10, (folder.path() / "taken.csv")),
                  InputError);
  CHECK_FALSE(fs::exists(folder.path() / "taken.csv.tmp"));
}

TEST_CASE("a blank line with a Windows line end is skipped") {
  const TemporaryFolder folder;
  CHECK(faults_of(folder.write("trace.csv", kHeader + "0,0,0,0,0,0,0,0\r\n\r\n1,0,0,0,0,0,0,0\r\n"))
            .empty());
}

TEST_CASE("a column in [deg] is converted, its neighbours in radians are not") {
  const TemporaryFolder folder;
  const RecordedTrace trace(
      folder.write("trace.csv",
                   "t[s],theta1[deg],theta2[rad],theta3[rad],theta4[deg],theta5[rad],theta6[rad]\n"
                   "0,45,0.5,0,-90,0,0\n1,30,1.5,0,180,0,0\n"));
  CHECK(trace.sample(0, 1).theta[0] == doctest::Approx(std::acos(-1.0) / 4).epsilon(1e-14));
  CHECK(trace.sample(0, 1).theta[1] == 0.5);
  CHECK(trace.sample(1, 2).theta[3] == doctest::Approx(std::acos(-1.0)).epsilon(1e-14));
}

TEST_CASE(
    "angles beyond a revolution are rejected, with a hint at degrees if these are plausible") {
  const TemporaryFolder folder;
  const auto degrees =
      faults_of(folder.write("trace.csv", kHeader + "0,20,60,-10,0,0,0,0\n1,-40,75,5,3,0,1,0\n"));
  CHECK(names(degrees, 1, "theta1[rad]"));
  CHECK(names(degrees, 1, "theta2[rad]"));
  CHECK(names(degrees, 1, "probably degrees"));
  CHECK(names(degrees, 1, "theta1[deg]"));
  CHECK(degrees.size() == 3);  // joints 1 to 3
  const auto nonsense =
      faults_of(folder.write("trace.csv", kHeader + "0,4000,0,0,0,0,0,0\n1,0,0,0,0,0,0,0\n"));
  CHECK(names(nonsense, 1, "4000"));
  CHECK_FALSE(names(nonsense, 1, "probably degrees"));
}

TEST_CASE("angles beyond the Omni's joint limits give a warning, and are used unchanged") {
  const TemporaryFolder folder;
  const RecordedTrace doubted(
      folder.write("trace.csv", kHeader + "0,0,0,0,0,0,0,0\n1,5,0,0,0,0,0,0\n"));
  CHECK(doubted.sample(1, 2).theta[0] == 5);
  REQUIRE(doubted.quality().warnings.size() == 1);
  CHECK(doubted.quality().warnings[0].find("theta1[deg]") != std::string::npos);
  const RecordedTrace tiny(
      folder.write("trace.csv",
                   "t[s],theta1[deg],theta2[deg],theta3[deg],theta4[deg],theta5[deg],theta6[deg]\n"
                   "0,0,1.2,0,0,0,0\n1,0.9,0,0,0,0,-0.4\n"));
  REQUIRE(tiny.quality().warnings.size() == 1);
  CHECK(tiny.quality().warnings[0].find("theta1[rad]") != std::string::npos);
}

TEST_CASE("a trace has its sampling rate, and no warnings if it is uniform") {
  const TemporaryFolder folder;
  for (const double rate : {7.0, 60.0, 1000.0}) {
    write_trace(SyntheticOperator(2, 3), rate, (folder.path() / "even.csv"));
    const TraceQuality quality = RecordedTrace(folder.path() / "even.csv").quality();
    CHECK(quality.rate == doctest::Approx(rate).epsilon(1e-3));
    CHECK(quality.max_gap == doctest::Approx(1 / rate).epsilon(1e-3));
    CHECK(quality.jitter < 1e-6);  // six decimals of a second in the file
    CHECK(quality.warnings.empty());
  }
}

TEST_CASE("gaps and jitter of a trace are measured and reported") {
  const TemporaryFolder folder;
  // 100 Hz, every other sample 4 ms late: intervals 14 and 6 ms, and one gap of 0.5 s from t = 2.
  std::string body = kHeader;
  for (int n = 0; n < 200; ++n) {
    const double t = 1 + 0.01 * n + (n % 2 == 1 ? 0.004 : 0.0) + (n > 100 ? 0.49 : 0.0);
    body += std::to_string(t) + ",0,1,0,0,0,0,0\n";
  }
  const TraceQuality quality = RecordedTrace(folder.write("trace.csv", body)).quality();
  CHECK(quality.interval == doctest::Approx(0.014));
  CHECK(quality.max_gap == doctest::Approx(0.504));
  CHECK(quality.gap_start == doctest::Approx(2.0));
  // Of 198 intervals without the gap 99 are the median and 99 are 8 ms less.
  CHECK(quality.jitter == doctest::Approx(0.008 * std::sqrt(99.0 / 198.0)).epsilon(1e-6));
  REQUIRE(quality.warnings.size() == 2);
  CHECK(quality.warnings[0].find("gap") != std::string::npos);
  CHECK(quality.warnings[0].find("t = 2") != std::string::npos);
  CHECK(quality.warnings[1].find("jitter") != std::string::npos);
}
