// Formulas: values and derivatives against closed forms and differences, text there and back,
// units, and what is refused.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "solver/expressions/expression_parser.h"
#include "solver/expressions/expression_tape.h"

namespace twinarm {
namespace {

using Id = ExpressionGraph::Id;

constexpr Dimension kNone{}, kMetre{{2, 0, 0}}, kSecond{{0, 0, 2}}, kNewton{{2, 2, -4}};
const std::vector<ExpressionSymbol> kSymbols = {{"x", kNone},   {"y", kNone},
                                                {"q", kMetre},  {"v", kMetre / kSecond},
                                                {"t", kSecond}, {"q(arm/elbow)", kNone}};

struct Formula {
  ExpressionGraph graph;
  Id id;
  explicit Formula(const std::string& text) : id(parse_expression(graph, text, kSymbols)) {}

  double at(double x, double y = 0, double q = 0, double v = 0, double t = 0) {
    return value(id, {x, y, q, v, t, 0});
  }
  double value(Id of, const std::array<double, 6>& values) {
    std::vector<Id> inputs;
    for (const ExpressionSymbol& symbol : kSymbols) inputs.push_back(graph.symbol(symbol.name));
    const std::array outputs{of};
    ExpressionTape tape(graph, inputs, outputs);
    return tape(values)[0];
  }
  double slope(double x, double y = 0) {
    return value(graph.derivative(id, graph.symbol("x")), {x, y, 0, 0, 0, 0});
  }
};

std::string error_of(const std::string& text, std::optional<Dimension> wanted = std::nullopt) {
  ExpressionGraph graph;
  try {
    parse_expression(graph, text, kSymbols, wanted);
  } catch (const ExpressionError& error) {
    return error.what();
  }
  return "";
}

// A formula of x and y that is smooth near (0.7, 1.3).
std::string random_formula(std::mt19937& random, int depth) {
  const auto pick = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  if (depth == 0) return std::array{"x", "y", "0.3", "2"}[static_cast<std::size_t>(pick(4))];
  const auto part = [&] { return "(" + random_formula(random, depth - 1) + ")"; };
  switch (pick(9)) {
    case 0:
      return part() + " + " + part();
    case 1:
      return part() + " - " + part();
    case 2:
      return part() + " * " + part();
    case 3:
      return part() + " / (2 + sin(" + part() + "))";
    case 4:
      return "cos" + part();
    case 5:
      return "tanh" + part();
    case 6:
      return "sqrt(1 + " + part() + "^2)";
    case 7:
      return "atan2(" + part() + ", 3 + cos" + part() + ")";
    default:
      return "-" + part();
  }
}

}  // namespace

TEST_CASE("formulas have the value of the same C++ expression") {
  CHECK(Formula("1 + 2 * 3 - 4 / 8").at(0) == 6.5);
  CHECK(Formula("-x^2").at(3) == -9);
  CHECK(Formula("2^-1 * (x - 1)^3").at(3) == 4);
  CHECK(Formula("x - (y - 1) - 2").at(5, 3) == 1);
  CHECK(Formula("8 / x / y").at(2, 4) == 1);
  CHECK(Formula("min(x, y) + 10 * max(x, y) + 100 * abs(-x)").at(3, 2) == 332);
  CHECK(Formula("atan2(x, y)").at(1, -1) == std::atan2(1.0, -1.0));
  CHECK(Formula("exp(log(x)) * tan(y)").at(0.4, 0.3) == doctest::Approx(0.4 * std::tan(0.3)));
  CHECK(Formula("sin(2 * pi * x)").at(0.25) == doctest::Approx(1));
  for (const double x : {-1.0, 0.0, 1.0}) {
    CHECK(Formula("if(x < 0, 1, 2)").at(x) == (x < 0 ? 1 : 2));
    CHECK(Formula("if(x <= 0, 1, 2)").at(x) == (x <= 0 ? 1 : 2));
    CHECK(Formula("if(x > 0, 1, 2)").at(x) == (x > 0 ? 1 : 2));
    CHECK(Formula("if(x >= 0, 1, 2)").at(x) == (x >= 0 ? 1 : 2));
  }
}

TEST_CASE("derivatives agree with closed forms and, of random formulas, with differences") {
  CHECK(Formula("x^3 - 2 * x").slope(2) == 10);
  CHECK(Formula("sqrt(x)").slope(4) == 0.25);
  CHECK(Formula("x * log(x)").slope(1) == 1);
  CHECK(Formula("abs(x) * x").slope(-3) == 6);
  CHECK(Formula("if(x < 1, x^2, 2 * x - 1)").slope(3) == 2);
  CHECK(Formula("y").slope(1) == 0);
  std::mt19937 random(7);
  for (int n = 0; n < 300; ++n) {
    const std::string text = random_formula(random, 4);
    CAPTURE(text);
    Formula formula(text);
    constexpr double x = 0.7, y = 1.3, h = 1e-3;
    const auto central = [&](double step) {
      return (formula.at(x + step, y) - formula.at(x - step, y)) / (2 * step);
    };
    const double extrapolated = (4 * central(h / 2) - central(h)) / 3;  // error of order h^4
    const double scale = 1 + std::abs(extrapolated);
    CHECK(std::abs(formula.slope(x, y) - extrapolated) < 1e-7 * scale * scale);
  }
}

TEST_CASE("equal terms are one node, and a formula's text is read as the same node") {
  ExpressionGraph graph;
  const auto parse = [&](const std::string& text) {
    return parse_expression(graph, text, kSymbols);
  };
  CHECK(parse("x * y + 1") == parse("1 + y * x"));
  CHECK(parse("x - y") != parse("y - x"));
  CHECK(parse("0 * x + 1 * y^1 - 0") == parse("y"));
  CHECK(parse("--x") == parse("x"));
  CHECK(parse("-(x - y)") == parse("y - x"));
  CHECK(parse("2 * 3 * x") == parse("6 * x"));
  CHECK(parse("q(arm/elbow) * q") ==
        graph.multiply(graph.symbol("q(arm/elbow)"), graph.symbol("q")));
  CHECK(graph.text(parse("-2 * q(arm/elbow)")) == "q(arm/elbow) * (-2)");
  std::mt19937 random(3);
  for (int n = 0; n < 300; ++n) {
    const std::string text = random_formula(random, 4);
    CAPTURE(text);
    CHECK(parse(graph.text(parse(text))) == parse(text));
  }
  // x^(2^20) by squaring: its derivative has a few nodes for each level.
  Id power = parse("x + 1");
  for (int n = 0; n < 20; ++n) power = graph.multiply(power, power);
  const std::size_t before = graph.size();
  graph.derivative(power, graph.symbol("x"));
  CHECK(graph.size() - before < 100);
}

TEST_CASE("tables are linear between their points and constant beyond them") {
  ExpressionGraph graph;
  const Id x = graph.symbol("x");
  const Id table = graph.table({{0, 1, 3}, {2, 4, 0}}, graph.multiply(graph.constant(2), x));
  const std::array outputs{table, graph.derivative(table, x)};
  const std::array inputs{x};
  ExpressionTape tape(graph, inputs, outputs);
  const auto check = [&](double at, double value, double slope) {
    CAPTURE(at);
    const auto found = tape(std::array{at});
    CHECK(found[0] == doctest::Approx(value));
    CHECK(found[1] == slope);
  };
  check(-5, 2, 0);
  check(0.25, 3, 4);
  check(0.5, 4, -4);  // to the right of the corner
  check(1, 2, -4);
  check(1.5, 0, 0);
  CHECK(graph.table({{0, 1, 3}, {2, 4, 0}}, graph.multiply(graph.constant(2), x)) == table);
  CHECK(std::isnan(tape(std::array{std::nan("")})[0]));
}

TEST_CASE("units are read, and terms of different units are not added or compared") {
  CHECK(Formula("12[N/mm] * q").at(0, 0, 2) == doctest::Approx(24000));
  CHECK(Formula("90[deg]").at(0) == doctest::Approx(std::acos(0.0)));
  CHECK(parse_unit("N m s/rad")->dimension == parse_unit("kg m^2/s")->dimension);
  CHECK(parse_unit("1/(s ms)")->size == doctest::Approx(1000));
  CHECK(parse_unit("m^0.5")->dimension.text() == "m^0.5");
  CHECK(parse_unit("kN/m^2")->dimension == parse_unit("Pa")->dimension);
  for (const char* bad : {"", "m/", "/m", "foo", "m^x", "m^99", "m m2"}) CHECK(!parse_unit(bad));
  for (const char* unit : {"kg m/s^2", "1/s", "m", "m^0.5/(kg s)"})
    CHECK(parse_unit(unit)->dimension.text() == unit);

  CHECK(error_of("100 * q + 5", kNewton) == "");
  CHECK(error_of("100[N/m] * q - 3[N s/m] * v", kNewton) == "");
  CHECK(error_of("100[N/m] * v", kNewton) ==
        "at character 1: value is in kg m/s^3, must be in kg m/s^2");
  CHECK(error_of("q + t") == "at character 3: m and s cannot be added or compared");
  CHECK(error_of("if(q < v, 1, 2)") == "at character 6: m and m/s cannot be added or compared");
  CHECK(error_of("1 + sin(t)") == "at character 5: argument of sin is in s, must have no unit");
  CHECK(error_of("sqrt(q^2 + q * q) - q") == "");
  CHECK(error_of("sin(2 * pi * t)") == "");
  CHECK(error_of("3[N/foo]") ==
        "at character 3: unknown unit 'N/foo'; give for example N/m or 1/s");
}

TEST_CASE("what is no formula is refused with its place, and sizes are bounded") {
  CHECK(error_of("") == "at character 1: found the end, expected a number or a name");
  CHECK(error_of("x +") == "at character 4: found the end, expected a number or a name");
  CHECK(error_of("(x") == "at character 3: found the end, expected ')'");
  CHECK(error_of("x y") == "at character 3: unexpected 'y'");
  CHECK(error_of("2 $ 3") == "at character 3: unexpected '$'");
  CHECK(error_of("min(x)") == "at character 6: found ')', expected ','");
  CHECK(error_of("x^y") == "at character 3: exponent must be a number");
  CHECK(error_of("1e999").starts_with("at character 1: not a finite number"));
  CHECK(error_of("3[N").starts_with("at character 2: unit has no ']'"));
  CHECK(error_of("q(wrist)").starts_with("at character 2: unexpected '('"));
  CHECK(error_of("foo + x").starts_with("at character 1: unknown name 'foo'; known are x, y, q"));
  CHECK(error_of(std::string(99, '(') + "x" + std::string(99, ')')) == "");
  CHECK(error_of(std::string(101, '(') + "x" + std::string(101, ')'))
            .ends_with("nested more than 100 deep"));
  CHECK(error_of(std::string(101, '-') + "x").ends_with("nested more than 100 deep"));
  CHECK(error_of(std::string(4097, ' ')).ends_with("formula has more than 4096 characters"));
  ExpressionGraph graph;
  CHECK_THROWS_AS(
      [&] {
        for (std::size_t n = 0; n <= ExpressionGraph::kMaxNodes; ++n)
          graph.constant(static_cast<double>(n));
      }(),
      std::length_error);
}

}  // namespace twinarm
